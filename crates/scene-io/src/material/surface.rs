//! Any material as linear sRGB reflectance.

use super::loaded::{Form, LoadedMeasured};
use super::measured_file::load_measured;
use super::measured_model;
use super::native::Native;
use super::options::MaterialOptions;
use super::pair::{self, SamplerReport, Visitor};
use crate::build::Places;
use crate::cache::{Cache, combine};
use crate::error::Error;
use crate::scene::{InterpolationName, MaterialSpec, SamplerName};
use crate::sealed::content_hash;
use crate::spectral;
use brdf::{Brdf, DirectionSampler, Material, Measured, Paired, Status, Symmetry};
use brdf_measure::MERL_DIMS;
use brdf_models::{Built, Lambert, ParsedModel, parse_model};
use brdf_table::scattered::DEFAULT_DIMS;
use brdf_table::{
    GriddedN, HalfDiffTable, Interpolation, PhiDomain, RglN, RglTable, ThinPlate, resample,
};
use glam::DVec3;
use spectrum::{Basis, RgbSpace};
use std::fmt;
use std::path::PathBuf;
use std::sync::Arc;

/// Reflectance in linear sRGB, before a sampler is chosen for it.
pub struct Surface {
    form: Form3,
    /// What was found and done, for people.
    notes: Vec<String>,
}

enum Form3 {
    Grid(GriddedN<3>),
    /// With its full text, which is all its values depend on.
    Model(Built<3>, String),
    Native(Native),
}

/// What a surface in linear sRGB is made of.
pub(crate) enum SurfaceForm<'a> {
    Grid(&'a GriddedN<3>),
    Brdf(Arc<dyn Brdf<3>>),
}

impl fmt::Debug for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Surface")
            .field("notes", &self.notes)
            .finish_non_exhaustive()
    }
}

impl Surface {
    /// A measured file. Grids stay as they are; thin plates, slow to evaluate, are resampled onto one. Everything else
    /// is rendered through its own answers: a grid would smooth the steps of `nearest`.
    ///
    /// The grid of a thin plate is kept in `cache`.
    ///
    /// # Errors
    /// If the channels cannot be converted.
    pub fn of_file(
        loaded: &LoadedMeasured,
        options: &MaterialOptions,
        cache: &Cache,
    ) -> Result<Self, Error> {
        let mut notes = loaded.notes();
        let (table, interpolation) = match &loaded.form {
            Form::Rgl(table, key) => return Self::rgl(table, (*key, notes), options.scale),
            Form::Grid(grid) => (Arc::clone(&grid.table), grid.interpolation),
            Form::ThinPlate(plate, key) => (
                Arc::new(from_plate(plate, (*key, cache), &mut notes)?),
                Interpolation::Linear,
            ),
            Form::Opaque(key) => {
                let measured = Arc::clone(&loaded.measured);
                let form = Form3::Native(Native::new(measured, *key, options.scale)?);
                return Ok(Self { form, notes });
            }
        };
        let table = scaled(linear(table)?, options.scale)?;
        Self::grid(table, interpolation, notes)
    }

    /// A material by itself, with the path it was read from; mixtures need the materials of their scene and are refused.
    ///
    /// # Errors
    /// Missing or broken files, models that do not exist.
    pub fn of_spec(spec: &MaterialSpec, places: &Places) -> Result<(Self, Option<PathBuf>), Error> {
        let without = SamplerName::Auto;
        Ok(match spec {
            MaterialSpec::File(m) => {
                let path = places.data.find(&m.path, &m.home)?;
                let options = MaterialOptions::of_file(m, without);
                let loaded = load_measured(&path, &options)?;
                (Self::of_file(&loaded, &options, &places.cache)?, Some(path))
            }
            MaterialSpec::Model(m) => {
                let options = MaterialOptions::of_model(m, without);
                (Self::of_model(&m.model, &options)?, None)
            }
            MaterialSpec::Measured(m) => {
                let options = MaterialOptions::of_model(m, without);
                (Self::of_measured_model(&m.model, &options)?, None)
            }
            MaterialSpec::Lambert {
                reflectance,
                spectrum: Some(rows),
            } => {
                let spectrum = spectral::reflectance(rows)?.scaled(reflectance.0[0]);
                let rgb = srgb().project(&spectrum);
                (Self::constant(std::array::from_fn(|c| rgb[c])), None)
            }
            MaterialSpec::Lambert { reflectance, .. } => {
                let [r, g, b] = reflectance.0;
                let text = format!("lambert:kd={r}/{g}/{b}");
                (Self::of_model(&text, &MaterialOptions::default())?, None)
            }
            MaterialSpec::Mix(_) => {
                return Err(Error::invalid(
                    "expected a material by itself, found a mixture",
                ));
            }
        })
    }

    /// A model evaluated exactly, `ggx:alpha=0.1`.
    ///
    /// # Errors
    /// If the text names no model or a parameter is wrong.
    pub fn of_model(text: &str, options: &MaterialOptions) -> Result<Self, Error> {
        let parsed = parse(text)?;
        if !is_one(options.scale) {
            // A scaled model is no longer that model: it becomes a table like any measurement.
            return Self::of_measured_model(text, options);
        }
        let text = parsed.to_string();
        Ok(Self {
            notes: vec![parsed.to_string()],
            form: Form3::Model(parsed.built, text),
        })
    }

    /// A model measured without noise onto the MERL grid, then treated like a file.
    ///
    /// # Errors
    /// As [`Self::of_model`].
    pub fn of_measured_model(text: &str, options: &MaterialOptions) -> Result<Self, Error> {
        let parsed = parse(text)?;
        let interpolation = match options.interpolation {
            InterpolationName::Auto | InterpolationName::Linear => Interpolation::Linear,
            InterpolationName::Nearest => Interpolation::Nearest,
            other => {
                let message = format!("expected nearest or linear for a grid, found \"{other}\"");
                return Err(Error::invalid(message).in_field("interpolation"));
            }
        };
        let table = measured_model::measured(&*parsed.built.brdf)?;
        let notes = vec![format!("{parsed} on a grid of 90 x 90 x 180 cells")];
        let table = scaled(Arc::new(table), options.scale)?;
        Self::grid(table, interpolation, notes)
    }

    /// A weighted sum, tabulated on the MERL grid.
    ///
    /// # Errors
    /// If the sum has no cells.
    pub fn mix(parts: &[(Self, f64)]) -> Result<Self, Error> {
        let reciprocal = parts.iter().all(|(s, _)| s.symmetry().reciprocal);
        let [n_h, n_d, n_p] = MERL_DIMS.map(|n| n as usize);
        // the full circle at the resolution of the half
        let (dims, phi) = if reciprocal {
            ([n_h, n_d, n_p], PhiDomain::Reciprocal)
        } else {
            ([n_h, n_d, 2 * n_p], PhiDomain::Full)
        };
        let table = HalfDiffTable::from_fn(dims, phi, srgb(), |wi, wo, out| {
            out.fill(0.0);
            let mut worst = Status::Measured;
            for (part, weight) in parts {
                let (f, status) = part.eval(wi, wo);
                out.iter_mut().zip(f).for_each(|(o, v)| *o += weight * v);
                worst = worst.max(status);
            }
            worst
        });
        let notes = parts.iter().flat_map(|(s, _)| s.notes.clone()).collect();
        Self::grid(Arc::new(table), Interpolation::Linear, notes)
    }

    /// The same albedo in all directions; out of gamut, it may be negative.
    pub(crate) fn constant(albedo: [f64; 3]) -> Self {
        let lambert = Arc::new(Lambert { albedo });
        let built = Built {
            brdf: Arc::clone(&lambert) as Arc<dyn Brdf<3>>,
            sampler: Arc::clone(&lambert) as Arc<dyn DirectionSampler>,
            material: Box::new(Paired {
                brdf: Arc::clone(&lambert),
                sampler: lambert,
            }),
        };
        let [r, g, b] = albedo;
        let text = format!("lambert:kd={r}/{g}/{b}");
        Self {
            notes: vec![text.clone()],
            form: Form3::Model(built, text),
        }
    }

    /// A table in linear sRGB.
    pub(crate) fn of_table(
        table: HalfDiffTable,
        interpolation: Interpolation,
        notes: Vec<String>,
    ) -> Result<Self, Error> {
        Self::grid(Arc::new(table), interpolation, notes)
    }

    /// A measured file as cells in its own channels, if it is rendered as cells.
    ///
    /// The grid of a thin plate is kept in `cache`.
    pub(crate) fn native_grid(
        loaded: &LoadedMeasured,
        cache: &Cache,
    ) -> Option<(Arc<HalfDiffTable>, Interpolation, Vec<String>)> {
        let mut notes = loaded.notes();
        match &loaded.form {
            Form::Grid(grid) => Some((Arc::clone(&grid.table), grid.interpolation, notes)),
            Form::ThinPlate(plate, key) => {
                let table = resampled(plate, (*key, cache), &mut notes);
                Some((Arc::new(table), Interpolation::Linear, notes))
            }
            Form::Rgl(..) | Form::Opaque(_) => None,
        }
    }

    /// What it is made of.
    pub(crate) fn form(&self) -> SurfaceForm<'_> {
        match &self.form {
            Form3::Grid(grid) => SurfaceForm::Grid(grid),
            Form3::Model(model, _) => SurfaceForm::Brdf(Arc::clone(&model.brdf)),
            Form3::Native(native) => SurfaceForm::Brdf(Arc::clone(&native.brdf)),
        }
    }

    fn rgl(
        table: &Arc<RglTable>,
        (key, notes): (u64, Vec<String>),
        scale: [f64; 3],
    ) -> Result<Self, Error> {
        let measured = Arc::clone(table) as Arc<dyn Measured>;
        let mut native = Native::new(measured, key, scale)?;
        if let Some(whole) = RglN::<3>::new(Arc::clone(table)).filter(|_| is_one(scale)) {
            native.brdf = Arc::new(whole);
        }
        native.sampler = Some(Arc::clone(table));
        Ok(Self {
            form: Form3::Native(native),
            notes,
        })
    }

    fn grid(
        table: Arc<HalfDiffTable>,
        interpolation: Interpolation,
        notes: Vec<String>,
    ) -> Result<Self, Error> {
        let grid =
            GriddedN::new(table, interpolation).map_err(|e| Error::invalid(e.to_string()))?;
        Ok(Self {
            form: Form3::Grid(grid),
            notes,
        })
    }

    /// The reflectance.
    #[must_use]
    pub fn brdf(&self) -> &dyn Brdf<3> {
        match &self.form {
            Form3::Grid(grid) => grid,
            Form3::Model(model, _) => &*model.brdf,
            Form3::Native(native) => &*native.brdf,
        }
    }

    /// f_r in 1/sr, and where it came from; models are as good as measured.
    fn eval(&self, wi: DVec3, wo: DVec3) -> ([f64; 3], Status) {
        match &self.form {
            Form3::Grid(grid) => {
                let mut out = [0.0; 3];
                let status = grid.table().eval(wi, wo, grid.interpolation(), &mut out);
                (out, status)
            }
            Form3::Model(model, _) => (model.brdf.eval(wi, wo), Status::Measured),
            Form3::Native(native) => native.eval(wi, wo),
        }
    }

    fn symmetry(&self) -> Symmetry {
        self.brdf().symmetry()
    }

    /// The reflectance with the sampler `name` stands for.
    ///
    /// # Errors
    /// If that sampler does not go with this reflectance.
    pub fn material(
        self,
        name: SamplerName,
        cache: &Cache,
    ) -> Result<(Box<dyn Material<3>>, SamplerReport), Error> {
        let (material, mut report) = match (self.form, name) {
            (Form3::Model(model, _), SamplerName::Auto | SamplerName::Native) => {
                let report = SamplerReport::new(SamplerName::Native, model.sampler.bytes());
                (model.material, report)
            }
            (Form3::Model(model, text), _) => {
                let key = |_: &_| content_hash(text.as_bytes());
                pair::pair(model.brdf, name, (key, cache))?
            }
            (Form3::Native(native), _) => native.material(name, cache)?,
            (Form3::Grid(grid), _) => pair::pair(grid, name, (pair::table_key, cache))?,
        };
        report.notes.splice(..0, self.notes);
        Ok((material, report))
    }

    /// Whether a sampler of its own comes with it: [`SamplerName::Native`].
    #[must_use]
    pub fn has_native_sampler(&self) -> bool {
        match &self.form {
            Form3::Grid(_) => false,
            Form3::Model(..) => true,
            Form3::Native(native) => native.sampler.is_some(),
        }
    }

    /// Hands the sampler `name` stands for, in its concrete type, to `visitor`.
    pub(crate) fn sampler<V: Visitor>(
        &self,
        name: SamplerName,
        cache: &Cache,
        visitor: V,
    ) -> Result<V::Out, Error> {
        match (&self.form, name) {
            (Form3::Model(model, _), SamplerName::Auto | SamplerName::Native) => {
                let report = SamplerReport::new(SamplerName::Native, 0);
                Ok(visitor.visit(Arc::clone(&model.sampler), report))
            }
            (Form3::Model(model, text), _) => {
                let key = |_: &_| content_hash(text.as_bytes());
                pair::build(&model.brdf, name, (key, cache), visitor)
            }
            (Form3::Native(native), _) => native.sampler(name, cache, visitor),
            (Form3::Grid(grid), _) => pair::build(grid, name, (pair::table_key, cache), visitor),
        }
    }
}

fn parse(text: &str) -> Result<ParsedModel<3>, Error> {
    parse_model(text).map_err(|e| Error::invalid(e.to_string()).in_field("model"))
}

fn srgb() -> Basis {
    Basis::Rgb(RgbSpace::srgb())
}

fn from_plate(
    plate: &ThinPlate,
    (key, cache): (u64, &Cache),
    notes: &mut Vec<String>,
) -> Result<HalfDiffTable, Error> {
    let matrix = plate.basis().to_linear_srgb();
    let plate = plate
        .to_basis(srgb(), &matrix)
        .map_err(|e| Error::invalid(e.to_string()))?;
    Ok(resampled(&plate, (key, cache), notes))
}

/// A thin plate on its grid, in the channels it has.
fn resampled(
    plate: &ThinPlate,
    (key, cache): (u64, &Cache),
    notes: &mut Vec<String>,
) -> HalfDiffTable {
    let [n_h, n_d, n_p] = DEFAULT_DIMS.map(|n| n as u64);
    let channels = content_hash(format!("{:?}", plate.basis()).as_bytes());
    let resampled = cache.grid(combine(&[key, channels, n_h, n_d, n_p]), notes, || {
        resample(plate, plate.domain(), DEFAULT_DIMS)
    });
    notes.push(format!(
        "resampled onto {} x {} x {} cells, RMS error {:.2} % of the mean",
        DEFAULT_DIMS[0],
        DEFAULT_DIMS[1],
        DEFAULT_DIMS[2],
        100.0 * resampled.relative_error()
    ));
    resampled.table
}

fn scaled(table: Arc<HalfDiffTable>, scale: [f64; 3]) -> Result<Arc<HalfDiffTable>, Error> {
    if is_one(scale) {
        return Ok(table);
    }
    let matrix: Vec<Vec<f64>> = (0..3)
        .map(|c| {
            (0..3)
                .map(|k| if c == k { scale[c] } else { 0.0 })
                .collect()
        })
        .collect();
    table
        .map_channels(&matrix, srgb())
        .map(Arc::new)
        .map_err(|e| Error::invalid(e.to_string()).in_field("scale"))
}

/// The table in linear sRGB, if its channels are others.
fn linear(table: Arc<HalfDiffTable>) -> Result<Arc<HalfDiffTable>, Error> {
    if *table.basis() == srgb() {
        return Ok(table);
    }
    let rows = table.basis().to_linear_srgb();
    let matrix: Vec<Vec<f64>> = rows.iter().map(|r| r.to_vec()).collect();
    let mapped = table.map_channels(&matrix, srgb()).map(Arc::new);
    mapped.map_err(|e| Error::invalid(e.to_string()))
}

fn is_one(scale: [f64; 3]) -> bool {
    scale.iter().all(|s| (s - 1.0).abs() == 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(phi: PhiDomain, status: impl Fn(DVec3) -> Status + Sync) -> Surface {
        let table = HalfDiffTable::from_fn([18, 6, 12], phi, srgb(), |wi, wo, out| {
            out.fill(0.3);
            status((wi + wo).normalize())
        });
        Surface::grid(Arc::new(table), Interpolation::Linear, Vec::new()).unwrap()
    }

    fn diffuse() -> Surface {
        Surface::of_model("lambert:kd=0.5", &MaterialOptions::default()).unwrap()
    }

    fn mixed(part: Surface) -> Arc<HalfDiffTable> {
        let mix = Surface::mix(&[(part, 0.5), (diffuse(), 0.5)]).unwrap();
        match mix.form {
            Form3::Grid(grid) => Arc::clone(grid.table()),
            _ => panic!("a mixture is a grid"),
        }
    }

    #[test]
    fn a_mixture_was_measured_only_where_all_parts_were() {
        let status = |half: DVec3| match half.z > 0.7 {
            true => Status::Measured,
            false => Status::Filled,
        };
        let table = mixed(grid(PhiDomain::Reciprocal, status));
        assert_eq!(table.dims(), [90, 90, 180]);
        assert!(table.is_valid([5, 5, 90]), "near the normal");
        // theta_h of cell 80 is 71 degrees
        assert!(!table.is_valid([80, 5, 90]), "toward grazing");
    }

    #[test]
    fn a_mixture_that_is_not_reciprocal_keeps_one_degree_of_azimuth() {
        let table = mixed(grid(PhiDomain::Mirror, |_| Status::Measured));
        assert_eq!(table.dims(), [90, 90, 360]);
        assert_eq!(table.phi_domain(), PhiDomain::Full);
    }
}
