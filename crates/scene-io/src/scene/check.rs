//! What no single number shows: names that must exist, lengths that must not vanish, products that must fit.

use super::checked::{Colour, Radiometric, Wavelength, plain};
use super::names::SpectrumName;
use super::resolve::{CameraSpec, SceneFile};
use super::schema::{
    FilterSpec, FormSpec, LightSpec, LightSpectrum, MaterialSpec, ShapeSpec, TransformSpec,
};
use crate::error::Error;
use glam::DVec3;
use spectrum::Bins;
use std::collections::BTreeMap;

/// Most pixels of an image: 2^26, 0.8 GB of f32 RGB.
const MAX_PIXELS: u64 = 1 << 26;
/// Most memory of a film's sums: 8 GiB.
const MAX_FILM_BYTES: u64 = 8 << 30;
/// A film keeps the sums of this many independent parts of its samples, f64 a channel, to know its error.
const REPLICATES: u64 = 8;
/// Most shapes of a scene.
const MAX_SHAPES: usize = 1_000_000;
/// Most points of a lathe profile.
const MAX_PROFILE: usize = 1000;

pub(super) fn scene(scene: &SceneFile) -> Result<(), Error> {
    camera(&scene.camera).map_err(|e| e.in_field("camera"))?;
    film(scene).map_err(|e| e.in_field("film"))?;
    let [from, to] = scene.render.range_nm;
    if from >= to {
        let message = format!("expected two ascending wavelengths, found {from} and {to}");
        return Err(Error::invalid(message).in_field("render.range_nm"));
    }
    if let Some(edges) = &scene.render.edges_nm {
        edges_nm(edges).map_err(|e| e.in_field("render.edges_nm"))?;
    }
    if let Some(name) = &scene.main_material {
        known(name, &scene.materials).map_err(|e| e.in_field("main_material"))?;
    }
    for (name, spec) in &scene.materials {
        material(name, spec, &scene.materials)
            .map_err(|e| e.in_field(&format!("materials.{name}")))?;
    }
    if scene.shapes.len() > MAX_SHAPES {
        let message = format!(
            "expected at most {MAX_SHAPES}, found {}",
            scene.shapes.len()
        );
        return Err(Error::invalid(message).in_field("shapes"));
    }
    for (k, spec) in scene.shapes.iter().enumerate() {
        shape(spec, &scene.materials).map_err(|e| e.in_field(&format!("shapes[{k}]")))?;
    }
    let mut surrounding = 0;
    for (k, light) in scene.lights.iter().enumerate() {
        if let LightSpec::Directional { direction, .. } = light {
            not_zero(DVec3::from(plain(*direction)))
                .map_err(|e| e.in_field(&format!("lights[{k}].direction")))?;
        }
        let (colour, spectrum) = light.shine();
        light_spectrum(colour, spectrum)
            .map_err(|e| e.in_field(&format!("lights[{k}].spectrum")))?;
        let environment = matches!(light, LightSpec::Constant { .. } | LightSpec::Image { .. });
        surrounding += usize::from(environment);
    }
    if surrounding > 1 {
        let message = format!("expected at most one Constant or Image light, found {surrounding}");
        return Err(Error::invalid(message).in_field("lights"));
    }
    Ok(())
}

/// As many as one of the modes has, in order.
fn edges_nm(edges: &[f64]) -> Result<(), Error> {
    if !matches!(edges.len(), 9 | 17 | 46) {
        return Err(Error::invalid(format!(
            "expected 9, 17 or 46 edges for 8, 16 or 45 bins, found {}",
            edges.len()
        )));
    }
    match Bins::new(edges.to_vec()) {
        Ok(_) => Ok(()),
        Err(e) => Err(Error::invalid(e.to_string())),
    }
}

fn camera(camera: &CameraSpec) -> Result<(), Error> {
    let view = DVec3::from(camera.target) - DVec3::from(camera.position);
    not_zero(view).map_err(|_| {
        Error::invalid("expected a point away from `position`, found the same point")
            .in_field("target")
    })?;
    let up = DVec3::from(camera.up);
    not_zero(up).map_err(|e| e.in_field("up"))?;
    if view.normalize().cross(up.normalize()).length() < 1e-6 {
        let message = "expected a direction across the line of sight, found one along it";
        return Err(Error::invalid(message).in_field("up"));
    }
    Ok(())
}

fn film(scene: &SceneFile) -> Result<(), Error> {
    let pixels = u64::from(scene.film.width) * u64::from(scene.film.height);
    if pixels > MAX_PIXELS {
        return Err(Error::invalid(format!(
            "expected at most {MAX_PIXELS} pixels, found {} x {}",
            scene.film.width, scene.film.height
        )));
    }
    let channels = match scene.render.spectrum {
        SpectrumName::Rgb | SpectrumName::Xyz | SpectrumName::Hero => 3,
        SpectrumName::Eight => 8,
        SpectrumName::Sixteen => 16,
        SpectrumName::FortyFive => 45,
        SpectrumName::Native => 65,
    };
    let bytes = pixels * REPLICATES.min(u64::from(scene.render.spp).max(1)) * 8 * channels;
    if bytes > MAX_FILM_BYTES {
        return Err(Error::invalid(format!(
            "expected a film of at most {} GiB, found {} x {} pixels of {} bytes ({:.1} GiB)",
            MAX_FILM_BYTES >> 30,
            scene.film.width,
            scene.film.height,
            bytes / pixels.max(1),
            bytes as f64 / f64::from(1 << 30),
        )));
    }
    if let FilterSpec::Gaussian { sigma, radius } = scene.film.filter
        && (radius.0 > 8.0 || sigma.0 > 8.0)
    {
        let message = "expected sigma and radius of at most 8 pixels";
        return Err(
            Error::invalid(format!("{message}, found {} and {}", sigma.0, radius.0))
                .in_field("filter"),
        );
    }
    Ok(())
}

/// A light with a spectrum has one number for its brightness, and the spectrum is one.
fn light_spectrum(colour: Colour, spectrum: Option<&LightSpectrum>) -> Result<(), Error> {
    let Some(spectrum) = spectrum else {
        return Ok(());
    };
    if colour
        .0
        .iter()
        .any(|c| c.to_bits() != colour.0[0].to_bits())
    {
        let [r, g, b] = colour.0;
        return Err(Error::invalid(format!(
            "expected one number for the brightness of a spectrum, found ({r}, {g}, {b})"
        )));
    }
    crate::spectral::check_light(spectrum)
}

fn known(name: &str, materials: &BTreeMap<String, MaterialSpec>) -> Result<(), Error> {
    if materials.contains_key(name) {
        return Ok(());
    }
    let names: Vec<&str> = materials.keys().map(String::as_str).take(20).collect();
    Err(Error::invalid(format!(
        "expected the name of a material ({}), found \"{name}\"",
        names.join(", ")
    )))
}

fn material(
    name: &str,
    spec: &MaterialSpec,
    all: &BTreeMap<String, MaterialSpec>,
) -> Result<(), Error> {
    match spec {
        MaterialSpec::File(file) if file.path.as_os_str().is_empty() => {
            Err(Error::invalid("expected a file name, found \"\"").in_field("path"))
        }
        MaterialSpec::Lambert {
            reflectance,
            spectrum,
        } => albedo(*reflectance, spectrum.as_deref()),
        MaterialSpec::Mix(mix) => {
            if mix.parts.is_empty() {
                return Err(
                    Error::invalid("expected at least one part, found none").in_field("parts")
                );
            }
            for (part, _) in &mix.parts {
                known(part, all).map_err(|e| e.in_field("parts"))?;
                // One level only: every mixture can be written flat, and no circle can arise.
                if part == name || matches!(all.get(part), Some(MaterialSpec::Mix(_))) {
                    let message = format!("expected parts that are not mixtures, found \"{part}\"");
                    return Err(Error::invalid(message).in_field("parts"));
                }
            }
            Ok(())
        }
        _ => Ok(()),
    }
}

fn albedo(colour: Colour, spectrum: Option<&[(Wavelength, Radiometric)]>) -> Result<(), Error> {
    if let Some(rows) = spectrum {
        light_spectrum(colour, Some(&LightSpectrum::Table(rows.to_vec())))
            .map_err(|e| e.in_field("spectrum"))?;
        if let Some((nm, v)) = rows.iter().find(|(_, v)| v.0 * colour.0[0] > 1.0) {
            let message = format!("expected albedos from 0 to 1, found {} at {} nm", v.0, nm.0);
            return Err(Error::invalid(message).in_field("spectrum"));
        }
    }
    match colour.0.into_iter().find(|&c| c > 1.0) {
        Some(c) => Err(
            Error::invalid(format!("expected an albedo from 0 to 1, found {c}"))
                .in_field("reflectance"),
        ),
        None => Ok(()),
    }
}

fn shape(spec: &ShapeSpec, materials: &BTreeMap<String, MaterialSpec>) -> Result<(), Error> {
    known(&spec.material, materials).map_err(|e| e.in_field("material"))?;
    let analytic = matches!(spec.form, FormSpec::Sphere { .. } | FormSpec::Quad { .. });
    if spec.emission.is_some() && !analytic {
        let message = "expected a Sphere or Quad to carry it, found a mesh";
        return Err(Error::unsupported(message).in_field("emission"));
    }
    light_spectrum(
        spec.emission.unwrap_or(Colour([1.0; 3])),
        spec.emission_spectrum.as_ref(),
    )
    .map_err(|e| e.in_field("emission_spectrum"))?;
    match &spec.form {
        FormSpec::Quad { edge_u, edge_v, .. } => {
            let normal = DVec3::from(plain(*edge_u)).cross(DVec3::from(plain(*edge_v)));
            if normal.length() < 1e-20 {
                let message = "expected two edges that span an area, found parallel ones";
                return Err(Error::invalid(message).in_field("form.edge_v"));
            }
        }
        FormSpec::Lathe { profile, .. } => {
            let count = profile.len();
            if !(2..=MAX_PROFILE).contains(&count) {
                let message = format!("expected 2 to {MAX_PROFILE} points, found {count}");
                return Err(Error::invalid(message).in_field("form.profile"));
            }
            if let Some((r, _)) = profile.iter().find(|(r, _)| r.0 < 0.0) {
                let message = format!("expected radii of at least 0, found {}", r.0);
                return Err(Error::invalid(message).in_field("form.profile"));
            }
        }
        _ => {}
    }
    for (k, step) in spec.transform.iter().enumerate() {
        let field = format!("transform[{k}]");
        match step {
            TransformSpec::Rotate { axis, .. } => {
                not_zero(DVec3::from(plain(*axis)))
                    .map_err(|e| e.in_field("axis").in_field(&field))?;
            }
            TransformSpec::Scale([x, y, z])
                if matches!(spec.form, FormSpec::Sphere { .. }) && !(x == y && y == z) =>
            {
                let message = "expected one factor for a Sphere (use UvSphere for an ellipsoid), found several";
                return Err(Error::unsupported(message).in_field(&field));
            }
            _ => {}
        }
    }
    Ok(())
}

fn not_zero(v: DVec3) -> Result<(), Error> {
    if v.length() > 1e-12 {
        Ok(())
    } else {
        Err(Error::invalid(
            "expected a direction, found the zero vector",
        ))
    }
}
