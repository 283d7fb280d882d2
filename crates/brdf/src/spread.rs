//! Reflectance of few channels spread over the channels of a render by a linear map.

use crate::contract::{Brdf, Symmetry};
use crate::lanes::{LANES, Lanes3};
use crate::tag::{HERO, RotatedTable, Rotation, TaggedBrdf};
use glam::DVec3;
use std::sync::Arc;

/// A reflectance of `K` channels as one of `N`: an RGB model in spectral bins, one number times a spectrum.
///
/// The map is made once; a look-up costs the `K` channels and `K * N` products.
#[derive(Clone, Debug)]
pub struct Spread<B, const K: usize, const N: usize> {
    brdf: B,
    /// What one unit of each channel adds to each of the `N`.
    rows: [[f64; N]; K],
    narrow: [[f32; N]; K],
}

impl<B: Brdf<K>, const K: usize, const N: usize> Spread<B, K, N> {
    /// `rows[c]` is what one unit of channel `c` of `brdf` adds to each of the `N` channels.
    #[must_use]
    pub fn new(brdf: B, rows: [[f64; N]; K]) -> Self {
        Self {
            brdf,
            narrow: rows.map(|row| row.map(|v| v as f32)),
            rows,
        }
    }
}

impl<B: Brdf<K>, const K: usize, const N: usize> Brdf<N> for Spread<B, K, N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let mut out = [0.0; N];
        for (value, row) in self.brdf.eval(wi, wo).iter().zip(&self.rows) {
            for (o, weight) in out.iter_mut().zip(row) {
                *o += value * weight;
            }
        }
        out
    }

    fn symmetry(&self) -> Symmetry {
        self.brdf.symmetry()
    }

    fn table_bytes(&self) -> usize {
        self.brdf.table_bytes()
    }

    #[inline(always)]
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        let f = self.brdf.eval_lanes(wi, wo);
        let mut out = [[0.0; LANES]; N];
        for (f, row) in f.iter().zip(&self.narrow) {
            for c in 0..N {
                for k in 0..LANES {
                    out[c][k] += f[k] * row[c];
                }
            }
        }
        out
    }
}

/// A reflectance of `K` channels at the wavelengths of each path.
#[derive(Clone, Debug)]
pub struct Rotated<B, const K: usize> {
    brdf: B,
    basis: Arc<[RotatedTable; K]>,
}

impl<B: Brdf<K>, const K: usize> Rotated<B, K> {
    /// `basis[c]` is what one unit of channel `c` of `brdf` adds at each wavelength.
    #[must_use]
    pub fn new(brdf: B, basis: Arc<[RotatedTable; K]>) -> Self {
        Self { brdf, basis }
    }
}

impl<B: Brdf<K>, const K: usize> TaggedBrdf<HERO, Rotation> for Rotated<B, K> {
    fn table_bytes(&self) -> usize {
        self.brdf.table_bytes()
    }

    #[inline(always)]
    fn eval_tagged(
        &self,
        wi: &Lanes3,
        wo: &Lanes3,
        tags: &[Rotation; LANES],
    ) -> [[f32; LANES]; HERO] {
        let f = self.brdf.eval_lanes(wi, wo);
        let mut rows = [[0.0; HERO]; LANES];
        for k in 0..LANES {
            for (f, table) in f.iter().zip(self.basis.iter()) {
                let at = &table[tags[k].index()];
                for c in 0..HERO {
                    rows[k][c] += f[k] * at[c];
                }
            }
        }
        std::array::from_fn(|c| std::array::from_fn(|k| rows[k][c]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{ROTATIONS, direction};

    /// Channel c reads (c + 1) cos theta_i.
    struct Ramp;

    impl Brdf<2> for Ramp {
        fn eval(&self, wi: DVec3, _: DVec3) -> [f64; 2] {
            [wi.z, 2.0 * wi.z]
        }
    }

    fn packet() -> (Lanes3, Lanes3) {
        let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
        for k in 0..LANES {
            wi.set(k, direction(0.09 * k as f64, 0.4 * k as f64).as_vec3());
            wo.set(k, direction(0.5, 1.0).as_vec3());
        }
        (wi, wo)
    }

    #[test]
    fn channels_are_mixed_by_the_rows_in_both_precisions() {
        let spread = Spread::new(Ramp, [[1.0, 0.0, 0.5], [0.0, 1.0, -0.25]]);
        let (wi, wo) = packet();
        let lanes = spread.eval_lanes(&wi, &wo);
        for k in 0..LANES {
            let z = f64::from(wi.z[k]);
            let f = spread.eval(wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
            for (c, exact) in [z, 2.0 * z, 0.0].into_iter().enumerate() {
                assert!((f[c] - exact).abs() < 1e-15, "{c}: {f:?}");
                assert!((f64::from(lanes[c][k]) - exact).abs() < 1e-6, "lane {k}");
            }
        }
    }

    #[test]
    fn every_lane_has_the_wavelengths_of_its_tag() {
        let table = |scale: f32| -> RotatedTable {
            std::array::from_fn(|r| std::array::from_fn(|c| scale * (r * HERO + c) as f32))
        };
        let rotated = Rotated::new(Ramp, Arc::new([table(1.0), table(-0.25)]));
        let (wi, wo) = packet();
        let tags = std::array::from_fn(|k| Rotation::new((7 * k + ROTATIONS - 3) as u32));
        let f = rotated.eval_tagged(&wi, &wo, &tags);
        for k in 0..LANES {
            for c in 0..HERO {
                let place = (tags[k].index() * HERO + c) as f32;
                let exact = 0.5 * place * wi.z[k];
                assert!((f[c][k] - exact).abs() <= 1e-6 * place, "lane {k}: {f:?}");
            }
        }
    }
}
