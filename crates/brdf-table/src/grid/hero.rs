//! Tables of bands seen at the wavelengths of each path.

use crate::grid::band_grid::BandGrid;
use crate::grid::error::GridError;
use crate::grid::lookup::Interpolation;
use crate::grid::node_rows::PackedRows;
use crate::grid::table::HalfDiffTable;
use brdf::{HERO, LANES, Lanes3, ROTATIONS, Rotation, TaggedBrdf};
use spectrum::Basis;
use std::sync::Arc;

/// A table of bands for hero wavelength sampling: the row of all bands, read at the wavelengths of the path, linear
/// between two bands each.
#[derive(Clone, Debug)]
pub struct HeroGrid<const L: usize> {
    grid: BandGrid<L>,
    taps: Arc<[[Tap; HERO]; ROTATIONS]>,
}

/// Where a wavelength lies between the bands: the lower one, and the part of the next.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Tap {
    band: u32,
    t: f32,
}

impl<const L: usize> HeroGrid<L> {
    /// `lambda_nm[r][c]` is wavelength `c` of rotation `r`; beyond the bands the outermost hold.
    ///
    /// # Errors
    /// [`GridError::Channels`] if the table has no channels that are bands, or more than `32 L - 1`.
    pub fn new(
        table: &HalfDiffTable,
        interpolation: Interpolation,
        lambda_nm: &[[f64; HERO]; ROTATIONS],
    ) -> Result<Self, GridError> {
        let bands = match table.basis() {
            Basis::Bands(nm) if nm.len() > 1 => nm,
            other => {
                return Err(GridError::Channels {
                    expected: PackedRows::<L>::CHANNELS,
                    found: other.len(),
                });
            }
        };
        let taps = lambda_nm.map(|row| row.map(|nm| tap(bands, nm)));
        Ok(Self {
            grid: BandGrid::new(table, interpolation)?,
            taps: Arc::new(taps),
        })
    }
}

/// At least two ascending bands.
fn tap(bands: &[f64], nm: f64) -> Tap {
    let band = bands
        .partition_point(|b| *b <= nm)
        .clamp(1, bands.len() - 1)
        - 1;
    let gap = bands[band + 1] - bands[band];
    let t = ((nm - bands[band]) / gap).clamp(0.0, 1.0);
    Tap {
        band: band as u32,
        t: t as f32,
    }
}

impl<const L: usize> TaggedBrdf<HERO, Rotation> for HeroGrid<L> {
    fn table_bytes(&self) -> usize {
        self.grid.bytes()
    }

    #[inline(always)]
    fn eval_tagged(
        &self,
        wi: &Lanes3,
        wo: &Lanes3,
        tags: &[Rotation; LANES],
    ) -> [[f32; LANES]; HERO] {
        let rows = self.grid.rows(wi, wo);
        let mut out = [[0.0; LANES]; HERO];
        for k in 0..LANES {
            let row = rows[k].as_flattened();
            let above = wi.z[k] > 0.0 && wo.z[k] > 0.0;
            let taps = &self.taps[tags[k].index()];
            for c in 0..HERO {
                let (band, t) = (taps[c].band as usize, taps[c].t);
                let (low, high) = (row[band], row[band + 1]);
                out[c][k] = if above { low + t * (high - low) } else { 0.0 };
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

    /// 380.5 to 891.5 nm by 1 nm.
    fn wavelengths() -> [[f64; HERO]; ROTATIONS] {
        std::array::from_fn(|r| std::array::from_fn(|c| 380.5 + (c * ROTATIONS + r) as f64))
    }

    #[test]
    fn wavelengths_are_read_between_the_bands_of_the_interpolated_row() {
        const K: usize = 5;
        let bands = vec![400.0, 450.0, 520.0, 600.0, 700.0];
        let basis = Basis::Bands(bands.clone());
        let table = HalfDiffTable::from_fn([9, 8, 7], PhiDomain::Mirror, basis, |wi, wo, out| {
            for (c, o) in out.iter_mut().enumerate() {
                *o = wi.z + 0.3 * wo.z * (c as f64).sin();
            }
            Status::Measured
        });
        for how in [Interpolation::Linear, Interpolation::Nearest] {
            let grid = HeroGrid::<1>::new(&table, how, &wavelengths()).unwrap();
            let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
            for k in 0..LANES {
                wi.set(k, direction(0.1 * k as f64, 0.3).as_vec3());
                wo.set(k, direction(0.7, 0.2 * k as f64).as_vec3());
            }
            let tags = std::array::from_fn(|k| Rotation::new(5 * k as u32));
            let f = grid.eval_tagged(&wi, &wo, &tags);
            for k in 0..LANES {
                let mut row = [0.0; K];
                table.eval(wi.get(k).as_dvec3(), wo.get(k).as_dvec3(), how, &mut row);
                let spectrum = |nm: f64| {
                    let at = tap(&bands, nm);
                    let (low, t) = (at.band as usize, f64::from(at.t));
                    row[low] * (1.0 - t) + row[low + 1] * t
                };
                for c in 0..HERO {
                    let nm = wavelengths()[tags[k].index()][c];
                    let error = (f64::from(f[c][k]) - spectrum(nm)).abs();
                    // single precision along theta_h, theta_d and phi_d, as for any table, and packed channels of at most 1.3
                    let allowed = 1e-5 + 1.3 * 0.5_f64.powi(15);
                    assert!(error < allowed, "lane {k} at {nm} nm: off by {error}");
                }
            }
        }
    }

    #[test]
    fn taps_hold_beyond_the_ends() {
        let bands = [400.0, 500.0, 700.0];
        let at = |nm| tap(&bands, nm);
        assert_eq!(at(300.0), Tap { band: 0, t: 0.0 });
        assert_eq!(at(450.0), Tap { band: 0, t: 0.5 });
        assert_eq!(at(500.0), Tap { band: 1, t: 0.0 });
        assert_eq!(at(700.0), Tap { band: 1, t: 1.0 });
        assert_eq!(at(900.0), Tap { band: 1, t: 1.0 });
    }

    #[test]
    fn other_channels_are_refused() {
        let basis = Basis::Rgb(spectrum::RgbSpace::srgb());
        let table = HalfDiffTable::from_fn([2, 2, 2], PhiDomain::Mirror, basis, |_, _, _| {
            Status::Measured
        });
        let grid = HeroGrid::<1>::new(&table, Interpolation::Linear, &wavelengths());
        assert!(grid.is_err(), "RGB is not bands");
    }
}
