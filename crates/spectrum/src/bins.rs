//! Fixed bins of the visible range: what spectral rendering with few samples carries.

use crate::Spectrum;
use thiserror::Error;

/// Adjacent intervals of wavelengths; a spectrum is told by its mean over each.
///
/// What lies beyond the outermost edges counts as if the outermost means went on, so that a flat spectrum keeps
/// its colour exactly whatever the range.
#[derive(Clone, Debug, PartialEq)]
pub struct Bins {
    edges_nm: Vec<f64>,
}

/// Why edges make no bins.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BinsError {
    /// Fewer than two edges.
    #[error("bins need at least two edges, found {0}")]
    TooFew(usize),
    /// Not ascending, or not finite.
    #[error("edge {index} (from 0) is {nm} nm: edges must be finite and ascend")]
    Order {
        /// Which edge, from 0.
        index: usize,
        /// Where it is.
        nm: f64,
    },
}

impl Bins {
    /// The range that [`Self::visible`] divides, nm: of those tried it leaves the least colour difference
    /// (`docs/colour.md`).
    pub const VISIBLE_NM: [f64; 2] = [380.0, 720.0];

    /// Bins between the given edges in nm.
    ///
    /// # Errors
    ///
    /// Fewer than two edges, edges that don't ascend or aren't finite.
    pub fn new(edges_nm: Vec<f64>) -> Result<Self, BinsError> {
        if edges_nm.len() < 2 {
            return Err(BinsError::TooFew(edges_nm.len()));
        }
        for (index, nm) in edges_nm.iter().enumerate() {
            let ascends = index == 0 || edges_nm[index - 1] < *nm;
            if !(ascends && nm.is_finite()) {
                return Err(BinsError::Order { index, nm: *nm });
            }
        }
        Ok(Self { edges_nm })
    }

    /// `count` bins of equal width.
    ///
    /// # Errors
    ///
    /// No bins, or a range that is empty or not finite.
    pub fn uniform(count: usize, range_nm: [f64; 2]) -> Result<Self, BinsError> {
        let [from, to] = range_nm;
        let edge = |k: usize| from + (to - from) * (k as f64 / count as f64);
        let mut edges: Vec<f64> = (0..count).map(edge).collect();
        edges.push(to);
        Self::new(edges)
    }

    /// `count` bins (at least 1) of equal width over [`Self::VISIBLE_NM`]: with 8, 16 and 45 the modes of ART.
    #[must_use]
    pub fn visible(count: usize) -> Self {
        let edges = |k: usize| {
            Self::VISIBLE_NM[0]
                + (Self::VISIBLE_NM[1] - Self::VISIBLE_NM[0]) * (k as f64 / count.max(1) as f64)
        };
        Self {
            edges_nm: (0..=count.max(1)).map(edges).collect(),
        }
    }

    /// How many bins.
    #[must_use]
    pub fn len(&self) -> usize {
        self.edges_nm.len() - 1
    }

    /// Never: there is at least one bin.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The edges in nm, ascending, one more than bins.
    #[must_use]
    pub fn edges_nm(&self) -> &[f64] {
        &self.edges_nm
    }

    /// Lower and upper edge of each bin, nm.
    pub fn ranges(&self) -> impl Iterator<Item = [f64; 2]> {
        self.edges_nm.windows(2).map(|w| [w[0], w[1]])
    }

    /// The middle of each bin, nm.
    pub fn centres_nm(&self) -> impl Iterator<Item = f64> {
        self.ranges().map(|[a, b]| 0.5 * (a + b))
    }

    /// The bin a wavelength counts to; beyond the edges the outermost.
    #[must_use]
    pub fn index_of(&self, lambda_nm: f64) -> usize {
        let above = self.edges_nm.partition_point(|e| *e <= lambda_nm);
        above.clamp(1, self.len()) - 1
    }

    /// The mean of `spectrum` over each bin, exactly.
    #[must_use]
    pub fn means(&self, spectrum: &Spectrum) -> Vec<f64> {
        self.ranges().map(|range| spectrum.mean(range)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Outside;
    use testkit::assert_close;

    #[test]
    fn visible_bins_divide_the_range() {
        for n in [3, 8, 16, 45] {
            let bins = Bins::visible(n);
            assert_eq!(bins.len(), n);
            assert_eq!(bins, Bins::uniform(n, Bins::VISIBLE_NM).unwrap());
            let width = 340.0 / n as f64;
            for (k, [a, b]) in bins.ranges().enumerate() {
                assert_close(b - a, width, 1e-12, "width");
                assert_eq!(bins.index_of(0.5 * (a + b)), k);
            }
            assert_eq!((bins.index_of(0.0), bins.index_of(1e9)), (0, n - 1));
            assert_eq!((bins.index_of(380.0), bins.index_of(720.0)), (0, n - 1));
        }
    }

    #[test]
    fn means_of_a_piecewise_linear_measurement() {
        let knots = vec![400.0, 420.0, 440.0];
        let s = Spectrum::new(knots, vec![0.0, 1.0, 0.0], Outside::Hold).unwrap();
        let means = Bins::new(vec![390.0, 410.0, 430.0, 440.0])
            .unwrap()
            .means(&s);
        // triangles by hand: 10 nm of 0..0.5 over 20 nm; 1 minus two corners; 0.5..0
        for (found, expected) in means.iter().zip([0.125, 0.75, 0.25]) {
            assert_close(*found, expected, 1e-15, "mean");
        }
    }

    #[test]
    fn refuses_edges_out_of_order() {
        assert_eq!(Bins::new(vec![400.0]), Err(BinsError::TooFew(1)));
        for edges in [
            vec![400.0, 400.0],
            vec![500.0, 400.0],
            vec![400.0, f64::INFINITY],
        ] {
            assert!(matches!(
                Bins::new(edges),
                Err(BinsError::Order { index: 1, .. })
            ));
        }
        assert!(Bins::uniform(0, [380.0, 720.0]).is_err());
        assert!(Bins::uniform(4, [720.0, 380.0]).is_err());
    }
}
