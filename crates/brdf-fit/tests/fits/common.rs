//! Data with known truth, and fitted models as reflectance.

use brdf::{Brdf, Measured, Status};
use brdf_fit::{Estimate, Fit, Samples};
use brdf_measure::{Instrument, measure_merl};
use brdf_models::parse_model;
use brdf_table::{CellPolicy, Gridded, HalfDiffTable, Interpolation};
use glam::DVec3;
use std::sync::Arc;

/// What the virtual gonioreflectometer makes of a model, on a grid of `dims` cells.
pub(crate) fn measured(text: &str, dims: [u32; 3], noise: f64, seed: u64) -> Samples {
    let model = parse_model(text).unwrap();
    let instrument = Instrument {
        noise,
        ..Instrument::default()
    };
    let file = measure_merl(&*model.built.brdf, dims, &instrument, seed).unwrap();
    let (table, _) = HalfDiffTable::from_merl(&file, CellPolicy::default()).unwrap();
    let table = Gridded {
        table: Arc::new(table),
        interpolation: Interpolation::Linear,
    };
    Samples::on_grid(dims.map(|n| n as usize), 3, |wi, wo, out| {
        table.eval_native(wi, wo, out) != Status::Filled
    })
}

/// A model at the centres of a grid.
pub(crate) fn of_model(text: &str, dims: [usize; 3]) -> Samples {
    let model = parse_model(text).unwrap().built.brdf;
    Samples::on_grid(dims, 3, |wi, wo, out| {
        out.copy_from_slice(&model.eval(wi, wo));
        true
    })
}

/// The value behind an estimate, from the text the data were made with.
pub(crate) fn truth(text: &str, estimate: &Estimate) -> f64 {
    let model = parse_model(text).unwrap();

    let values = |name: &str| model.values.get(name).to_vec();
    let numbers = match (model.info.name, estimate.name.as_str()) {
        // the family's own names: see its documentation
        ("lafortune", "axis") => vec![values("cx")[0].atan2(values("cz")[0])],
        (_, name) => values(name),
    };
    assert!(!numbers.is_empty(), "{text}: {estimate:?}");
    match estimate.channel {
        Some(c) if numbers.len() > 1 => numbers[c],
        _ => numbers[0],
    }
}

/// A fitted model, from its text alone.
pub(crate) struct Sum(Vec<(Arc<dyn Brdf<3>>, Vec<f64>)>);

impl Sum {
    pub(crate) fn of(fit: &Fit) -> Self {
        let parts = fit.parts.iter();
        Self(
            parts
                .map(|p| (parse_model(&p.text).unwrap().built.brdf, p.scale.clone()))
                .collect(),
        )
    }
}

impl Brdf<3> for Sum {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for (model, scale) in &self.0 {
            let f = model.eval(wi, wo);
            (0..3).for_each(|c| sum[c] += scale[c] * f[c]);
        }
        sum
    }
}
