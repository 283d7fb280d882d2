//! Lafortune's lobes with isotropic axes [Lafortune1997].

use super::registry::Sum;
use super::{build, channels, excess, exponent, lambert, numbered, over, times, whole};
use crate::family::{Channels, Family, Lobes, Part, Scale, ShapeParameter, Weight};
use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

pub(super) const NAME: &str = "lafortune";

/// kd/pi + sum ks (n + 2)/(2 pi) (cx (ix ox + iy oy) + cz iz oz)_+^n.
///
/// Only the ratio of cx and cz is a shape, their size is part of the weight: the larger is +-1, and `axis` is the angle
/// of (cz, cx): -pi/4 reflects like a mirror, pi/4 back to the light, 0 along the normal, -pi/2 forward at grazing angles.
pub(super) struct Lafortune {
    shape: Vec<ShapeParameter>,
    weights: Vec<Weight>,
}

impl Lafortune {
    pub(super) fn new(lobes: usize) -> Self {
        let axis = |lobe| ShapeParameter {
            name: numbered("axis", lobe),
            range: (-FRAC_PI_2, FRAC_PI_2),
            scale: Scale::Linear,
            starts: vec![-FRAC_PI_4, -1.1, 0.9],
        };
        let weight = |name: String| Weight {
            name,
            signed: false,
        };
        Self {
            shape: (0..lobes)
                .flat_map(|lobe| [exponent(lobe), axis(lobe)])
                .collect(),
            weights: std::iter::once(weight("kd".into()))
                .chain((0..lobes).map(|lobe| weight(numbered("ks", lobe))))
                .collect(),
        }
    }

    /// Exponent, cx and cz of every lobe.
    fn lobes_of(shape: &[f64]) -> impl Iterator<Item = (f64, f64, f64)> + '_ {
        shape.chunks_exact(2).map(|s| {
            let (sin, cos) = s[1].sin_cos();
            let largest = sin.abs().max(cos.abs());
            // at the ends of the range the cosine is a rounding error of either sign
            (s[0], sin / largest, cos.max(0.0) / largest)
        })
    }
}

impl Family for Lafortune {
    fn name(&self) -> &'static str {
        NAME
    }

    fn shape(&self) -> &[ShapeParameter] {
        &self.shape
    }

    fn weights(&self) -> &[Weight] {
        &self.weights
    }

    fn lobes(&self, shape: &[f64]) -> Box<dyn Lobes> {
        let lobe = |(n, cx, cz)| {
            Channels(
                build::<1>(&format!("{NAME}:ks=1,n={n},cx={cx},cz={cz},kd=0"))
                    .built
                    .brdf,
            )
        };
        Box::new(Sum(Self::lobes_of(shape).map(lobe).collect()))
    }

    fn parts(&self, shape: &[f64], weights: &[Vec<f64>]) -> Vec<Part> {
        let count = Self::lobes_of(shape).count();
        let factor = excess(weights, 1..1 + count, (NAME, "ks"));
        let scaled = over(weights, factor);
        let lobes: Vec<String> = Self::lobes_of(shape)
            .enumerate()
            .map(|(j, (n, cx, cz))| {
                let name = |name| numbered(name, j);
                let ks = channels(&scaled, 1 + j);
                format!(
                    "{}={ks},{}={n},{}={cx},{}={cz}",
                    name("ks"),
                    name("n"),
                    name("cx"),
                    name("cz")
                )
            })
            .collect();
        let lobes = format!("{NAME}:{}", lobes.join(","));
        if factor <= 1.0 && weights.iter().all(|w| w[0] <= 1.0) {
            let kd = channels(weights, 0);
            return vec![whole(format!("{lobes},kd={kd}"), weights.len())];
        }
        vec![
            lambert(weights, 0),
            times(factor, format!("{lobes},kd=0"), weights.len()),
        ]
    }
}
