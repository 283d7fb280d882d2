//! What low-discrepancy points are worth behind a sampler: one viewer, a smooth environment, one bounce.
//!
//! `cargo run --release -p brdf-sampling --example stratification -- FILE.binary ...`
//!
//! Prints the relative RMSE of 16 384 samples with independent and with Owen-scrambled Sobol' points, over independent
//! scrambles, and their ratio. Errors are standard errors: 1 / sqrt(2 (R - 1)) of an RMSE over R scrambles.
#![expect(clippy::print_stdout, reason = "a program")]
#![expect(clippy::disallowed_methods, reason = "reads the files it is told")]

use brdf::{DirectionSampler, Measured, direction};
use brdf_formats::File;
use brdf_sampling::{Cosine, Hvt, Preset, Target};
use brdf_table::{CellPolicy, Gridded, HalfDiffTable, Interpolation};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use sampling::{PointSet, Points, Welford};
use std::error::Error;
use std::sync::Arc;

/// Samples an estimate.
const SAMPLES: u32 = 1 << 14;
/// Independent scrambles.
const SCRAMBLES: u64 = 192;
/// Viewers, degrees.
const VIEWERS_DEG: [f64; 3] = [15.0, 45.0, 70.0];

/// Radiance of the environment: a polynomial of degree two, brightest above and to one side.
fn radiance(w: DVec3) -> f64 {
    1.0 + 0.5 * w.x - 0.3 * w.y + 0.4 * w.z * w.z + 0.3 * w.x * w.y
}

/// Relative RMSE of one estimate.
fn rel_rmse(
    f: &(dyn Fn(DVec3, DVec3) -> f64 + Sync),
    sampler: &dyn DirectionSampler,
    wo: DVec3,
    kind: PointSet,
) -> f64 {
    let estimate = |seed| {
        let points = Points::new(kind, seed);
        let sum: f64 = (0..SAMPLES)
            .filter_map(|k| {
                let s = sampler.sample(wo, DVec2::from(points.get2(0, k, 0).map(f64::from)))?;
                Some(f(s.wi, wo) * s.wi.z / s.pdf * radiance(s.wi))
            })
            .sum();
        sum / f64::from(SAMPLES)
    };
    let estimates: Vec<f64> = (0..SCRAMBLES).into_par_iter().map(estimate).collect();
    let spread: Welford = estimates.into_iter().collect();
    spread.variance().sqrt() / spread.mean()
}

fn main() -> Result<(), Box<dyn Error>> {
    println!("material, sampler, viewer: relative RMSE independent, Sobol'; ratio");
    for path in std::env::args().skip(1) {
        let File::Merl(file) = brdf_formats::read(std::fs::read(&path)?)? else {
            return Err(format!("{path}: expected a MERL file").into());
        };
        let (table, _) = HalfDiffTable::from_merl(&file, CellPolicy::AnyNegative)?;
        let grid = Gridded {
            table: Arc::new(table),
            interpolation: Interpolation::Linear,
        };
        let weights = grid.basis().luminance_weights();
        let f = |wi: DVec3, wo: DVec3| {
            let mut values = [0.0; 3];
            grid.eval_native(wi, wo, &mut values);
            values.iter().zip(&weights).map(|(v, w)| v * w).sum::<f64>()
        };
        let [default, fine] = [Preset::Default, Preset::Fine]
            .map(|preset| Hvt::new(Target::new(&f), preset.options()));
        let samplers: [(&str, &dyn DirectionSampler); 3] = [
            ("hvt-default", &default),
            ("hvt-fine", &fine),
            ("cosine", &Cosine),
        ];
        for (name, sampler) in samplers {
            for deg in VIEWERS_DEG {
                let wo = direction(deg.to_radians(), 0.0);
                let [independent, sobol] = [PointSet::Independent, PointSet::Sobol]
                    .map(|kind| rel_rmse(&f, sampler, wo, kind));
                let ratio = independent / sobol;
                // two independent RMSE
                let error = ratio / ((SCRAMBLES - 1) as f64).sqrt();
                println!(
                    "{path}, {name}, {deg} deg: {independent:.2e}, {sobol:.2e}; {ratio:.1} +- {error:.1}"
                );
            }
        }
    }
    Ok(())
}
