//! The default interpolant of scattered rows: one smooth surface through all of them.

use crate::scattered::chart::{self, Point};
use crate::scattered::cloud::{Geometry, SampleCloud};
use crate::scattered::domain::{Domain, Place};
use crate::scattered::error::CloudError;
use crate::scattered::log_ratio::{LogRatio, decode};
use crate::scattered::outliers::dead_rows;
use crate::scattered::policy::{BeyondPolicy, DeadRows, GapPolicy, Policies};
use crate::scattered::polyharmonic::Polyharmonic;
use crate::scattered::rise::Rise;
use brdf::{HalfDiff, Measured, Status, Symmetry};
use glam::DVec3;
use rayon::prelude::*;
use spectrum::Basis;

/// A thin-plate surface (polyharmonic, exponent 2.25) through ln of the luminance and the channels' ratios to it, in
/// half-angle coordinates where the glossy lobe stands still.
///
/// Passes through every row; one system for all rows, hence smooth everywhere inside the measured region, where a
/// fit to nearest neighbours would jump. Outside, [`Policies`] decide, and [`Status::Filled`] says so.
#[derive(Clone, Debug)]
pub struct ThinPlate {
    cloud: SampleCloud,
    points: Vec<Point>,
    surface: Polyharmonic,
    domain: Domain,
    policies: Policies,
    /// Rows answered at their own angles only.
    isolated: Vec<usize>,
    rise: Rise,
    /// How much of the rise beyond the edge is taken, [0, 1].
    growth: f64,
    /// Largest directional albedo found beyond the edge.
    albedo_beyond: f64,
}

/// What was filled, left out and kept, for reports.
#[derive(Clone, Debug, PartialEq)]
pub struct FillReport {
    /// The choices in force.
    pub policies: Policies,
    /// Where rows surround the query; everything else is filled.
    pub domain: Domain,
    /// Rows that contradict all neighbours and are answered at their own angles only.
    pub isolated: Vec<Geometry>,
    /// Negative values in each channel of the rows.
    pub negatives: Vec<usize>,
    /// Rows averaged with another at the same angles.
    pub merged: usize,
    /// Rows at or below the horizon, left out.
    pub below_horizon: usize,
    /// How much of the rise beyond the edge was kept so that no albedo exceeds 1, [0, 1].
    pub growth: f64,
    /// Largest directional albedo (luminance) beyond the edge.
    pub albedo_beyond: f64,
}

/// Most rows of one surface: its two dense matrices then take 288 MB each.
const MOST_ROWS: usize = 6000;

impl ThinPlate {
    /// Through all rows, with the default policies.
    ///
    /// # Errors
    /// As [`Self::with_policies`].
    pub fn new(cloud: &SampleCloud) -> Result<Self, CloudError> {
        Self::with_policies(cloud, Policies::default())
    }

    /// Through all rows but dead ones.
    ///
    /// # Errors
    /// If rows almost coincide, or there are more than 6000 after folding: the cost grows with their cube and the
    /// memory with their square.
    pub fn with_policies(cloud: &SampleCloud, policies: Policies) -> Result<Self, CloudError> {
        if cloud.len() > MOST_ROWS {
            return Err(CloudError::TooManyRows {
                found: cloud.len(),
                limit: MOST_ROWS,
            });
        }
        let code = LogRatio::new(cloud);
        let points: Vec<Point> = cloud.geometry().iter().map(|&g| chart::of_row(g)).collect();
        let dead = match policies.dead {
            DeadRows::Isolate => dead_rows(cloud, &points, &code),
            DeadRows::Keep => vec![false; points.len()],
        };
        let live = || (0..points.len()).filter(|&r| !dead[r]);
        let nodes: Vec<Point> = live().map(|r| points[r]).collect();
        let mut values = Vec::new();
        live().for_each(|r| code.encode(cloud.values(r), &mut values));
        let surface = Polyharmonic::fit(&nodes, &values, cloud.basis().len() + 1)?;
        let domain = Domain::new(cloud);
        let rise = Rise::fit(&domain, |at| {
            let mut log_size = 0.0;
            surface.eval(chart_of(at), &mut log_size, &mut []);
            log_size
        });
        let mut out = Self {
            cloud: cloud.clone(),
            surface,
            domain,
            rise,
            policies,
            isolated: (0..points.len()).filter(|&r| dead[r]).collect(),
            points: nodes,
            growth: 1.0,
            albedo_beyond: 0.0,
        };
        out.limit_growth();
        Ok(out)
    }

    /// The same interpolant in other channels: exactly what mapping every answer would give, at the price of the new
    /// channels. `matrix` has one row a channel of this one; negative values are treated in the new channels.
    ///
    /// # Errors
    /// If the matrix does not have one row a channel.
    pub fn to_basis<const N: usize>(
        &self,
        basis: Basis,
        matrix: &[[f64; N]],
    ) -> Result<Self, CloudError> {
        let channels = self.cloud.basis().len();
        if matrix.len() != channels || basis.len() != N {
            return Err(CloudError::Matrix {
                expected: channels,
                found: matrix.len(),
            });
        }
        let mut map = vec![vec![0.0; channels + 1]; N + 1];
        map[0][0] = 1.0;
        for (j, row) in matrix.iter().enumerate() {
            (0..N).for_each(|c| map[c + 1][j + 1] = row[c]);
        }
        Ok(Self {
            surface: self.surface.mapped(&map),
            cloud: self.cloud.to_basis(basis, matrix),
            ..self.clone()
        })
    }

    /// Where the rows are.
    #[must_use]
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// What was filled, left out and kept.
    #[must_use]
    pub fn report(&self) -> FillReport {
        FillReport {
            policies: self.policies,
            domain: self.domain,
            isolated: self
                .isolated
                .iter()
                .map(|&r| self.cloud.geometry()[r])
                .collect(),
            negatives: self.cloud.negatives(),
            merged: self.cloud.merged(),
            below_horizon: self.cloud.below_horizon(),
            growth: self.growth,
            albedo_beyond: self.albedo_beyond,
        }
    }

    /// Bytes of tables.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.surface.bytes()
    }

    /// The surface itself, anywhere.
    pub(crate) fn interpolate(&self, at: Point, out: &mut [f64]) {
        let mut log_size = 0.0;
        self.surface.eval(at, &mut log_size, out);
        decode(log_size, out);
    }

    fn nearest(&self, at: Point, out: &mut [f64]) {
        if let Some(&node) = self.points.get(chart::nearest(&self.points, at)) {
            self.interpolate(node, out);
        }
    }

    /// f at the edge, times the rise from there.
    fn beyond(&self, at: HalfDiff, out: &mut [f64]) {
        let edge = self.domain.edge(at);
        let mut log_size = 0.0;
        self.surface.eval(chart_of(edge), &mut log_size, out);
        let (from, to) = (edge.theta_d, at.theta_d);
        let factor = self.rise.factor(at.theta_h, from, to, self.growth);
        decode(log_size + factor.ln(), out);
    }

    /// Lowers the growth until no direction beyond the edge reflects more than it receives.
    fn limit_growth(&mut self) {
        if self.policies.beyond == BeyondPolicy::Nearest {
            return;
        }
        let edge = self.domain.theta_i[1].max(self.domain.theta_o[1]);
        let step = (std::f64::consts::FRAC_PI_2 - edge) / 4.0;
        let steps: Vec<f64> = (1..4).map(|k| edge + step * f64::from(k)).collect();
        for growth in [1.0, 0.5, 0.25, 0.0] {
            self.growth = growth;
            let albedo = steps.par_iter().map(|&theta| self.albedo(theta));
            self.albedo_beyond = albedo.reduce(|| 0.0, f64::max);
            if self.albedo_beyond <= 1.0 {
                return;
            }
        }
    }

    /// Luminance reflected of light from `theta`, by the midpoint rule in cos^2 and azimuth.
    fn albedo(&self, theta: f64) -> f64 {
        const N: [u32; 2] = [20, 24];
        let mut values = vec![0.0; self.cloud.basis().len()];
        let mut sum = 0.0;
        for a in 0..N[0] {
            let cos = ((f64::from(a) + 0.5) / f64::from(N[0])).sqrt();
            for b in 0..N[1] {
                let phi = std::f64::consts::PI * (f64::from(b) + 0.5) / f64::from(N[1]);
                let geometry = Geometry {
                    theta_i: theta,
                    theta_o: cos.acos(),
                    phi,
                };
                self.answer(geometry, geometry.half_diff(), &mut values);
                sum += crate::scattered::cloud::dot(&values, self.cloud.luminance_weights());
            }
        }
        sum * std::f64::consts::PI / f64::from(N[0] * N[1])
    }

    /// The surface or what the policies put in its place.
    fn answer(&self, geometry: Geometry, half_diff: HalfDiff, out: &mut [f64]) -> Status {
        let at = chart::point(geometry, half_diff);
        match (self.domain.place(geometry, half_diff), self.policies) {
            (Place::Inside, _) => {
                self.interpolate(at, out);
                return Status::Interpolated;
            }
            (
                Place::Gap,
                Policies {
                    gap: GapPolicy::Extend,
                    ..
                },
            ) => self.interpolate(at, out),
            (
                Place::Beyond,
                Policies {
                    beyond: BeyondPolicy::Schlick,
                    ..
                },
            ) => self.beyond(half_diff, out),
            (Place::Gap | Place::Beyond, _) => self.nearest(at, out),
        }
        Status::Filled
    }
}

/// The chart's point of half and difference angles.
fn chart_of(angles: HalfDiff) -> Point {
    let (wi, wo) = angles.directions();
    chart::point(Geometry::new(wi, wo), angles)
}

impl Measured for ThinPlate {
    fn basis(&self) -> &Basis {
        self.cloud.basis()
    }

    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        assert_eq!(out.len(), self.cloud.basis().len(), "one entry a channel");
        if !(wi.z > 0.0 && wo.z > 0.0) {
            out.fill(0.0);
            return Status::Filled;
        }
        let geometry = Geometry::new(wi, wo);
        let status = match self.cloud.row_at(geometry) {
            Some(row) => {
                out.copy_from_slice(self.cloud.values(row));
                Status::Measured
            }
            None => self.answer(geometry, HalfDiff::new(wi, wo), out),
        };
        self.policies.negative.apply(out);
        status
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: true,
            reciprocal: false,
        }
    }
}
