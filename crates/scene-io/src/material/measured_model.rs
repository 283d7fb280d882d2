//! Models measured on the fly by the virtual gonioreflectometer.

use crate::error::Error;
use brdf::Brdf;
use brdf_formats::{MERL_SCALE, MerlFile};
use brdf_measure::{Instrument, MERL_DIMS, measure_merl};
use brdf_table::{CellPolicy, HalfDiffTable, PhiDomain, TableBuilder};
use spectrum::{Basis, RgbSpace};

/// The table a perfect instrument makes of `brdf` on the MERL grid.
pub(super) fn measured(brdf: &dyn Brdf<3>) -> Result<HalfDiffTable, Error> {
    let file = measure_merl(brdf, MERL_DIMS, &Instrument::default(), 0)
        .map_err(|e| Error::invalid(e.to_string()))?;
    table(&file)
}

fn table(file: &MerlFile) -> Result<HalfDiffTable, Error> {
    let invalid = |e: brdf_table::GridError| Error::invalid(e.to_string());
    let dims = file.dims().map(|n| n as usize);
    let basis = Basis::Rgb(RgbSpace::srgb());
    let mut builder = TableBuilder::new(dims, PhiDomain::Reciprocal, basis, MERL_SCALE.to_vec())
        .map_err(invalid)?;
    for channel in 0..3 {
        let plane: Vec<f64> = file.plane(channel).collect();
        builder.push(&plane).map_err(invalid)?;
    }
    let (table, _) = builder.finish(CellPolicy::default()).map_err(invalid)?;
    Ok(table)
}
