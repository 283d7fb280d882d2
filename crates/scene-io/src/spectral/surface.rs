//! Any material in its own bands, on its way into the channels of a render.

mod fixed;
mod hero;
mod sampler;

use super::channels::Channels;
use super::light;
use crate::cache::Cache;
use crate::error::Error;
use crate::material::{LoadedMeasured, MaterialOptions, Surface, SurfaceForm};
use brdf::{Brdf, Measured, Status};
use brdf_measure::MERL_DIMS;
use brdf_models::{Lambert, SpectralModel, parse_model};
use brdf_table::{HalfDiffTable, Interpolation, PhiDomain};
use glam::DVec3;
use spectrum::{Basis, LinearUplift, RgbSpace, Spectrum};
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
    /// A model that knows wavelengths, and what it is in the bands of mixtures.
    Model(SpectralModel, Arc<dyn Brdf<MIXING>>),
    /// Answers of its own, and a factor per channel.
    Measured(Arc<dyn Measured>, Vec<f64>),
    /// The same in all directions.
    Flat(Spectrum),
    /// The same, told by its colour: the twin says all.
    Colour([f64; 3]),
}

/// How many bands mixtures of spectra and colours are tabulated in.
const MIXING: usize = 31;

/// Those bands, nm: Cornell's.
fn mixing_bands() -> Vec<f64> {
    (0..MIXING).map(|k| 400.0 + 10.0 * k as f64).collect()
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

    /// A model evaluated exactly, at the wavelengths of the channels if it knows them.
    ///
    /// # Errors
    /// As [`Surface::of_model`].
    pub(crate) fn of_model(text: &str, options: &MaterialOptions) -> Result<Self, Error> {
        let rgb = Surface::of_model(text, options)?;
        // a factor by colour makes a table of it
        let exact = matches!(rgb.form(), SurfaceForm::Brdf(_));
        let spectral = parse_model(text).ok().and_then(|m| m.spectral());
        Ok(match spectral.filter(|_| exact) {
            Some(model) => {
                let bands = Channels::new(Basis::Bands(mixing_bands()), &light::daylight());
                let bands = bands.seeing(|seeing| model.in_channels(seeing));
                let form = Form::Model(model, bands);
                Self { rgb, form }
            }
            None => Self::of_rgb(rgb),
        })
    }

    /// The same reflectance in all directions.
    pub(crate) fn flat(rgb: Surface, reflectance: Spectrum) -> Self {
        let form = Form::Flat(reflectance);
        Self { rgb, form }
    }

    /// The same reflectance in all directions, of a linear sRGB colour in [0, 1].
    pub(crate) fn colour(rgb: Surface, colour: [f64; 3]) -> Self {
        let form = Form::Colour(colour);
        Self { rgb, form }
    }

    /// What is the same in all directions.
    fn constant(&self) -> Option<Spectrum> {
        match &self.form {
            Form::Flat(spectrum) => Some(spectrum.clone()),
            Form::Colour(colour) => Some(light::colour(*colour)),
            _ => None,
        }
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

    /// The channels it is given in; linear sRGB for models and colours.
    fn basis(&self) -> Basis {
        match &self.form {
            Form::Grid(table, _) => table.basis().clone(),
            Form::Measured(measured, _) => measured.basis().clone(),
            Form::Flat(_) | Form::Model(..) => Basis::Bands(mixing_bands()),
            Form::Rgb(_) | Form::Colour(_) => srgb(),
        }
    }

    /// f_r in the channels of [`Self::basis`].
    fn eval(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        match &self.form {
            Form::Grid(table, interpolation) => return table.eval(wi, wo, *interpolation, out),
            Form::Rgb(brdf) => out.copy_from_slice(&brdf.eval(wi, wo)),
            Form::Model(_, bands) => out.copy_from_slice(&bands.eval(wi, wo)),
            Form::Colour(_) => out.copy_from_slice(&self.rgb.brdf().eval(wi, wo)),
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
}

/// Whether the channels are bands.
fn bands(table: &HalfDiffTable) -> bool {
    matches!(table.basis(), Basis::Bands(_))
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
