//! Tables of bands seen in bins.

use crate::grid::band_grid::BandGrid;
use crate::grid::error::GridError;
use crate::grid::lookup::Interpolation;
use crate::grid::table::HalfDiffTable;
use brdf::{Brdf, LANES, Lanes3, Symmetry};
use glam::DVec3;

/// A table of bands seen in `N` channels that each are a weighted sum of a few neighbouring bands.
///
/// Interpolation in direction and the sum are both linear, so that their order does not matter; the bands are fewer.
#[derive(Clone, Debug)]
pub struct BinnedGrid<const L: usize, const N: usize> {
    grid: BandGrid<L>,
    /// First band and how many, for each channel.
    spans: [(u32, u32); N],
    /// The weights of all channels, one after another.
    weights: Vec<f32>,
}

impl<const L: usize, const N: usize> BinnedGrid<L, N> {
    /// `rows[b][c]` is what one unit of band `b` adds to channel `c`.
    ///
    /// # Errors
    /// [`GridError::Channels`] if the table does not have as many channels as there are rows, or more than `32 L - 1`.
    pub fn new(
        table: &HalfDiffTable,
        interpolation: Interpolation,
        rows: &[[f64; N]],
    ) -> Result<Self, GridError> {
        let (expected, found) = (rows.len(), table.channels());
        if expected != found {
            return Err(GridError::Channels { expected, found });
        }
        let mut weights = Vec::new();
        let spans = std::array::from_fn(|c| {
            let used = |row: &[f64; N]| row[c] != 0.0;
            let first = rows.iter().position(used).unwrap_or(0);
            let end = rows.iter().rposition(used).map_or(first, |last| last + 1);
            weights.extend(rows[first..end].iter().map(|row| row[c] as f32));
            (first as u32, (end - first) as u32)
        });
        Ok(Self {
            grid: BandGrid::new(table, interpolation)?,
            spans,
            weights,
        })
    }
}

impl<const L: usize, const N: usize> Brdf<N> for BinnedGrid<L, N> {
    /// In single precision, like packets.
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let (mut wi_lanes, mut wo_lanes) = (Lanes3::ZERO, Lanes3::ZERO);
        wi_lanes.set(0, wi.as_vec3());
        wo_lanes.set(0, wo.as_vec3());
        let f = self.eval_lanes(&wi_lanes, &wo_lanes);
        f.map(|lanes| f64::from(lanes[0]))
    }

    fn symmetry(&self) -> Symmetry {
        self.grid.symmetry
    }

    fn table_bytes(&self) -> usize {
        self.grid.bytes()
    }

    #[inline(always)]
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        let rows = self.grid.rows(wi, wo);
        let mut bands = [[[0.0; LANES]; 32]; L];
        for k in 0..LANES {
            let above = wi.z[k] > 0.0 && wo.z[k] > 0.0;
            let factor = if above { 1.0 } else { 0.0 };
            for l in 0..L {
                for c in 0..32 {
                    bands[l][c][k] = factor * rows[k][l][c];
                }
            }
        }
        let bands = bands.as_flattened();
        let mut weights = self.weights.iter();
        let mut out = [[0.0; LANES]; N];
        for (channel, &(first, count)) in out.iter_mut().zip(&self.spans) {
            let span = first as usize..(first + count) as usize;
            for (band, weight) in bands[span].iter().zip(&mut weights) {
                for k in 0..LANES {
                    channel[k] += weight * band[k];
                }
            }
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::layout::PhiDomain;
    use brdf::{Status, direction};
    use spectrum::Basis;

    /// Three bands a channel, shifting; the last channel sees nothing.
    fn rows<const K: usize, const N: usize>() -> [[f64; N]; K] {
        std::array::from_fn(|b| {
            std::array::from_fn(|c| {
                let first = c * (K - 3) / N;
                let seen = (first..first + 3).contains(&b) && c + 1 < N;
                if seen { 0.2 + 0.1 * b as f64 } else { 0.0 }
            })
        })
    }

    fn agrees<const L: usize, const K: usize, const N: usize>(phi: PhiDomain) {
        let bands = (0..K).map(|b| 400.0 + 5.0 * b as f64).collect();
        let table = HalfDiffTable::from_fn([9, 8, 7], phi, Basis::Bands(bands), |wi, wo, out| {
            for (b, o) in out.iter_mut().enumerate() {
                *o = wi.z * wo.z + 0.3 * (b as f64).sin().powi(2);
            }
            Status::Measured
        });
        let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
        for k in 0..LANES {
            wi.set(k, direction(0.1 * k as f64, 0.3).as_vec3());
            wo.set(k, direction(0.7, 0.2 * k as f64).as_vec3());
        }
        let rows = rows::<K, N>();
        for how in [Interpolation::Linear, Interpolation::Nearest] {
            let grid = BinnedGrid::<L, N>::new(&table, how, &rows).unwrap();
            let f = grid.eval_lanes(&wi, &wo);
            for k in 0..LANES {
                let (wi, wo) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                let mut native = [0.0; K];
                table.eval(wi, wo, how, &mut native);
                let alone = grid.eval(wi, wo);
                for c in 0..N {
                    let expected: f64 = (0..K).map(|b| native[b] * rows[b][c]).sum();
                    let weight: f64 = (0..K).map(|b| rows[b][c]).sum();
                    // channels of at most 1.3, packed; single precision along theta_h, theta_d and phi_d
                    let allowed = (1.3 * 0.5_f64.powi(15) + 1e-5) * weight;
                    let error = (f64::from(f[c][k]) - expected).abs();
                    assert!(error <= allowed, "lane {k}, channel {c}: off by {error}");
                    assert_eq!(alone[c].to_bits(), f64::from(f[c][k]).to_bits(), "alone");
                }
            }
        }
    }

    #[test]
    fn bins_are_sums_of_the_interpolated_bands() {
        agrees::<1, 31, 45>(PhiDomain::Mirror);
        agrees::<1, 31, 45>(PhiDomain::Reciprocal);
        agrees::<3, 65, 45>(PhiDomain::Full);
    }

    #[test]
    fn rows_and_channels_that_do_not_fit_are_refused() {
        let table = |k: usize| {
            let basis = Basis::Bands((0..k).map(|b| 400.0 + b as f64).collect());
            HalfDiffTable::from_fn([2, 2, 2], PhiDomain::Mirror, basis, |_, _, _| {
                Status::Measured
            })
        };
        let grid = |k: usize, n: usize| {
            BinnedGrid::<1, 4>::new(&table(k), Interpolation::Linear, &vec![[1.0; 4]; n])
        };
        assert!(grid(31, 31).is_ok());
        assert!(grid(31, 30).is_err(), "a row a band");
        assert!(grid(32, 32).is_err(), "31 fit one line");
    }
}
