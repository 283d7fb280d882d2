//! Error against run time, for several ways to render one scene.
//!
//! Every method gets independent runs (own seeds) of 1, 2, 4, ... samples a pixel. The squared error of a run is its
//! squared distance from a reference less the reference's own squared error, which is known from its replicates; the
//! runs' spread gives the interval. From the curves follow slopes, the time at which each reaches a target, and the
//! ratio of these times for each pair, with errors by the jackknife over runs. Meaning and limits: docs/converge.md.

mod curve;
mod method;
mod picture;
mod reference;
mod run;

pub use curve::{CONFIDENCE, Curve, Known, Level, Point, Reached};
pub use method::Method;
pub use picture::{chart, csv};
pub use reference::Reference;
pub use run::{Clock, Measured};

use crate::build::Places;
use crate::error::Error;
use crate::overrides::Overrides;
use crate::scene::{LightSpec, SceneFile};
use sampling::student_quantile;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use tracer::Strategy;

/// Bytes of a film's sums, a pixel and replicate.
const FILM_BYTES: u64 = 24;
/// Most bytes all films together may take.
const MAX_BYTES: u64 = 8 << 30;

/// What is compared and for how long.
#[derive(Clone, Debug)]
pub struct Options {
    /// The methods.
    pub methods: Vec<Method>,
    /// Changes to the scene that all methods share; sampler and points are theirs.
    pub overrides: Overrides,
    /// Seconds a method, all its runs together; the first level is always taken.
    pub seconds: f64,
    /// Most samples a pixel.
    pub spp_max: u32,
    /// Independent runs a method, at least 3.
    pub runs: u32,
    /// Decides all random choices.
    pub seed: u64,
    /// Worker threads; `None`: all cores.
    pub threads: Option<NonZeroUsize>,
    /// A picture to compare with; `None` renders one.
    pub reference: Option<PathBuf>,
    /// How that one is rendered.
    pub reference_method: Method,
    /// For how long.
    pub reference_seconds: f64,
    /// Or with how many samples a pixel, whatever the time.
    pub reference_spp: Option<u32>,
    /// Relative RMSE the times to reach which are compared; `None`: the least that every method resolves.
    pub target: Option<f64>,
}

/// What came of one method.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The method.
    pub method: Method,
    /// Seconds to read the material and build its sampler, which the curve does not contain.
    pub build_seconds: f64,
    /// Error against time.
    pub curve: Curve,
    /// When it reaches the target; `None` if it never does as far as can be told.
    pub reached: Option<Reached>,
}

/// How many times longer one method takes than another.
#[derive(Clone, Debug)]
pub struct Ratio {
    /// Index of the slower method.
    pub slower: usize,
    /// Index of the faster one.
    pub faster: usize,
    /// Time over time, at least 1.
    pub value: f64,
    /// Its interval.
    pub ci: [f64; 2],
    /// Whether either time lies on a line continued beyond its points.
    pub extrapolated: bool,
}

/// The comparison, complete or as far as it got.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The scene, as it calls itself.
    pub scene: String,
    /// What the pictures were compared with.
    pub reference: Reference,
    /// Relative RMSE of the times to target.
    pub target: f64,
    /// The methods, in the order asked for.
    pub entries: Vec<Entry>,
    /// Each pair that both reach the target.
    pub ratios: Vec<Ratio>,
    /// Whether it was ended before all methods were done.
    pub interrupted: bool,
}

/// Measures all methods. `partial` is shown the outcome so far after the reference and after each of them, so
/// that nothing is lost.
///
/// # Errors
/// Whatever [`crate::build_scene`] refuses; a strategy that cannot find the scene's lights; a reference that does not
/// fit; more memory than allowed; what `partial` returns.
pub fn run(
    scene: &SceneFile,
    places: &Places,
    options: &Options,
    clock: &Clock<'_>,
    partial: &mut dyn FnMut(&Outcome) -> Result<(), Error>,
) -> Result<Outcome, Error> {
    // everything is refused before the first sample, not after an hour
    let applied = options.overrides.apply(scene.clone())?;
    let size = (applied.film.width, applied.film.height);
    check(&applied, options)?;
    let from = (scene, places);
    let reference = match &options.reference {
        Some(path) => Reference::load(path, size)?,
        None => Reference::render(from, options.reference_method, options, clock)?,
    };
    let mut outcome = Outcome {
        scene: scene.path.display().to_string(),
        target: options.target.unwrap_or(f64::NAN),
        reference,
        entries: Vec::new(),
        ratios: Vec::new(),
        interrupted: false,
    };
    partial(&outcome)?;
    for numbered in options.methods.iter().copied().enumerate() {
        if clock.stopped() {
            break;
        }
        let measured = run::measure(from, numbered, &outcome.reference, options, clock)?;
        if !measured.levels.is_empty() {
            outcome.entries.push(Entry {
                method: measured.method,
                build_seconds: measured.build_seconds,
                curve: Curve::new(measured.levels, &outcome.reference),
                reached: None,
            });
        }
        outcome.compare(options.target);
        partial(&outcome)?;
    }
    outcome.interrupted = clock.stopped();
    Ok(outcome)
}

fn check(scene: &SceneFile, options: &Options) -> Result<(), Error> {
    let pixels = u64::from(scene.film.width) * u64::from(scene.film.height);
    let bytes = pixels * FILM_BYTES * u64::from(options.runs.max(8));
    if bytes > MAX_BYTES {
        return Err(Error::invalid(format!(
            "expected films of at most {MAX_BYTES} bytes in all, found {bytes}: choose a smaller size or fewer runs"
        )));
    }
    let mut all = options.methods.iter().chain([&options.reference_method]);
    let singular = (scene.lights.iter())
        .any(|l| matches!(l, LightSpec::Point { .. } | LightSpec::Directional { .. }));
    if let Some(method) = all.find(|m| singular && m.strategy == Strategy::BsdfOnly) {
        return Err(Error::invalid(format!(
            "expected a light strategy that finds point and directional lights, found \"bsdf\" in {method}"
        )));
    }
    Ok(())
}

impl Outcome {
    /// Times to the target and their ratios, from the curves there are.
    fn compare(&mut self, target: Option<f64>) {
        let least = self.entries.iter().filter_map(|e| e.curve.least_error());
        self.target = target.unwrap_or_else(|| least.fold(0.0, f64::max));
        for entry in &mut self.entries {
            entry.reached = entry.curve.reaches(self.target, &self.reference);
        }
        self.ratios.clear();
        for a in 0..self.entries.len() {
            for b in a + 1..self.entries.len() {
                self.ratios.extend(self.ratio(a, b));
            }
        }
    }

    fn ratio(&self, a: usize, b: usize) -> Option<Ratio> {
        let (x, y) = (self.entries[a].reached?, self.entries[b].reached?);
        let ln = x.ln_seconds.value - y.ln_seconds.value;
        let error = x.ln_seconds.error.hypot(y.ln_seconds.error);
        let runs = self.entries[a]
            .curve
            .runs()
            .min(self.entries[b].curve.runs());
        let degrees = u32::try_from(runs).unwrap_or(u32::MAX).saturating_sub(1);
        let half = student_quantile(CONFIDENCE, degrees) * error;
        let (slower, faster) = if ln >= 0.0 { (a, b) } else { (b, a) };
        Some(Ratio {
            slower,
            faster,
            value: ln.abs().exp(),
            ci: [(ln.abs() - half).exp(), (ln.abs() + half).exp()],
            extrapolated: x.extrapolated || y.extrapolated,
        })
    }
}
