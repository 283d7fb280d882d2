//! How far a model is from the data: four metrics, each as a sum of squared residuals.

use std::fmt;
use std::str::FromStr;

/// What is minimised. With y the data, m the model, ci the cosine of the light, each a weighted sum over pairs of
/// directions of a squared residual r(y, m), averaged over channels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default)]
pub enum Metric {
    /// r = (y - m) ci, measure dwi dwo; the error is the root of the mean [Ngan2005].
    #[default]
    Ngan,
    /// r = ln(1 + y ci) - ln(1 + m ci), measure ci co dwi dwo; the error is the mean of squares [Low2012].
    Log,
    /// r = cbrt(y ci) - cbrt(m ci), measure ci co dwi dwo; the error is the root of the mean [Fores2012].
    CubeRoot,
    /// r = (y - m) / sqrt(m), measure ci co dwi dwo; the error is the relative variance
    /// (integral y^2/m)(integral m)/(integral y)^2 - 1 of importance sampling pairs of directions by the model: the
    /// best fit is the best proposal.
    RelVar,
}

/// Smallest model value the metrics that divide by it or take its root see, 1/sr; far under what any instrument reads.
const FLOOR: f64 = 1e-12;

impl Metric {
    /// Every metric.
    pub const ALL: [Self; 4] = [Self::Ngan, Self::Log, Self::CubeRoot, Self::RelVar];

    /// What is typed.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ngan => "ngan",
            Self::Log => "log",
            Self::CubeRoot => "cuberoot",
            Self::RelVar => "relvar",
        }
    }

    /// Whether the residual is linear in the model, so that the best weights follow in one step.
    #[must_use]
    pub const fn is_linear(self) -> bool {
        matches!(self, Self::Ngan)
    }

    /// The weight of a pair besides its solid angles, from the cosines of light and viewer.
    #[inline]
    #[must_use]
    pub fn measure(self, ci: f64, co: f64) -> f64 {
        match self {
            Self::Ngan => 1.0,
            _ => ci * co,
        }
    }

    /// Residual and its derivative by `m`. The metrics that are not linear take negative data as 0.
    #[inline]
    #[must_use]
    pub fn residual(self, y: f64, m: f64, ci: f64) -> (f64, f64) {
        match self {
            Self::Ngan => ((y - m) * ci, -ci),
            Self::Log => {
                let (y, m) = (y.max(0.0), m.max(0.0));
                // ln((1 + y ci)/(1 + m ci)), exact where the two are close
                let r = ((y - m) * ci / (1.0 + m * ci)).ln_1p();
                (r, -ci / (1.0 + m * ci))
            }
            Self::CubeRoot => {
                let root = (m.max(FLOOR) * ci).cbrt();
                ((y.max(0.0) * ci).cbrt() - root, -ci / (3.0 * root * root))
            }
            Self::RelVar => {
                let (y, m) = (y.max(0.0), m.max(FLOOR));
                let root = m.sqrt();
                ((y - m) / root, -(y + m) / (2.0 * m * root))
            }
        }
    }

    /// How much a datum can say, for drawing subsets: the squared residual against a black model, or its like.
    #[inline]
    #[must_use]
    pub fn importance(self, y: f64, ci: f64) -> f64 {
        match self {
            // against black the residual is infinite; near the fit it is of the order of sqrt(y)
            Self::RelVar => y.max(0.0),
            _ => {
                let r = self.residual(y, 0.0, ci).0;
                r * r
            }
        }
    }

    /// The reported error from the sums over pairs and channels.
    #[must_use]
    pub fn error(self, sums: &Sums) -> f64 {
        let mean = sums.squares / sums.weight;
        match self {
            Self::Ngan | Self::CubeRoot => mean.max(0.0).sqrt(),
            Self::Log => mean,
            Self::RelVar => sums.rel_var.iter().sum::<f64>() / sums.rel_var.len().max(1) as f64,
        }
    }
}

/// What [`Metric::error`] is made of.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Sums {
    /// Sum of weights over pairs and channels.
    pub weight: f64,
    /// Sum of weighted squared residuals.
    pub squares: f64,
    /// For [`Metric::RelVar`]: (integral y^2/m)(integral m)/(integral y)^2 - 1 per channel.
    pub rel_var: Vec<f64>,
}

impl fmt::Display for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for Metric {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let known = || Self::ALL.map(Self::name).join(", ");
        (Self::ALL.into_iter().find(|m| m.name() == text))
            .ok_or_else(|| format!("expected one of {}, found {text:?}", known()))
    }
}

#[cfg(test)]
mod tests {
    use super::Metric;

    #[test]
    fn residuals_on_hand_cases() {
        // y = 3, m = 1, ci = 1/2
        let cases = [
            (Metric::Ngan, 1.0),
            (Metric::Log, 2.5_f64.ln() - 1.5_f64.ln()),
            (Metric::CubeRoot, 1.5_f64.cbrt() - 0.5_f64.cbrt()),
            (Metric::RelVar, 2.0),
        ];
        for (metric, expected) in cases {
            let r = metric.residual(3.0, 1.0, 0.5).0;
            assert!((r - expected).abs() < 1e-15, "{metric}: {r} {expected}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_residuals() {
        for metric in Metric::ALL {
            for (y, m, ci) in [(3.0, 1.0, 0.5), (0.01, 0.2, 0.9), (0.0, 4.0, 0.1)] {
                let h = 1e-6 * m;
                let (up, down) = (
                    metric.residual(y, m + h, ci).0,
                    metric.residual(y, m - h, ci).0,
                );
                let (numeric, exact) = ((up - down) / (2.0 * h), metric.residual(y, m, ci).1);
                // central differences: h^2 of the third derivative, and rounding over h
                assert!(
                    (numeric - exact).abs() < 1e-8 * exact.abs(),
                    "{metric} at {y} {m} {ci}: {numeric} {exact}"
                );
            }
        }
    }

    #[test]
    fn names_are_read_back() {
        for metric in Metric::ALL {
            assert_eq!(metric.name().parse(), Ok(metric), "{metric}");
        }
        let refused = "rms".parse::<Metric>();
        assert_eq!(
            refused.unwrap_err(),
            "expected one of ngan, log, cuberoot, relvar, found \"rms\""
        );
    }
}
