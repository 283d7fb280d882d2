//! How far a measurement is from f(wi, wo) = f(wo, wi).

use crate::scattered::cloud::{Geometry, SampleCloud, dot};
use crate::scattered::domain::Domain;
use crate::scattered::error::CloudError;
use brdf::Measured;

/// ln f(i,o)/f(o,i) against ln cos i / cos o, over the rows whose swapped pair lies in the measured region.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reciprocity {
    /// Pairs compared.
    pub pairs: usize,
    /// Slope of the log ratio on the log cosine ratio, through the origin as symmetry demands; 0 if reciprocal.
    pub slope: f64,
    /// Their correlation, [-1, 1].
    pub correlation: f64,
    /// Median of |ln f(i,o)/f(o,i)|.
    pub median: f64,
}

/// Compares each row with what `interpolant` has for the swapped pair.
///
/// # Errors
/// If no row has a swapped pair in the measured region.
pub fn non_reciprocity(
    cloud: &SampleCloud,
    interpolant: &dyn Measured,
) -> Result<Reciprocity, CloudError> {
    let domain = Domain::new(cloud);
    let mut swapped = vec![0.0; cloud.basis().len()];
    let mut pairs = Vec::new();
    for (row, &g) in cloud.geometry().iter().enumerate() {
        let back = Geometry {
            theta_i: g.theta_o,
            theta_o: g.theta_i,
            phi: g.phi,
        };
        if !domain.contains(back) {
            continue;
        }
        let (wi, wo) = back.directions();
        interpolant.eval_native(wi, wo, &mut swapped);
        let (there, back) = (
            cloud.luminance(row),
            dot(&swapped, cloud.luminance_weights()),
        );
        if there > 0.0 && back > 0.0 {
            pairs.push((
                (g.theta_i.cos() / g.theta_o.cos()).ln(),
                (there / back).ln(),
            ));
        }
    }
    if pairs.is_empty() {
        return Err(CloudError::NothingToCompare {
            expected: "rows whose swapped pair was measured",
        });
    }
    let sum = |f: fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
    let (xx, xy, yy) = (sum(|p| p.0 * p.0), sum(|p| p.0 * p.1), sum(|p| p.1 * p.1));
    let mut sizes: Vec<f64> = pairs.iter().map(|p| p.1.abs()).collect();
    sizes.sort_by(f64::total_cmp);
    Ok(Reciprocity {
        pairs: pairs.len(),
        slope: if xx > 0.0 { xy / xx } else { 0.0 },
        correlation: if xx * yy > 0.0 {
            xy / (xx * yy).sqrt()
        } else {
            0.0
        },
        median: sizes[sizes.len() / 2],
    })
}
