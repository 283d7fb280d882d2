//! Models measured on the fly by the virtual gonioreflectometer.

use crate::error::Error;
use brdf::Brdf;
use brdf_measure::{Instrument, MERL_DIMS, measure_merl};
use brdf_table::{CellPolicy, HalfDiffTable};

/// The table a perfect instrument makes of `brdf` on the MERL grid.
pub(super) fn measured(brdf: &dyn Brdf<3>) -> Result<HalfDiffTable, Error> {
    let file = measure_merl(brdf, MERL_DIMS, &Instrument::default(), 0)
        .map_err(|e| Error::invalid(e.to_string()))?;
    let (table, _) = HalfDiffTable::from_merl(&file, CellPolicy::default())
        .map_err(|e| Error::invalid(e.to_string()))?;
    Ok(table)
}
