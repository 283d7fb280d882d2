//! Fits beside the measurement: polar lobes and rendered spheres.

use super::one::Source;
use crate::verbs::Context;
use crate::{curves, load};
use anyhow::Result;
use brdf::{Brdf, Computed, Measured};
use brdf_fit::Fit;
use brdf_fit::export::{Model3, scene_materials};
use plot::{Curve, PolarPlot, Radius, Stroke};
use scene_io::image::{Metadata, Picture, write_png};
use scene_io::{Overrides, SceneFile, build_scene};
use spectrum::{Basis, RgbSpace};
use std::iter;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tracer::Film;

/// Fits shown beside the measurement: more would not be told apart.
const SHOWN: usize = 4;
/// Where the light stands in polar plots, degrees.
const LIGHTS_DEG: [f64; 2] = [30.0, 65.0];
/// Powers of ten of the radius.
const DECADES: f64 = 4.0;
/// Pixels of one sphere, and samples a pixel.
const SIDE: u32 = 160;
const SPP: u32 = 64;

/// Luminance in the plane of incidence: the data solid, the best fits dashed.
pub(super) fn polar(
    context: &Context,
    source: &Source,
    fits: &[Fit],
    folder: &Path,
) -> Result<PathBuf> {
    let mut drawn: Vec<Curve> = Vec::new();
    let weights = Basis::Rgb(RgbSpace::srgb()).luminance_weights();
    let luminance = |f: [f64; 3]| -> f64 { f.iter().zip(&weights).map(|(f, w)| f * w).sum() };
    let data: Arc<dyn Measured> = match source {
        Source::File(path, reading) => load::measured(context, path, *reading)?.measured,
        Source::Model(model) => Arc::new(Computed::new(Arc::clone(&model.built.brdf))),
    };
    for (k, deg) in LIGHTS_DEG.into_iter().enumerate() {
        let legend = |name: &str| {
            if k == 0 {
                name.to_owned()
            } else {
                String::new()
            }
        };
        let theta = f64::to_radians(deg);
        drawn.push(curves::luminance_lobe(
            &*data,
            &legend("data"),
            theta,
            [0, 0, 0],
        ));
        for (n, fit) in fits.iter().take(SHOWN).enumerate() {
            let model = Model3::new(&fit.parts)?;
            let f = |wi, wo| luminance(model.eval(wi, wo));
            let mut curve = curves::lobe_of(f, &legend(&fit.name), theta, plot::palette(n));
            curve.stroke = Stroke::Dashed;
            drawn.push(curve);
        }
    }
    let plot = PolarPlot {
        title: format!(
            "{} and its best fits (luminance)",
            load::label(Path::new(&source.name()))
        ),
        radius_label: "f_r (1/sr)".into(),
        radius: Radius::Log { decades: DECADES },
        curves: drawn,
        incident: LIGHTS_DEG.map(|deg| (-deg.to_radians(), [0, 0, 0])).into(),
    };
    let path = folder.join("polar.svg");
    load::write_picture(&path, &plot.svg(900)?)?;
    Ok(path)
}

/// The measurement on the left, the best fits after it, best first, each alone under one light.
pub(super) fn spheres(
    context: &Context,
    source: &Source,
    fits: &[Fit],
    folder: &Path,
) -> Result<PathBuf> {
    let measured = match source {
        Source::File(path, _) => format!("        \"m\": File(path: {:?}),\n", absolute(path)),
        Source::Model(model) => format!("        \"m\": Model(model: \"{model}\"),\n"),
    };
    let fitted = fits.iter().take(SHOWN);
    let materials = iter::once(measured).chain(fitted.map(|fit| scene_materials("m", &fit.parts)));
    let path = folder.join("spheres.png");
    let (mut pictures, mut built) = (Vec::new(), None);
    for materials in materials {
        let mut file = SceneFile::from_text(&scene(&materials), &path, Path::new(""))?;
        if let Source::File(_, reading) = source {
            // the fits are models: it is the only file
            let materials = file.materials.values_mut();
            materials.for_each(|spec| reading.apply(spec));
        }
        let one = build_scene(file, &Overrides::default(), &context.places)?;
        let mut film = Film::new(one.size.0, one.size.1, 8);
        tracer::render(&one.scene, &one.settings, &mut film, &())?;
        pictures.push(Picture::of_film(&film)?);
        built = Some(one);
    }
    if let Some(built) = built {
        let picture = side_by_side(&pictures);
        write_png(&path, &picture, built.tone_map(&picture))?;
    }
    Ok(path)
}

/// A sphere of material `m`, so far away that its picture is nearly orthographic. It is alone: narrow lobes would show neighbours.
fn scene(materials: &str) -> String {
    let fov = 2.0 * (1.15_f64 / 60.0).atan().to_degrees();
    format!(
        "(
    camera: (position: (0, 0, 60), target: (0, 0, 0), fov_y_deg: {fov:.6}),
    film: (width: {SIDE}, height: {SIDE}),
    render: (spp: {SPP}, depth: 1),
    materials: {{
{materials}    }},
    shapes: [(form: Sphere(center: (0, 0, 0), radius: 1), material: \"m\")],
    lights: [Constant(radiance: 0.3), Directional(direction: (-1, -1.2, -0.9), irradiance: 2.5)],
)
"
    )
}

/// Pictures of one size, from left to right.
fn side_by_side(pictures: &[Picture]) -> Picture {
    let (side, count) = (SIDE as usize, pictures.len());
    let rows = (0..side).flat_map(|y| pictures.iter().map(move |p| &p.pixels[y * side..][..side]));
    Picture {
        width: side * count,
        height: side,
        pixels: rows.flatten().copied().collect(),
        variance: None,
        metadata: Metadata::default(),
    }
}

fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}
