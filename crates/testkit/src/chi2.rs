//! The chi-square test of a direction sampler against its density, with random numbers of its own.

use crate::rng::Rng;
pub use sampling::chi2::{Cell, Chi2Report, Fault};
use sampling::{Domain, chi2};

/// What to test and how hard.
#[derive(Clone, Debug, PartialEq)]
pub struct Config {
    /// Where the samples lie.
    pub domain: Domain,
    /// Samples counted; a quarter more is drawn for the pilot.
    pub samples: usize,
    /// Seed of the random numbers handed to the sampler.
    pub seed: u64,
    /// Probability of rejecting a correct sampler, over all `tests` together.
    pub level: f64,
    /// How many chi-square tests share `level` [Sidak1967].
    pub tests: usize,
}

impl Default for Config {
    /// Seed 0; the rest as [`chi2::Config`].
    fn default() -> Self {
        let chi2::Config {
            domain,
            samples,
            level,
            tests,
        } = chi2::Config::default();
        Self {
            domain,
            samples,
            seed: 0,
            level,
            tests,
        }
    }
}

/// Compares `sample` (`None`: nothing sampled) with the density `pdf` it claims, per the measure of the
/// domain: [`chi2::test`] on the stream of `config.seed`.
///
/// The report is the verdict: assert its `ok` with the report as the message. All randomness comes from the
/// generator handed to `sample`.
pub fn test(
    config: &Config,
    mut sample: impl FnMut(&mut Rng) -> Option<[f64; 3]>,
    pdf: impl Fn([f64; 3]) -> f64,
) -> Chi2Report {
    let mut rng = Rng::new(config.seed);
    let plain = chi2::Config {
        domain: config.domain,
        samples: config.samples,
        level: config.level,
        tests: config.tests,
    };
    chi2::test(&plain, || sample(&mut rng), pdf)
}
