//! The thesis' structure for ragged measurements: sorted layers of theta_i, in each theta_o, in each phi.

use crate::scattered::cloud::{Geometry, SAME_ANGLE, SampleCloud};
use crate::scattered::log_ratio::{LogRatio, decode};
use crate::scattered::policy::NegativePolicy;
use brdf::{Measured, Status, Symmetry};
use glam::DVec3;
use spectrum::Basis;
use std::ops::Range;

/// How values between two entries of a layer are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LayerMode {
    /// The nearer entry.
    Nearest,
    /// Linear.
    Linear,
    /// The thesis' rule: the upper entry b weighs ((a - x) / (a - b))^2. Not linear: a quarter at the midpoint.
    SquaredLambda,
    /// Linear in the log of the luminance and in the channels' ratios to it.
    LogLinear,
}

/// Sorted layers theta_i -> theta_o -> phi, each searched by bisection.
///
/// Returns every row at its own angles. Outside the range of a layer its nearest entry answers, with
/// [`Status::Filled`]. Values between rings of theta_i show two ghost lobes: kept to compare with the thesis.
#[derive(Clone, Debug)]
pub struct LayeredTable {
    cloud: SampleCloud,
    mode: LayerMode,
    negatives: NegativePolicy,
    /// Row-major (ln size, ratios), only for [`LayerMode::LogLinear`].
    coded: Vec<f64>,
    /// Incidences, ascending, with the rings below each.
    incidences: Vec<Layer>,
    /// Rings, ascending within an incidence, with the rows of each.
    rings: Vec<Layer>,
}

#[derive(Clone, Debug)]
struct Layer {
    angle: f64,
    below: Range<usize>,
}

/// The part each of two entries takes.
struct Bracket {
    entries: [(usize, f64); 2],
    outside: bool,
    exact: bool,
}

impl LayeredTable {
    /// Over the rows of `cloud`.
    #[must_use]
    pub fn new(cloud: &SampleCloud, mode: LayerMode) -> Self {
        let rows = cloud.geometry();
        let rings = layers(rows.len(), |r| (rows[r].theta_i, rows[r].theta_o));
        let ring_angles = |k: usize| {
            let row = rows[rings[k].below.start];
            (row.theta_i, row.theta_i)
        };
        let incidences = layers(rings.len(), ring_angles);
        let coded = match mode {
            LayerMode::LogLinear => LogRatio::new(cloud).encode_all(cloud),
            _ => Vec::new(),
        };
        Self {
            cloud: cloud.clone(),
            mode,
            negatives: NegativePolicy::Keep,
            coded,
            incidences,
            rings,
        }
    }

    /// The same with negative values treated as `negatives` says; they are kept unless told.
    #[must_use]
    pub fn with_negatives(self, negatives: NegativePolicy) -> Self {
        Self { negatives, ..self }
    }

    /// The rows.
    #[must_use]
    pub fn cloud(&self) -> &SampleCloud {
        &self.cloud
    }

    fn bracket(&self, range: Range<usize>, x: f64, angle: impl Fn(usize) -> f64) -> Bracket {
        let (first, last) = (range.start, range.end - 1);
        let (mut low, mut high) = (first, range.end);
        while low < high {
            let middle = low + (high - low) / 2;
            if angle(middle) <= x {
                low = middle + 1;
            } else {
                high = middle;
            }
        }
        let upper = low.min(last);
        let lower = upper.saturating_sub(usize::from(low <= last)).max(first);
        let (a, b) = (angle(lower), angle(upper));
        let t = if b > a {
            ((x - a) / (b - a)).clamp(0.0, 1.0)
        } else {
            0.0
        };
        let weight = match self.mode {
            LayerMode::Nearest => t.round(),
            LayerMode::Linear | LayerMode::LogLinear => t,
            LayerMode::SquaredLambda => t * t,
        };
        let close = |y: f64| (x - y).abs() <= SAME_ANGLE;
        let (weight, exact) = match (close(a), close(b)) {
            (true, _) => (0.0, true),
            (_, true) => (1.0, true),
            _ => (weight, false),
        };
        Bracket {
            entries: [(lower, 1.0 - weight), (upper, weight)],
            outside: x < angle(first) - SAME_ANGLE || x > angle(last) + SAME_ANGLE,
            exact,
        }
    }

    /// Calls `take` with every row that takes part and its weight.
    fn visit(&self, at: Geometry, mut take: impl FnMut(usize, f64)) -> Status {
        let rows = self.cloud.geometry();
        let (mut outside, mut exact) = (false, true);
        let mut note = |b: &Bracket| {
            outside |= b.outside;
            exact &= b.exact;
        };
        let incidence = self.bracket(0..self.incidences.len(), at.theta_i, |k| {
            self.incidences[k].angle
        });
        note(&incidence);
        for (i, w_i) in incidence.entries.into_iter().filter(|e| e.1 > 0.0) {
            let ring = self.bracket(self.incidences[i].below.clone(), at.theta_o, |k| {
                self.rings[k].angle
            });
            note(&ring);
            for (k, w_o) in ring.entries.into_iter().filter(|e| e.1 > 0.0) {
                let below = self.rings[k].below.clone();
                let pole = below.len() == 1 && self.rings[k].angle.min(at.theta_i) <= SAME_ANGLE;
                let row = self.bracket(below, at.phi, |r| rows[r].phi);
                if !pole {
                    note(&row);
                }
                for (r, w_p) in row.entries.into_iter().filter(|e| e.1 > 0.0) {
                    take(r, w_i * w_o * w_p);
                }
            }
        }
        match (outside, exact) {
            (true, _) => Status::Filled,
            (_, true) => Status::Measured,
            _ => Status::Interpolated,
        }
    }
}

impl Measured for LayeredTable {
    fn basis(&self) -> &Basis {
        self.cloud.basis()
    }

    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        assert_eq!(out.len(), self.cloud.basis().len(), "one entry a channel");
        out.fill(0.0);
        if !(wi.z > 0.0 && wo.z > 0.0) {
            return Status::Filled;
        }
        let mut log_size = 0.0;
        let at = Geometry::new(wi, wo);
        let status = self.visit(at, |row, weight| {
            let values = match self.mode {
                LayerMode::LogLinear => {
                    let coded = &self.coded[row * (out.len() + 1)..][..out.len() + 1];
                    log_size += weight * coded[0];
                    &coded[1..]
                }
                _ => self.cloud.values(row),
            };
            out.iter_mut()
                .zip(values)
                .for_each(|(o, v)| *o += weight * v);
        });
        if self.mode == LayerMode::LogLinear {
            decode(log_size, out);
        }
        self.negatives.apply(out);
        status
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: true,
            reciprocal: false,
        }
    }
}

/// Runs of entries with one (outer, inner) pair of angles; entries come sorted.
fn layers(count: usize, angles: impl Fn(usize) -> (f64, f64)) -> Vec<Layer> {
    let mut out: Vec<Layer> = Vec::new();
    for k in 0..count {
        let here = angles(k);
        let same = |l: &Layer| {
            let there = angles(l.below.start);
            (here.0 - there.0).abs() <= SAME_ANGLE && (here.1 - there.1).abs() <= SAME_ANGLE
        };
        match out.last_mut() {
            Some(last) if same(last) => last.below.end = k + 1,
            _ => out.push(Layer {
                angle: here.1,
                below: k..k + 1,
            }),
        }
    }
    out
}
