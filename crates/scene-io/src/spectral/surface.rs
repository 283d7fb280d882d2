//! Any material in its own bands, on its way into the channels of a render.

use super::channels::Channels;
use super::hero;
use crate::cache::Cache;
use crate::error::Error;
use crate::material::{
    LoadedMeasured, MaterialOptions, SamplerReport, Surface, SurfaceForm, Visitor,
};
use crate::scene::SamplerName;
use brdf::{
    Brdf, DirectionSampler, HERO, LANES, Lanes3, Material, Measured, Paired, Projected, Rotated,
    RotatedTable, Rotation, Spread, Status, Tag, TaggedBrdf,
};
use brdf_measure::MERL_DIMS;
use brdf_models::Lambert;
use brdf_sampling::Hvt;
use brdf_table::{GriddedN, HalfDiffTable, HeroGrid, Interpolation, PhiDomain};
use glam::DVec3;
use spectrum::{Basis, LinearUplift, RgbSpace, Spectrum};
use std::any::Any;
use std::sync::Arc;

/// A reflectance in the channels it was given in, with its linear sRGB twin, which samplers are built for.
pub(crate) struct SpectralSurface {
    rgb: Surface,
    form: Form,
}

enum Form {
    /// Cells of any number of channels.
    Grid(Arc<HalfDiffTable>, Interpolation),
    /// A model that knows linear sRGB alone.
    Rgb(Arc<dyn Brdf<3>>),
    /// Answers of its own, and a factor per channel.
    Measured(Arc<dyn Measured>, Vec<f64>),
    /// The same in all directions.
    Flat(Spectrum),
}

/// Bands mixtures of spectra and colours are tabulated in, nm: Cornell's.
fn mixing_bands() -> Vec<f64> {
    (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect()
}

fn srgb() -> Basis {
    Basis::Rgb(RgbSpace::srgb())
}

fn invalid(e: impl std::fmt::Display) -> Error {
    Error::invalid(e.to_string())
}

impl SpectralSurface {
    /// A measured file: bands stay bands.
    ///
    /// # Errors
    /// As [`Surface::of_file`].
    pub(crate) fn of_file(
        loaded: &LoadedMeasured,
        options: &MaterialOptions,
        cache: &Cache,
    ) -> Result<Self, Error> {
        let bands = matches!(loaded.measured.basis(), Basis::Bands(_));
        let native = bands.then(|| Surface::native_grid(loaded, cache));
        if let Some((table, interpolation, notes)) = native.flatten() {
            let factors = factors(table.basis(), options.scale);
            let table = Arc::new(scaled(&table, &factors)?);
            let rgb = Surface::of_table(in_srgb(&table)?, interpolation, notes)?;
            let form = Form::Grid(table, interpolation);
            return Ok(Self { rgb, form });
        }
        let rgb = Surface::of_file(loaded, options, cache)?;
        let form = match rgb.form() {
            SurfaceForm::Grid(grid) => Form::Grid(Arc::clone(grid.table()), grid.interpolation()),
            SurfaceForm::Brdf(brdf) if !bands => Form::Rgb(brdf),
            SurfaceForm::Brdf(_) => {
                let factors = factors(loaded.measured.basis(), options.scale);
                Form::Measured(Arc::clone(&loaded.measured), factors)
            }
        };
        Ok(Self { rgb, form })
    }

    /// What a surface in linear sRGB is, uplifted.
    pub(crate) fn of_rgb(rgb: Surface) -> Self {
        let form = match rgb.form() {
            SurfaceForm::Grid(grid) => Form::Grid(Arc::clone(grid.table()), grid.interpolation()),
            SurfaceForm::Brdf(brdf) => Form::Rgb(brdf),
        };
        Self { rgb, form }
    }

    /// The same reflectance in all directions.
    pub(crate) fn flat(rgb: Surface, reflectance: Spectrum) -> Self {
        let form = Form::Flat(reflectance);
        Self { rgb, form }
    }

    /// A weighted sum on the MERL grid: in linear sRGB if all parts are, else in bands.
    ///
    /// # Errors
    /// As [`Surface::mix`].
    pub(crate) fn mix(parts: Vec<(Self, f64)>) -> Result<Self, Error> {
        if parts.iter().all(|(p, _)| p.basis() == srgb()) {
            let rgb: Vec<(Surface, f64)> = parts.into_iter().map(|(p, w)| (p.rgb, w)).collect();
            return Ok(Self::of_rgb(Surface::mix(&rgb)?));
        }
        let most = (parts.iter())
            .map(|(p, _)| p.basis())
            .filter(|b| matches!(b, Basis::Bands(_)))
            .max_by_key(Basis::len);
        let basis = most.unwrap_or_else(|| Basis::Bands(mixing_bands()));
        let reciprocal = parts
            .iter()
            .all(|(s, _)| s.rgb.brdf().symmetry().reciprocal);
        let [n_h, n_d, n_p] = MERL_DIMS.map(|n| n as usize);
        let (dims, phi) = if reciprocal {
            ([n_h, n_d, n_p], PhiDomain::Reciprocal)
        } else {
            ([n_h, n_d, 2 * n_p], PhiDomain::Full)
        };
        let ready: Vec<_> = (parts.iter())
            .map(|(part, weight)| (part, part.basis().rows_to(&basis), *weight))
            .collect();
        let table = HalfDiffTable::from_fn(dims, phi, basis, |wi, wo, out| {
            out.fill(0.0);
            let mut worst = Status::Measured;
            for (part, rows, weight) in &ready {
                let mut native = vec![0.0; rows.len()];
                worst = worst.max(part.eval(wi, wo, &mut native));
                for (value, row) in native.iter().zip(rows) {
                    for (o, r) in out.iter_mut().zip(row) {
                        *o += weight * value * r;
                    }
                }
            }
            worst
        });
        let notes = vec![format!("mixed in {} bands", table.channels())];
        let rgb = Surface::of_table(in_srgb(&table)?, Interpolation::Linear, notes)?;
        let form = Form::Grid(Arc::new(table), Interpolation::Linear);
        Ok(Self { rgb, form })
    }

    /// The channels it is given in; linear sRGB for what is flat or a model.
    fn basis(&self) -> Basis {
        match &self.form {
            Form::Grid(table, _) => table.basis().clone(),
            Form::Measured(measured, _) => measured.basis().clone(),
            Form::Flat(spectrum) if spectrum.lambda_nm().len() > 1 => Basis::Bands(mixing_bands()),
            Form::Rgb(_) | Form::Flat(_) => srgb(),
        }
    }

    /// f_r in the channels of [`Self::basis`].
    fn eval(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        match &self.form {
            Form::Grid(table, interpolation) => return table.eval(wi, wo, *interpolation, out),
            Form::Rgb(brdf) => out.copy_from_slice(&brdf.eval(wi, wo)),
            Form::Measured(measured, factors) => {
                let status = measured.eval_native(wi, wo, out);
                out.iter_mut().zip(factors).for_each(|(o, f)| *o *= f);
                return status;
            }
            Form::Flat(spectrum) => {
                let [f] = Lambert { albedo: [1.0] }.eval(wi, wo);
                let values = self.basis().project(spectrum);
                out.iter_mut().zip(values).for_each(|(o, v)| *o = f * v);
            }
        }
        Status::Measured
    }

    /// The material in `N` fixed channels, and the sampler of its linear sRGB twin.
    ///
    /// # Errors
    /// If that sampler does not go with this reflectance.
    pub(crate) fn fixed<const N: usize>(
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
        if let Form::Flat(spectrum) = &self.form {
            let values = channels.reflectance(spectrum);
            let row = std::array::from_fn(|c| values.get(c).copied().unwrap_or(0.0));
            let sampler = Lambert { albedo: [1.0] };
            let brdf = Spread::<_, 1, N>::new(sampler, [row]);
            let report = self.rgb.material(SamplerName::Native, cache)?.1;
            return Ok((Box::new(Paired { brdf, sampler }), report));
        }
        let (sampler, report) = self.sampler(name, cache)?;
        let material: Box<dyn Material<N>> = match self.form {
            Form::Grid(table, interpolation) if table.channels() == 3 => {
                let rows = three(table.basis());
                let grid = GriddedN::<3>::new(table, interpolation).map_err(invalid)?;
                let brdf = Spread::new(grid, rows);
                paired(brdf, sampler)
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
            Form::Measured(measured, factors) => {
                let mut rows = rows(measured.basis());
                for (row, factor) in rows.iter_mut().zip(factors) {
                    row.iter_mut().for_each(|v| *v *= factor);
                }
                let brdf = Projected::new(measured, rows)
                    .ok_or_else(|| invalid("expected a row a channel, found others"))?;
                paired(brdf, sampler)
            }
            Form::Flat(_) => return Err(invalid("expected a table or a model")),
        };
        Ok((material, report))
    }

    /// The material at the wavelengths of each path, and the sampler of its linear sRGB twin.
    ///
    /// # Errors
    /// As [`Self::fixed`].
    pub(crate) fn hero(
        self,
        channels: &Channels,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<(Box<dyn Material<HERO, Rotation>>, SamplerReport), Error> {
        let tables = |basis: &Basis| -> Vec<RotatedTable> {
            let rows = channels.rows(basis);
            rows.iter().map(|row| hero::rotated(row)).collect()
        };
        if let Form::Flat(spectrum) = &self.form {
            let sampler = Lambert { albedo: [1.0] };
            let table = hero::rotated(&channels.reflectance(spectrum));
            let brdf = Rotated::new(sampler, Arc::new([table]));
            let report = self.rgb.material(SamplerName::Native, cache)?.1;
            return Ok((Box::new(Paired { brdf, sampler }), report));
        }
        let (sampler, report) = self.sampler(name, cache)?;
        let lambda_nm = hero::wavelengths(channels.basis());
        let material: Box<dyn Material<HERO, Rotation>> = match self.form {
            Form::Grid(table, interpolation) => match table.channels() {
                3 => {
                    let basis = Arc::new(first(tables(table.basis())));
                    let grid = GriddedN::<3>::new(table, interpolation).map_err(invalid)?;
                    let brdf = Rotated::new(grid, basis);
                    paired(brdf, sampler)
                }
                31 => {
                    let grid = HeroGrid::<31>::new(table, interpolation, &lambda_nm);
                    let brdf = grid.map_err(invalid)?;
                    paired(brdf, sampler)
                }
                65 => {
                    let grid = HeroGrid::<65>::new(table, interpolation, &lambda_nm);
                    let brdf = grid.map_err(invalid)?;
                    paired(brdf, sampler)
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
            Form::Measured(measured, factors) => {
                let mut tables = tables(measured.basis());
                for (table, factor) in tables.iter_mut().zip(factors) {
                    let values = table.as_flattened_mut().iter_mut();
                    values.for_each(|v| *v *= factor as f32);
                }
                let brdf = HeroMeasured { measured, tables };
                paired(brdf, sampler)
            }
            Form::Flat(_) => return Err(invalid("expected a table or a model")),
        };
        Ok((material, report))
    }

    fn sampler(
        &self,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<(SpectralSampler, SamplerReport), Error> {
        self.rgb.sampler(name, cache, Keep)
    }
}

/// The first three of at least as many.
fn first<T: Clone>(rows: Vec<T>) -> [T; 3] {
    std::array::from_fn(|c| rows[c].clone())
}

/// What a factor per linear sRGB channel is for each channel of `basis`: the colour uplifted, where bands need it.
fn factors(basis: &Basis, scale: [f64; 3]) -> Vec<f64> {
    let [r, g, b] = scale.map(f64::to_bits);
    if r == g && g == b {
        return vec![scale[0]; basis.len()];
    }
    basis.project(&LinearUplift::spectrum(scale))
}

fn scaled(table: &HalfDiffTable, factors: &[f64]) -> Result<HalfDiffTable, Error> {
    let n = factors.len();
    let row = |c: usize| {
        (0..n)
            .map(|k| if c == k { factors[c] } else { 0.0 })
            .collect()
    };
    let matrix: Vec<Vec<f64>> = (0..n).map(row).collect();
    let mapped = table.map_channels(&matrix, table.basis().clone());
    mapped.map_err(|e| Error::invalid(e.to_string()).in_field("scale"))
}

fn in_srgb(table: &HalfDiffTable) -> Result<HalfDiffTable, Error> {
    let rows = table.basis().to_linear_srgb();
    let matrix: Vec<Vec<f64>> = rows.iter().map(|r| r.to_vec()).collect();
    table.map_channels(&matrix, srgb()).map_err(invalid)
}

/// Samplers of spectral materials: the usual one compiled with the reflectance, all others through a pointer, since
/// every pair is a program of its own.
enum SpectralSampler {
    Hvt(Hvt),
    Other(Arc<dyn DirectionSampler>),
}

/// Keeps the sampler that comes.
struct Keep;

impl Visitor for Keep {
    type Out = (SpectralSampler, SamplerReport);

    fn visit<S: DirectionSampler + 'static>(self, sampler: S, report: SamplerReport) -> Self::Out {
        let bytes = sampler.bytes();
        let mut slot = Some(sampler);
        let hvt = (&mut slot as &mut dyn Any).downcast_mut::<Option<Hvt>>();
        let kept = match (hvt.and_then(Option::take), slot) {
            (Some(hvt), _) => SpectralSampler::Hvt(hvt),
            (None, Some(other)) => SpectralSampler::Other(Arc::new(other)),
            (None, None) => SpectralSampler::Other(Arc::new(brdf_sampling::Cosine)),
        };
        (kept, SamplerReport { bytes, ..report })
    }
}

/// A reflectance and its sampler as one material.
fn paired<const N: usize, T: Tag>(
    brdf: impl TaggedBrdf<N, T> + 'static,
    sampler: SpectralSampler,
) -> Box<dyn Material<N, T>> {
    match sampler {
        SpectralSampler::Hvt(sampler) => Box::new(Paired { brdf, sampler }),
        SpectralSampler::Other(sampler) => Box::new(Paired { brdf, sampler }),
    }
}

/// A measurement of any channels, asked lane by lane: right for all, fast for none.
struct HeroMeasured {
    measured: Arc<dyn Measured>,
    /// What one unit of each channel adds at each wavelength.
    tables: Vec<RotatedTable>,
}

impl TaggedBrdf<HERO, Rotation> for HeroMeasured {
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
