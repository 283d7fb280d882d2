//! The thesis' first approach: the nearest row, found by a k-d tree.

use crate::scattered::cloud::{Geometry, SampleCloud};
use crate::scattered::domain::{Domain, Place};
use crate::scattered::error::CloudError;
use crate::scattered::policy::NegativePolicy;
use brdf::{Measured, Status, Symmetry};
use glam::DVec3;
use kiddo::{ImmutableKdTree, SquaredEuclidean};
use spectrum::Basis;

/// Answers with the nearest row, by the chords between the two light and the two viewer directions.
#[derive(Debug)]
pub struct KdNearest {
    cloud: SampleCloud,
    domain: Domain,
    tree: ImmutableKdTree<f64, 5>,
    negatives: NegativePolicy,
}

impl KdNearest {
    /// Over the rows of `cloud`.
    ///
    /// # Errors
    /// If the tree cannot be built.
    pub fn new(cloud: &SampleCloud) -> Result<Self, CloudError> {
        let points: Vec<[f64; 5]> = cloud.geometry().iter().map(|&g| chords(g)).collect();
        let tree = ImmutableKdTree::new_from_slice(&points)
            .map_err(|_| CloudError::Singular { rows: points.len() })?;
        Ok(Self {
            cloud: cloud.clone(),
            domain: Domain::new(cloud),
            tree,
            negatives: NegativePolicy::Keep,
        })
    }

    /// The same with negative values treated as `negatives` says; they are kept unless told.
    #[must_use]
    pub fn with_negatives(self, negatives: NegativePolicy) -> Self {
        Self { negatives, ..self }
    }
}

/// The light in the plane phi = 0 and the viewer on one side of it, as points on the sphere.
fn chords(g: Geometry) -> [f64; 5] {
    let (wi, wo) = g.directions();
    [wi.x, wi.z, wo.x, wo.y, wo.z]
}

impl Measured for KdNearest {
    fn basis(&self) -> &Basis {
        self.cloud.basis()
    }

    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        assert_eq!(out.len(), self.cloud.basis().len(), "one entry a channel");
        if !(wi.z > 0.0 && wo.z > 0.0) {
            out.fill(0.0);
            return Status::Filled;
        }
        let at = Geometry::new(wi, wo);
        let query = chords(at);
        let found = self
            .tree
            .query(&query)
            .nearest_one::<SquaredEuclidean<f64>>()
            .execute();
        let row = (found.item as usize).min(self.cloud.len() - 1);
        out.copy_from_slice(self.cloud.values(row));
        self.negatives.apply(out);
        if self.cloud.geometry()[row].is_same(at) {
            return Status::Measured;
        }
        match self.domain.place(at, at.half_diff()) {
            Place::Inside => Status::Interpolated,
            Place::Gap | Place::Beyond => Status::Filled,
        }
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: true,
            reciprocal: false,
        }
    }
}
