//! How well an interpolant predicts rows it has not seen.

use crate::scattered::cloud::{Geometry, SAME_ANGLE, SampleCloud, dot};
use crate::scattered::error::CloudError;
use crate::scattered::kd_nearest::KdNearest;
use crate::scattered::layered::{LayerMode, LayeredTable};
use crate::scattered::policy::Policies;
use crate::scattered::thin_plate::ThinPlate;
use brdf::Measured;

/// Every interpolant of scattered rows, by the name the program uses.
pub const SCHEMES: [(&str, Scheme); 6] = [
    ("layered-squared", Scheme::Layered(LayerMode::SquaredLambda)),
    ("layered-linear", Scheme::Layered(LayerMode::Linear)),
    ("layered-log", Scheme::Layered(LayerMode::LogLinear)),
    ("layered-nearest", Scheme::Layered(LayerMode::Nearest)),
    ("kd-nearest", Scheme::KdNearest),
    ("thin-plate", Scheme::ThinPlate),
];

/// A way to interpolate a cloud.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// [`LayeredTable`].
    Layered(LayerMode),
    /// [`KdNearest`].
    KdNearest,
    /// [`ThinPlate`] with default policies.
    ThinPlate,
}

impl Scheme {
    /// The interpolant over the rows of `cloud`.
    ///
    /// # Errors
    /// If the rows do not permit it.
    pub fn build(self, cloud: &SampleCloud) -> Result<Box<dyn Measured>, CloudError> {
        Ok(match self {
            Self::Layered(mode) => Box::new(LayeredTable::new(cloud, mode)),
            Self::KdNearest => Box::new(KdNearest::new(cloud)?),
            Self::ThinPlate => Box::new(ThinPlate::with_policies(cloud, Policies::default())?),
        })
    }
}

/// Errors of predicted luminance; logs are natural.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scores {
    /// Rows predicted.
    pub rows: usize,
    /// Median of |ln predicted/measured|.
    pub median_log: f64,
    /// Root mean square of ln predicted/measured for theta_h below 12 degrees; NaN if there is no such row.
    pub specular_rms_log: f64,
    /// The same over all rows.
    pub rms_log: f64,
    /// Norm of (predicted - measured) cos theta_o over that of measured cos theta_o.
    pub relative_l2: f64,
}

/// Leaves out one ring of incidence at a time, all but the first and last, and predicts it from the others.
///
/// # Errors
/// If there are fewer than three rings, or a cloud cannot be interpolated.
pub fn leave_one_ring_out(cloud: &SampleCloud, scheme: Scheme) -> Result<Scores, CloudError> {
    let mut rings: Vec<f64> = Vec::new();
    for g in cloud.geometry() {
        if rings
            .last()
            .is_none_or(|&last| g.theta_i - last > SAME_ANGLE)
        {
            rings.push(g.theta_i);
        }
    }
    let on = |ring: f64, g: Geometry| (g.theta_i - ring).abs() <= SAME_ANGLE;
    let mut tally = Tally::default();
    for &ring in rings.iter().skip(1).take(rings.len().saturating_sub(2)) {
        tally.predict(cloud, scheme, |_, g| on(ring, g))?;
    }
    tally.scores()
}

/// Leaves out every tenth row at a time, and predicts it from the others.
///
/// # Errors
/// If a cloud cannot be interpolated.
pub fn leave_tenth_out(cloud: &SampleCloud, scheme: Scheme) -> Result<Scores, CloudError> {
    let mut tally = Tally::default();
    for fold in 0..10 {
        tally.predict(cloud, scheme, |row, _| row % 10 == fold)?;
    }
    tally.scores()
}

/// Mirror-like: rows whose half vector is this close to the normal, radians.
const SPECULAR: f64 = 12.0 * std::f64::consts::PI / 180.0;

/// (theta_h, cos theta_o, measured, predicted) of every row left out.
#[derive(Default)]
struct Tally(Vec<[f64; 4]>);

impl Tally {
    fn predict(
        &mut self,
        cloud: &SampleCloud,
        scheme: Scheme,
        left_out: impl Fn(usize, Geometry) -> bool,
    ) -> Result<(), CloudError> {
        let Some(training) = cloud.filtered(|r, g| !left_out(r, g)) else {
            return Ok(());
        };
        let interpolant = scheme.build(&training)?;
        let mut values = vec![0.0; cloud.basis().len()];
        for (row, &g) in cloud
            .geometry()
            .iter()
            .enumerate()
            .filter(|&(r, &g)| left_out(r, g))
        {
            let (wi, wo) = g.directions();
            interpolant.eval_native(wi, wo, &mut values);
            let predicted = dot(&values, cloud.luminance_weights());
            self.0.push([
                g.half_diff().theta_h,
                g.theta_o.cos(),
                cloud.luminance(row),
                predicted,
            ]);
        }
        Ok(())
    }

    /// Rows that measured no light have no log and count in the norm alone.
    fn scores(self) -> Result<Scores, CloudError> {
        let log = |r: &[f64; 4]| (r[3].max(1e-9) / r[2]).ln().abs();
        let lit = || self.0.iter().filter(|r| r[2] > 0.0);
        let mut logs: Vec<f64> = lit().map(log).collect();
        if logs.is_empty() {
            return Err(CloudError::NothingToCompare {
                expected: "rows to leave out",
            });
        }
        logs.sort_by(f64::total_cmp);
        let specular: Vec<f64> = lit().filter(|r| r[0] < SPECULAR).map(log).collect();
        let rms = |x: &[f64]| (x.iter().map(|e| e * e).sum::<f64>() / x.len() as f64).sqrt();
        let norm =
            |f: fn(&[f64; 4]) -> f64| self.0.iter().map(|r| (r[1] * f(r)).powi(2)).sum::<f64>();
        Ok(Scores {
            rows: self.0.len(),
            median_log: logs[logs.len() / 2],
            specular_rms_log: if specular.is_empty() {
                f64::NAN
            } else {
                rms(&specular)
            },
            rms_log: rms(&logs),
            relative_l2: (norm(|r| r[3] - r[2]) / norm(|r| r[2])).sqrt(),
        })
    }
}
