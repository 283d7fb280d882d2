//! A surface in channels that are the same on every path.

use super::super::channels::Channels;
use super::sampler::{self, paired};
use super::{Form, SpectralSurface, bands, first, invalid, srgb};
use crate::cache::Cache;
use crate::error::Error;
use crate::material::SamplerReport;
use crate::scene::SamplerName;
use brdf::{Material, Paired, Projected, Spread};
use brdf_models::Lambert;
use brdf_table::{BinnedGrid, GriddedN};
use spectrum::Basis;
use std::sync::Arc;

impl SpectralSurface {
    /// The material in `N` fixed channels, and the sampler of its linear sRGB twin.
    ///
    /// # Errors
    /// If that sampler does not go with this reflectance.
    pub(in crate::spectral) fn fixed<const N: usize>(
        self,
        channels: &Channels,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<(Box<dyn Material<N>>, SamplerReport), Error> {
        let rows = |basis: &Basis| -> Vec<[f64; N]> {
            let fit = |row: Vec<f64>| std::array::from_fn(|c| row.get(c).copied().unwrap_or(0.0));
            channels.rows(basis).into_iter().map(fit).collect()
        };
        let three = |basis: &Basis| -> [[f64; N]; 3] { first(rows(basis)) };
        if let Some(spectrum) = self.constant() {
            let values = channels.reflectance(&spectrum);
            let row = std::array::from_fn(|c| values.get(c).copied().unwrap_or(0.0));
            let sampler = Lambert { albedo: [1.0] };
            let brdf = Spread::<_, 1, N>::new(sampler, [row]);
            let report = self.rgb.material(SamplerName::Native, cache)?.1;
            return Ok((Box::new(Paired { brdf, sampler }), report));
        }
        let (sampler, report) = sampler::of(&self.rgb, name, cache)?;
        let material: Box<dyn Material<N>> = match self.form {
            Form::Grid(table, interpolation) if table.channels() == 3 => {
                let rows = three(table.basis());
                let grid = GriddedN::<3>::new(table, interpolation).map_err(invalid)?;
                let brdf = Spread::new(grid, rows);
                paired(brdf, sampler)
            }
            // more channels than bands: the bands are read, and summed up after
            Form::Grid(table, interpolation) if bands(&table) && N > table.channels() => {
                let rows = rows(table.basis());
                if table.channels() < 32 {
                    let brdf = BinnedGrid::<1, N>::new(&table, interpolation, &rows);
                    paired(brdf.map_err(invalid)?, sampler)
                } else {
                    let brdf = BinnedGrid::<3, N>::new(&table, interpolation, &rows);
                    paired(brdf.map_err(invalid)?, sampler)
                }
            }
            Form::Grid(table, interpolation) => {
                let table = if table.basis() == channels.basis() {
                    table
                } else {
                    let rows = channels.rows(table.basis());
                    let mapped = table.map_channels(&rows, channels.basis().clone());
                    Arc::new(mapped.map_err(invalid)?)
                };
                let brdf = GriddedN::<N>::new(table, interpolation).map_err(invalid)?;
                paired(brdf, sampler)
            }
            Form::Rgb(brdf) => {
                let brdf = Spread::new(brdf, three(&srgb()));
                paired(brdf, sampler)
            }
            Form::Model(model, _) => {
                let brdf = channels.seeing(|seeing| model.in_channels::<N>(seeing));
                paired(brdf, sampler)
            }
            Form::Measured(measured, factors) => {
                let mut rows = rows(measured.basis());
                for (row, factor) in rows.iter_mut().zip(factors) {
                    row.iter_mut().for_each(|v| *v *= factor);
                }
                let brdf = Projected::new(measured, rows)
                    .ok_or_else(|| invalid("expected a row a channel, found others"))?;
                paired(brdf, sampler)
            }
            Form::Flat(_) | Form::Colour(_) => return Err(invalid("expected a table or a model")),
        };
        Ok((material, report))
    }
}
