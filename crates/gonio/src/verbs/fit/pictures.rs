//! Fits beside the measurement: polar lobes and rendered spheres.

use super::one::Source;
use crate::verbs::Context;
use crate::{curves, load};
use anyhow::Result;
use brdf::Brdf;
use brdf_fit::Fit;
use brdf_fit::export::{Model3, scene_materials};
use plot::{Curve, PolarPlot, Radius, Stroke};
use scene_io::image::{Picture, write_png};
use scene_io::{Overrides, SceneFile, build_scene};
use spectrum::{Basis, RgbSpace};
use std::path::{Path, PathBuf};
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
    for (k, deg) in LIGHTS_DEG.into_iter().enumerate() {
        let legend = |name: &str| {
            if k == 0 {
                name.to_owned()
            } else {
                String::new()
            }
        };
        let theta = f64::to_radians(deg);
        drawn.push(match source {
            Source::File(path, reading) => {
                let loaded = load::measured(context, path, *reading)?;
                curves::luminance_lobe(&*loaded.measured, &legend("data"), theta, [0, 0, 0])
            }
            Source::Model(model) => {
                let f = |wi, wo| luminance(model.built.brdf.eval(wi, wo));
                curves::lobe_of(f, &legend("data"), theta, [0, 0, 0])
            }
        });
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

/// The measurement on the left, the best fits after it, best first, under one light.
pub(super) fn spheres(
    context: &Context,
    source: &Source,
    fits: &[Fit],
    folder: &Path,
) -> Result<PathBuf> {
    let fits = &fits[..fits.len().min(SHOWN)];
    let mut materials = match source {
        Source::File(path, _) => format!("        \"m0\": File(path: {:?}),\n", absolute(path)),
        Source::Model(model) => format!("        \"m0\": Model(model: \"{model}\"),\n"),
    };
    for (k, fit) in fits.iter().enumerate() {
        materials.push_str(&scene_materials(&format!("m{}", k + 1), &fit.parts));
    }
    let count = fits.len() + 1;
    let shapes: String = (0..count)
        .map(|k| {
            let x = 2.2 * (k as f64 - 0.5 * (count - 1) as f64);
            format!(
                "        (form: Sphere(center: ({x:.3}, 0, 0), radius: 1), material: \"m{k}\"),\n"
            )
        })
        .collect();
    // far away, so that all spheres are seen alike
    let distance = 60.0 * count as f64;
    let fov = 2.0 * (1.15 / distance).atan().to_degrees();
    let width = SIDE * count as u32;
    let text = format!(
        "(
    camera: (position: (0, 0, {distance}), target: (0, 0, 0), fov_y_deg: {fov:.6}),
    film: (width: {width}, height: {SIDE}),
    render: (spp: {SPP}, depth: 1),
    materials: {{
{materials}    }},
    shapes: [
{shapes}    ],
    lights: [Constant(radiance: 0.3), Directional(direction: (-1, -1.2, -0.9), irradiance: 2.5)],
)
"
    );
    let path = folder.join("spheres.png");
    let mut file = SceneFile::from_text(&text, &path, Path::new(""))?;
    if let Source::File(_, reading) = source {
        // the fits are models: it is the only file
        let materials = file.materials.values_mut();
        materials.for_each(|spec| reading.apply(spec));
    }
    let built = build_scene(file, &Overrides::default(), &context.places)?;
    let mut film = Film::new(built.size.0, built.size.1, 8);
    tracer::render(&built.scene, &built.settings, &mut film, &())?;
    let picture = Picture::of_film(&film)?;
    write_png(&path, &picture, built.tone_map(&picture))?;
    Ok(path)
}

fn absolute(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned())
}
