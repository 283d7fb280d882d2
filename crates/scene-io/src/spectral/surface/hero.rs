//! A surface at wavelengths that differ from path to path.

use super::super::hero::HeroChannels;
use super::sampler::{self, paired};
use super::{Form, SpectralSurface, bands, first, invalid, srgb};
use crate::cache::Cache;
use crate::error::Error;
use crate::material::SamplerReport;
use crate::scene::SamplerName;
use brdf::{
    HERO, LANES, Lanes3, Material, Measured, Paired, Rotated, RotatedTable, Rotation, TaggedBrdf,
    rotated,
};
use brdf_models::Lambert;
use brdf_table::{GriddedN, HeroGrid};
use spectrum::Basis;
use std::sync::Arc;

impl SpectralSurface {
    /// The material at the wavelengths of each path, and the sampler of its linear sRGB twin.
    ///
    /// # Errors
    /// As [`Self::fixed`].
    pub(in crate::spectral) fn hero(
        self,
        under: &HeroChannels,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<(Box<dyn Material<HERO, Rotation>>, SamplerReport), Error> {
        let channels = &under.channels;
        let tables = |basis: &Basis| -> Vec<RotatedTable> {
            let rows = channels.rows(basis);
            rows.iter().map(|row| rotated(row)).collect()
        };
        if let Some(spectrum) = self.constant() {
            let sampler = Lambert { albedo: [1.0] };
            let table = rotated(&channels.reflectance(&spectrum));
            let brdf = Rotated::new(sampler, Arc::new([table]));
            let report = self.rgb.material(SamplerName::Native, cache)?.1;
            return Ok((Box::new(Paired { brdf, sampler }), report));
        }
        let (sampler, report) = sampler::of(&self.rgb, name, cache)?;
        let material: Box<dyn Material<HERO, Rotation>> = match self.form {
            Form::Grid(table, interpolation) => match table.channels() {
                3 if !bands(&table) => {
                    let basis = Arc::new(first(tables(table.basis())));
                    let grid = GriddedN::<3>::new(table, interpolation).map_err(invalid)?;
                    let brdf = Rotated::new(grid, basis);
                    paired(brdf, sampler)
                }
                2..=31 if bands(&table) => {
                    let brdf = HeroGrid::<1>::new(&table, interpolation, &under.lambda_nm);
                    paired(brdf.map_err(invalid)?, sampler)
                }
                32..=95 if bands(&table) => {
                    let brdf = HeroGrid::<3>::new(&table, interpolation, &under.lambda_nm);
                    paired(brdf.map_err(invalid)?, sampler)
                }
                _ => {
                    let tables = tables(table.basis());
                    let measured = Arc::new(brdf_table::Gridded {
                        table,
                        interpolation,
                    });
                    let brdf = HeroMeasured { measured, tables };
                    paired(brdf, sampler)
                }
            },
            Form::Rgb(brdf) => {
                let brdf = Rotated::new(brdf, Arc::new(first(tables(&srgb()))));
                paired(brdf, sampler)
            }
            Form::Model(model, _) => {
                let brdf = channels.seeing(|seeing| model.hero(seeing));
                paired(brdf, sampler)
            }
            Form::Measured(measured, factors) => {
                let mut tables = tables(measured.basis());
                for (table, factor) in tables.iter_mut().zip(factors) {
                    let values = table.as_flattened_mut().iter_mut();
                    values.for_each(|v| *v *= factor as f32);
                }
                let brdf = HeroMeasured { measured, tables };
                paired(brdf, sampler)
            }
            Form::Flat(_) | Form::Colour(_) => return Err(invalid("expected a table or a model")),
        };
        Ok((material, report))
    }
}

/// A measurement of any channels, asked lane by lane: right for all, fast for none.
struct HeroMeasured {
    measured: Arc<dyn Measured>,
    /// What one unit of each channel adds at each wavelength.
    tables: Vec<RotatedTable>,
}

impl TaggedBrdf<HERO, Rotation> for HeroMeasured {
    fn table_bytes(&self) -> usize {
        self.measured.table_bytes() + size_of_val(&self.tables[..])
    }

    fn eval_tagged(
        &self,
        wi: &Lanes3,
        wo: &Lanes3,
        tags: &[Rotation; LANES],
    ) -> [[f32; LANES]; HERO] {
        let mut native = vec![0.0; self.tables.len()];
        let mut out = [[0.0; LANES]; HERO];
        for k in 0..LANES {
            let (wi, wo) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
            self.measured.eval_native(wi, wo, &mut native);
            for (value, table) in native.iter().zip(&self.tables) {
                let row = &table[tags[k].index()];
                for c in 0..HERO {
                    out[c][k] += *value as f32 * row[c];
                }
            }
        }
        out
    }
}
