//! One material, one sampler: everything by which samplers are compared.
//!
//! Variances and weights come from the sampler's own samples ([`brdf_sampling::sampler_report`]), costs from the clock,
//! and the verdict from chi-square tests of samples against the density they claim, at several viewers.

mod cost;
mod verdict;

pub use verdict::{TEST_DEG, Verdict};

use crate::cache::Cache;
use crate::error::Error;
use crate::material::{self, Surface, Visitor, luminance};
use crate::scene::SamplerName;
use brdf::{Brdf, DirectionSampler, direction};
use brdf_sampling::{
    OFF_GRID, SHOWN_DEG, SamplerCost, SamplerReport, Target, off_grid_deg, packet_cost,
    sampler_cost, sampler_report,
};
use glam::DVec3;
use rayon::prelude::*;

/// Samples a viewer, unless the time is short.
const SAMPLES: usize = 20_000;
/// Batches of a thousand calls, the best of which is a cost.
const BATCHES: usize = 40;
/// A sampler this slow, in nanoseconds, is timed by fewer calls: 40 batches would take a second and more.
const SLOW_NS: f64 = 25_000.0;

/// What to spend on a sampler, and how hard to test it.
#[derive(Clone, Copy, Debug)]
pub struct SurveyOptions {
    /// Seconds of drawing samples, about; methods that need more get fewer samples.
    pub seconds: f64,
    /// How many samplers are judged together: they share the level of the chi-square tests.
    pub methods: usize,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Survey {
    /// The sampler; never `auto`.
    pub name: SamplerName,
    /// Seconds its tables took.
    pub build_seconds: f64,
    /// Variances, weights, waste, tries, bytes.
    pub report: SamplerReport,
    /// Samples a viewer on which `report` rests.
    pub samples: usize,
    /// One call after another.
    pub cost: SamplerCost,
    /// In packets, as renderers call it; `None` for slow samplers, which have no packets of their own.
    pub packets: Option<SamplerCost>,
    /// Whether samples agree with the density; `None` where too few could be drawn in the time.
    pub verdict: Option<Verdict>,
    /// Whether low-discrepancy points keep their gain.
    pub keeps_stratification: bool,
    /// What a reader may want to know.
    pub notes: Vec<String>,
}

impl Surface {
    /// Builds the sampler `name` stands for and measures it on the luminance of this reflectance.
    ///
    /// # Errors
    /// If that sampler does not go with this reflectance.
    pub fn survey(
        &self,
        name: SamplerName,
        options: SurveyOptions,
        cache: &Cache,
    ) -> Result<Survey, Error> {
        let measuring = Measuring {
            brdf: self.brdf(),
            options,
        };
        self.sampler(name, cache, measuring)
    }

    /// The colour floor J*: the least relative variance, mean over channels and over the 24 viewers of a survey, that
    /// one density for all channels can have.
    ///
    /// # Errors
    /// None for reflectances that can be tabulated, as all can today.
    pub fn colour_floor(&self, cache: &Cache) -> Result<f64, Error> {
        self.sampler(SamplerName::HvtFine, cache, Floor(self.brdf()))
    }

    /// The samplers that go with this reflectance, simplest first.
    #[must_use]
    pub fn samplers(&self) -> Vec<SamplerName> {
        let all = SamplerName::ALL.iter().rev().copied();
        all.filter(|name| match name {
            SamplerName::Auto => false,
            SamplerName::Native => self.has_native_sampler(),
            _ => true,
        })
        .collect()
    }
}

struct Floor<'a>(&'a dyn Brdf<3>);

impl Visitor for Floor<'_> {
    type Out = f64;

    fn visit<S: DirectionSampler + 'static>(self, sampler: S, _: material::SamplerReport) -> f64 {
        let at = |k| direction(off_grid_deg(k).to_radians(), 0.0);
        let floors = (0..OFF_GRID).into_par_iter();
        floors
            .map(|k| {
                let f = |wi: DVec3, wo: DVec3, out: &mut [f64]| {
                    out.copy_from_slice(&self.0.eval(wi, wo));
                };
                brdf_sampling::colour_floor(f, 3, &sampler, at(k))
            })
            .sum::<f64>()
            / OFF_GRID as f64
    }
}

struct Measuring<'a> {
    brdf: &'a dyn Brdf<3>,
    options: SurveyOptions,
}

impl Visitor for Measuring<'_> {
    type Out = Survey;

    fn visit<S: DirectionSampler + 'static>(
        self,
        sampler: S,
        chosen: material::SamplerReport,
    ) -> Survey {
        let f = |wi: DVec3, wo: DVec3| luminance(self.brdf, wi, wo);
        let target = Target {
            f: &f,
            lanes: None,
            symmetry: self.brdf.symmetry(),
        };
        let probe = cost::probe(&sampler);
        let mut notes = chosen.notes;
        let threads = rayon::current_num_threads() as f64;
        let affordable = self.options.seconds * threads * 1e9 / probe.sample_ns;
        let viewers = (SHOWN_DEG.len() + OFF_GRID) as f64;
        // at least a few: what they say carries its standard error
        let samples = ((affordable / viewers) as usize).clamp(16, SAMPLES);
        if samples < SAMPLES {
            notes.push(format!(
                "slow: figures rest on {samples} samples a viewer instead of {SAMPLES}"
            ));
        }
        let fast = probe.sample_ns < SLOW_NS;
        Survey {
            name: chosen.name,
            build_seconds: chosen.build_seconds,
            report: sampler_report(target, &sampler, samples),
            samples,
            cost: if fast {
                sampler_cost(&sampler, BATCHES)
            } else {
                probe
            },
            packets: fast.then(|| packet_cost(&sampler, BATCHES)),
            verdict: verdict::judge(&sampler, affordable, self.options.methods),
            keeps_stratification: sampler.keeps_stratification(),
            notes,
        }
    }
}
