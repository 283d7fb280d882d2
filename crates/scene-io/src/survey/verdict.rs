//! Whether a sampler draws what its density says.

use brdf::{DirectionSampler, direction};
use glam::DVec3;
use rayon::prelude::*;
use sampling::chi2::{self, Config};
use sampling::{Domain, Rng};

/// Viewers at which samples are tested against the density, degrees: on no table's grid.
pub const TEST_DEG: [f64; 5] = [4.3, 28.1, 52.7, 71.9, 84.3];
/// Samples a test where time allows.
const SAMPLES: usize = 100_000;
/// Fewer could not tell a sampler that is wrong by a tenth: cells expect five each.
const FEWEST: usize = 2_000;
/// Probability of rejecting any of the correct samplers judged together.
const LEVEL: f64 = 0.01;

/// The outcome of the chi-square tests of one sampler.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// Whether all viewers agree.
    pub ok: bool,
    /// The least p-value.
    pub p_value: f64,
    /// The level it was compared with.
    pub level: f64,
    /// Samples at each viewer.
    pub samples: usize,
    /// What is wrong, for the worst viewer.
    pub fault: Option<String>,
}

/// Tests `sampler` at all viewers; `affordable` is how many samples the time allows in all, `methods` how many samplers
/// share the level.
pub(super) fn judge(
    sampler: &dyn DirectionSampler,
    affordable: f64,
    methods: usize,
) -> Option<Verdict> {
    let samples = (affordable / (1.25 * TEST_DEG.len() as f64)) as usize;
    if samples < FEWEST {
        return None;
    }
    let config = Config {
        domain: Domain::Hemisphere,
        samples: samples.min(SAMPLES),
        level: LEVEL,
        tests: methods.max(1) * TEST_DEG.len(),
    };
    let test = |deg: &f64| {
        let wo = direction(deg.to_radians(), 0.0);
        let mut rng = Rng::new(deg.to_bits());
        let sample = || Some(sampler.sample(wo, rng.uniform2())?.wi.to_array());
        (
            *deg,
            chi2::test(&config, sample, |wi| sampler.pdf(DVec3::from(wi), wo)),
        )
    };
    let reports: Vec<_> = TEST_DEG.par_iter().map(test).collect();
    let (deg, worst) = reports.iter().min_by(|a, b| {
        let key = |r: &chi2::Chi2Report| if r.ok { r.p_value } else { -1.0 };
        key(&a.1).total_cmp(&key(&b.1))
    })?;
    Some(Verdict {
        ok: worst.ok,
        p_value: worst.p_value,
        level: worst.level,
        samples: config.samples,
        fault: (worst.fault).map(|fault| format!("at {deg} degrees: {fault:?}")),
    })
}
