//! Files of scattered rows: which interpolant answers, under which policies.

use super::colour::{ColourMeaning, Recolouring};
use super::loaded::{Detail, Form, LoadedMeasured};
use super::measured_file::Origin;
use super::options::MaterialOptions;
use crate::cache::combine;
use crate::error::Error;
use crate::scene::{BeyondName, GapName, InterpolationName, NegativeName};
use crate::sealed::content_hash;
use brdf::Measured;
use brdf_formats::{File, Format};
use brdf_table::{
    BeyondPolicy, CloudError, GapPolicy, KdNearest, LayerMode, LayeredTable, NegativePolicy,
    Policies, SampleCloud, ThinPlate,
};
use std::path::PathBuf;
use std::sync::Arc;

fn invalid(e: CloudError) -> Error {
    Error::invalid(e.to_string())
}

/// The rows of a file, if rows are what it holds.
pub(super) fn cloud(file: &File) -> Option<Result<SampleCloud, Error>> {
    match file {
        File::Astm(astm) => Some(SampleCloud::from_astm(astm).map_err(invalid)),
        File::PbrtText(text) => Some(SampleCloud::from_pbrt_text(text).map_err(invalid)),
        _ => None,
    }
}

pub(super) fn load(
    format: &'static Format,
    of: Origin,
    cloud: &SampleCloud,
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    let recolouring = Recolouring::new(&options.colour, format, cloud.basis())?;
    let read = recolouring.changes().then(|| recolour(&recolouring, cloud));
    let read = read.transpose()?;
    let cloud = read.as_ref().unwrap_or(cloud);
    let (meaning, of) = match read {
        Some(_) => {
            let key = combine(&[of.key, recolouring.key()]);
            (recolouring.meaning, Origin { key, ..of })
        }
        None => (recolouring.meaning, of),
    };
    let mode = match options.interpolation {
        InterpolationName::Auto | InterpolationName::ThinPlate => {
            return thin_plate((format, of, meaning), cloud, options);
        }
        InterpolationName::KdNearest => None,
        InterpolationName::Nearest => Some(LayerMode::Nearest),
        InterpolationName::Linear => Some(LayerMode::Linear),
        InterpolationName::SquaredLambda => Some(LayerMode::SquaredLambda),
        InterpolationName::LayeredLog => Some(LayerMode::LogLinear),
    };
    only_nearest(options)?;
    let clamped = match options.negatives {
        NegativeName::Auto | NegativeName::Keep => None,
        NegativeName::Clamp => Some(clamped(cloud)?),
    };
    let rows = clamped.as_ref().unwrap_or(cloud);
    let measured: Arc<dyn Measured> = match mode {
        Some(mode) => Arc::new(LayeredTable::new(rows, mode)),
        None => Arc::new(KdNearest::new(rows).map_err(invalid)?),
    };
    let choices = format!("{} {}", options.interpolation, clamped.is_some());
    Ok(LoadedMeasured {
        measured,
        format,
        path: PathBuf::new(),
        bytes: of.bytes,
        colour: meaning,
        detail: Detail::Rows {
            rows: cloud.len(),
            negative_values: cloud.negatives().iter().sum(),
        },
        form: Form::Opaque(combine(&[of.key, content_hash(choices.as_bytes())])),
    })
}

/// The same rows, read as the user says.
fn recolour(as_said: &Recolouring, cloud: &SampleCloud) -> Result<SampleCloud, Error> {
    let rows = cloud.with_basis(as_said.basis.clone(), &as_said.factors);
    rows.map_err(invalid)
}

/// The same rows without negative values.
fn clamped(cloud: &SampleCloud) -> Result<SampleCloud, Error> {
    let angles: Vec<_> = (cloud.geometry().iter())
        .map(|g| [g.theta_i, 0.0, g.theta_o, g.phi])
        .collect();
    let values: Vec<f64> = (0..cloud.len())
        .flat_map(|row| cloud.values(row))
        .map(|v| v.max(0.0))
        .collect();
    SampleCloud::new(cloud.basis().clone(), &angles, &values).map_err(invalid)
}

/// The thesis' schemes have one answer outside the rows: the nearest of them.
fn only_nearest(options: &MaterialOptions) -> Result<(), Error> {
    let refuse = |field: &str, found: &str| {
        let message = format!(
            "expected \"nearest\", all that \"{}\" interpolation can do, found \"{found}\"",
            options.interpolation
        );
        Err(Error::invalid(message).in_field(field))
    };
    match (options.gap, options.beyond) {
        (Some(GapName::Extend), _) => refuse("gap", "extend"),
        (_, Some(BeyondName::Schlick)) => refuse("beyond", "schlick"),
        _ => Ok(()),
    }
}

fn policies(options: &MaterialOptions) -> Policies {
    let defaults = Policies::default();
    Policies {
        negative: match options.negatives {
            NegativeName::Auto | NegativeName::Keep => NegativePolicy::Keep,
            NegativeName::Clamp => NegativePolicy::Clamp,
        },
        gap: match options.gap {
            None => defaults.gap,
            Some(GapName::Extend) => GapPolicy::Extend,
            Some(GapName::Nearest) => GapPolicy::Nearest,
        },
        beyond: match options.beyond {
            None => defaults.beyond,
            Some(BeyondName::Schlick) => BeyondPolicy::Schlick,
            Some(BeyondName::Nearest) => BeyondPolicy::Nearest,
        },
        ..defaults
    }
}

fn thin_plate(
    (format, of, colour): (&'static Format, Origin, ColourMeaning),
    cloud: &SampleCloud,
    options: &MaterialOptions,
) -> Result<LoadedMeasured, Error> {
    let policies = policies(options);
    let plate = ThinPlate::with_policies(cloud, policies).map_err(invalid)?;
    let key = combine(&[of.key, content_hash(format!("{policies:?}").as_bytes())]);
    let plate = Arc::new(plate);
    Ok(LoadedMeasured {
        measured: Arc::clone(&plate) as Arc<dyn Measured>,
        format,
        path: PathBuf::new(),
        bytes: of.bytes,
        colour,
        detail: Detail::Scattered {
            rows: cloud.len(),
            fill: Box::new(plate.report()),
        },
        form: Form::ThinPlate(plate, key),
    })
}
