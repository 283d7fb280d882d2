//! Rough diffuse models, which are not linear in their albedo because light bounces more than once.
//!
//! For a fixed shape f is a smooth function of the albedo alone: it is interpolated in it through Chebyshev points of
//! [0, 1], so that the model becomes a sum of lobes (its values at these albedos) times polynomials of the albedo.

use super::{build, channels, over, times};
use crate::family::{Channels, Family, Lobes, Part, Scale, ShapeParameter, Weight};

/// A model of one albedo `kd` and one shape parameter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) name: &'static str,
    parameter: &'static str,
    range: (f64, f64),
}

/// Oren-Nayar is quadratic in the albedo. EON has the factor 1/(1 - kd (1 - E)) with E > 0.8, whose pole at kd > 5 lets
/// eight points reach (2 t)^-8 < 1e-10, t = 10 being the pole's distance in half-widths of the interval.
pub(super) const ENTRIES: &[Entry] = &[
    Entry {
        name: "oren-nayar",
        parameter: "sigma",
        range: (1e-3, std::f64::consts::FRAC_PI_2),
    },
    Entry {
        name: "eon",
        parameter: "r",
        range: (1e-3, 1.0),
    },
];

/// Points of the interpolation.
const NODES: usize = 8;

/// The albedos at which the model is evaluated.
fn nodes() -> [f64; NODES] {
    std::array::from_fn(|j| {
        let angle = (j as f64 + 0.5) * std::f64::consts::PI / NODES as f64;
        0.5 * (1.0 + angle.cos())
    })
}

pub(super) struct Albedo {
    entry: &'static Entry,
    shape: [ShapeParameter; 1],
    weights: [Weight; 1],
}

impl Albedo {
    pub(super) fn new(entry: &'static Entry) -> Self {
        Self {
            shape: [ShapeParameter {
                name: entry.parameter.into(),
                range: entry.range,
                scale: Scale::Log,
                starts: vec![0.05, 0.2, 0.5, 0.9],
            }],
            weights: [Weight {
                name: "kd".into(),
                signed: false,
            }],
            entry,
        }
    }

    fn text(&self, shape: f64, kd: &str) -> String {
        format!(
            "{}:{}={shape},kd={kd}",
            self.entry.name, self.entry.parameter
        )
    }
}

impl Family for Albedo {
    fn name(&self) -> &str {
        self.entry.name
    }

    fn shape(&self) -> &[ShapeParameter] {
        &self.shape
    }

    fn weights(&self) -> &[Weight] {
        &self.weights
    }

    fn lobe_count(&self) -> usize {
        NODES
    }

    fn is_linear(&self) -> bool {
        false
    }

    /// Lagrange's polynomials of the nodes at the albedo.
    fn coefficients(&self, weights: &[f64], out: &mut [f64]) {
        let (nodes, x) = (nodes(), weights[0]);
        for (j, out) in out.iter_mut().enumerate() {
            let others = (0..NODES).filter(|&k| k != j);
            *out = others
                .map(|k| (x - nodes[k]) / (nodes[j] - nodes[k]))
                .product();
        }
    }

    fn lobes(&self, shape: &[f64]) -> Box<dyn Lobes> {
        let kd = nodes().map(|k| k.to_string()).join("/");
        Box::new(Channels(
            build::<NODES>(&self.text(shape[0], &kd)).built.brdf,
        ))
    }

    fn parts(&self, shape: &[f64], weights: &[Vec<f64>]) -> Vec<Part> {
        // an albedo above 1 is no albedo: the brightest channel is brought to 1, the factor says by how much
        let largest = weights.iter().map(|w| w[0]).fold(1.0, f64::max);
        let kd = channels(&over(weights, largest), 0);
        let text = self.text(shape[0], &kd);
        vec![times(largest, text, weights.len())]
    }
}

#[cfg(test)]
mod tests {
    use super::{Albedo, ENTRIES, NODES};
    use crate::family::Family;
    use brdf::direction;
    use brdf_models::parse_model_n;

    #[test]
    fn interpolation_in_the_albedo_is_exact() {
        let (wi, wo) = (direction(1.0, 0.0), direction(0.7, 2.0));
        for entry in ENTRIES {
            let family = Albedo::new(entry);
            for shape in [0.05, 0.5, 1.0] {
                let lobes = family.lobes(&[shape]);
                for kd in [0.0, 0.2, 0.777, 1.0] {
                    let (mut factors, mut values) = ([0.0; NODES], [0.0; NODES]);
                    family.coefficients(&[kd], &mut factors);
                    lobes.eval(wi, wo, &mut values);
                    let sum: f64 = factors.iter().zip(values).map(|(a, b)| a * b).sum();
                    let text = family.text(shape, &kd.to_string());
                    let exact = parse_model_n::<1>(&text).unwrap().built.brdf.eval(wi, wo)[0];
                    // see ENTRIES
                    assert!((sum - exact).abs() < 1e-9, "{text}: {sum} {exact}");
                }
            }
        }
    }
}
