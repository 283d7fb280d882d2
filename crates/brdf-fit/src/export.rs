//! A fit as text for other programs, each with the error of what the target really evaluates.

mod abg;
mod ggx;
mod glsl;
mod mitsuba;
mod pbrt;
mod scene;

pub use ggx::{MetalMix, Shadowing};

use crate::metric::Metric;
use crate::samples::Samples;
use crate::{Fit, FitError, Part};
use brdf::Brdf;
use brdf_models::parse_model;
use glam::DVec3;
use std::sync::Arc;

/// A file for another program.
#[derive(Clone, Debug, PartialEq)]
pub struct Export {
    /// What it is for: `scene`, `mitsuba`, `pbrt`, `glsl`, `abg`.
    pub target: &'static str,
    /// The name it is written under, without folders.
    pub file: &'static str,
    /// The content.
    pub text: String,
    /// What the target evaluates: the name of the best model, or of the nearest one it has.
    pub model: String,
    /// The error of that over the same data in the same metric.
    pub error: f64,
}

/// Every export of a fit. `ggx` is a GGX fit of the same data, from which the nearest material of renderers without the
/// best model is made; `abg` one of the family `abg`, for optics; `samples` (a subset will do) is what the nearest material is chosen on and judged by.
///
/// # Errors
/// [`FitError::Channels`] unless the fits have three channels.
pub fn exports(
    best: &Fit,
    (ggx, abg): (&Fit, &Fit),
    samples: &Samples,
) -> Result<Vec<Export>, FitError> {
    for fit in [best, ggx, abg] {
        if fit.weights.len() != 3 {
            return Err(FitError::Channels(fit.weights.len()));
        }
    }
    let metric = best.metric;
    let shader = match glsl::text(&best.parts) {
        Some(text) => (text, best.name.clone(), best.error),
        None => {
            let text = glsl::text(&ggx.parts).unwrap_or_default();
            (text, ggx.name.clone(), ggx.error)
        }
    };
    let correlated = MetalMix::nearest(ggx, samples, metric, Shadowing::Correlated);
    let separable = MetalMix::nearest(ggx, samples, metric, Shadowing::Separable);
    Ok(vec![
        Export {
            target: "scene",
            file: "best.ron",
            text: scene::text(&best.parts),
            model: best.name.clone(),
            error: best.error,
        },
        Export {
            target: "mitsuba",
            file: "best.xml",
            text: mitsuba::text(&separable.0),
            model: "diffuse + rough conductor (GGX)".into(),
            error: separable.1,
        },
        Export {
            target: "pbrt",
            file: "best.pbrt",
            text: pbrt::text(&correlated.0),
            model: "diffuse + conductor (GGX)".into(),
            error: correlated.1,
        },
        Export {
            target: "glsl",
            file: "best.glsl",
            text: shader.0,
            model: shader.1,
            error: shader.2,
        },
        Export {
            target: "abg",
            file: "best.abg.txt",
            text: abg::text(abg)?,
            model: "ABg + diffuse".into(),
            error: abg.error,
        },
    ])
}

/// The `materials` of a scene that evaluate a fit; the last one is called `name`.
#[must_use]
pub fn scene_materials(name: &str, parts: &[Part]) -> String {
    scene::materials(name, parts)
}

/// The sum of parts as reflectance.
#[expect(missing_debug_implementations, reason = "trait objects have none")]
pub struct Model3(Vec<(Arc<dyn Brdf<3>>, [f64; 3])>);

impl Model3 {
    /// The parts of a fit of three channels, read back from their text.
    ///
    /// # Errors
    /// If a text names no model or the factors are not three.
    pub fn new(parts: &[Part]) -> Result<Self, FitError> {
        let part = |p: &Part| {
            let model = parse_model(&p.text).map_err(|e| FitError::Text(e.to_string()))?;
            let scale = <[f64; 3]>::try_from(&p.scale[..]);
            let scale = scale.map_err(|_| FitError::Channels(p.scale.len()))?;
            Ok((model.built.brdf, scale))
        };
        parts.iter().map(part).collect::<Result<_, _>>().map(Self)
    }
}

impl Brdf<3> for Model3 {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (model, scale) in &self.0 {
            let f = model.eval(wi, wo);
            (0..3).for_each(|c| sum[c] += scale[c] * f[c]);
        }
        sum
    }
}

/// Three numbers with `separator` between them, to seven digits.
fn rgb(v: [f64; 3], separator: &str) -> String {
    v.map(|v| format!("{v:.7}")).join(separator)
}

/// The error of a renderer's material.
fn error(model: &impl Brdf<3>, samples: &Samples, metric: Metric) -> f64 {
    crate::error_of::<3>(model, samples, metric)
}
