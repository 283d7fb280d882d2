//! The quantities that are interpolated: the log of the luminance, and every channel's ratio to it.
//!
//! Interpolating ratios linearly commutes with any linear change of channels, so that the RGB and the
//! spectral file of one material give the same colours; and a channel may be negative without its log being taken.

use crate::scattered::cloud::{SampleCloud, dot};

/// Encodes values v as (ln m, v / m) with m = hypot(luminance, floor).
///
/// The floor, a thousandth of the median luminance, keeps m positive for rows without light: they too are
/// returned exactly.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LogRatio {
    weights: Vec<f64>,
    floor: f64,
}

impl LogRatio {
    /// The code that fits the rows of `cloud`.
    pub(crate) fn new(cloud: &SampleCloud) -> Self {
        let mut weights = cloud.luminance_weights().to_vec();
        let mut sorted = sizes(cloud, &weights);
        if sorted.last().is_none_or(|&most| most <= 0.0) {
            // bands the eye does not see: their mean stands in
            let equal = 1.0 / weights.len() as f64;
            weights.fill(equal);
            sorted = sizes(cloud, &weights);
        }
        let median = sorted.get(sorted.len() / 2).copied().unwrap_or(0.0);
        let most = sorted.last().copied().unwrap_or(0.0);
        let floor = (1e-3 * median).max(1e-6 * most);
        let floor = if floor > 0.0 { floor } else { 1.0 };
        Self { weights, floor }
    }

    /// m of a row.
    pub(crate) fn size(&self, values: &[f64]) -> f64 {
        dot(values, &self.weights).hypot(self.floor)
    }

    /// Appends ln m and the ratios.
    pub(crate) fn encode(&self, values: &[f64], out: &mut Vec<f64>) {
        let size = self.size(values);
        out.push(size.ln());
        out.extend(values.iter().map(|v| v / size));
    }

    /// All rows, encoded, row-major.
    pub(crate) fn encode_all(&self, cloud: &SampleCloud) -> Vec<f64> {
        let mut out = Vec::with_capacity(cloud.len() * (cloud.basis().len() + 1));
        (0..cloud.len()).for_each(|r| self.encode(cloud.values(r), &mut out));
        out
    }
}

/// Values from ln m and, in place, the ratios. Sizes beyond any reflectance are cut so that nothing overflows.
#[inline]
pub(crate) fn decode(log_size: f64, ratios: &mut [f64]) {
    let size = log_size.min(200.0).exp();
    ratios.iter_mut().for_each(|r| *r *= size);
}

/// Luminances without sign, ascending.
fn sizes(cloud: &SampleCloud, weights: &[f64]) -> Vec<f64> {
    let mut sizes: Vec<f64> = (0..cloud.len())
        .map(|r| dot(cloud.values(r), weights).abs())
        .collect();
    sizes.sort_by(f64::total_cmp);
    sizes
}
