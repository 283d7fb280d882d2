//! Surfaces of a scene as the tracer's objects.

use super::Places;
use super::materials::Index;
use crate::error::Error;
use crate::mesh::{self, Triangles};
use crate::scene::{FormSpec, SceneFile, ShapeSpec, TransformSpec, plain};
use crate::spectral::Palette;
use glam::{DAffine3, DQuat, DVec2, DVec3};
use tracer::{Mesh, Object, Shape};

pub(super) fn objects<const N: usize, P: Palette<N>>(
    file: &SceneFile,
    (index, palette): (&Index, &P),
    places: &Places,
    notes: &mut Vec<String>,
) -> Result<Vec<Object<N, P::Mode>>, Error> {
    let mut out = Vec::new();
    for (k, spec) in file.shapes.iter().enumerate() {
        let field = format!("shapes[{k}]");
        let shape = form(spec, places, notes).map_err(|e| e.in_field(&field))?;
        let material = index.get(&spec.material).copied().ok_or_else(|| {
            Error::invalid(format!("no material \"{}\"", spec.material)).in_field(&field)
        })?;
        let light = |colour| palette.light(colour, spec.emission_spectrum.as_ref());
        let emission = spec.emission.map(light).transpose();
        out.push(Object {
            transform: transform(&spec.transform),
            emission: emission.map_err(|e| e.in_field(&field))?,
            one_sided: spec.one_sided,
            ..Object::new(shape, material)
        });
    }
    Ok(out)
}

fn form(spec: &ShapeSpec, places: &Places, notes: &mut Vec<String>) -> Result<Shape, Error> {
    Ok(match &spec.form {
        FormSpec::Sphere { center, radius } => Shape::Sphere {
            center: DVec3::from(plain(*center)),
            radius: radius.0,
        },
        FormSpec::Quad {
            corner,
            edge_u,
            edge_v,
        } => Shape::Quad {
            corner: DVec3::from(plain(*corner)),
            edge_u: DVec3::from(plain(*edge_u)),
            edge_v: DVec3::from(plain(*edge_v)),
        },
        FormSpec::Mesh { path, flat, home } => {
            let path = places.data.find(path, home)?;
            let mut triangles = mesh::read_mesh(&path)?;
            if triangles.dropped > 0 {
                notes.push(format!(
                    "{}: {} triangles without area were left out",
                    path.display(),
                    triangles.dropped
                ));
            }
            if *flat {
                triangles.normals = None;
            }
            Shape::Mesh(tracer_mesh(triangles))
        }
        FormSpec::UvSphere {
            center,
            radius,
            segments,
        } => {
            let center = DVec3::from(plain(*center));
            let triangles = mesh::uv_sphere(center, radius.0, segments.0 as usize)?;
            Shape::Mesh(tracer_mesh(triangles))
        }
        FormSpec::Lathe { profile, segments } => {
            let profile: Vec<DVec2> = (profile.iter())
                .map(|(r, y)| DVec2::new(r.0, y.0))
                .collect();
            Shape::Mesh(tracer_mesh(mesh::lathe(&profile, segments.0 as usize)?))
        }
    })
}

fn tracer_mesh(t: Triangles) -> Mesh {
    Mesh {
        positions: t.positions,
        triangles: t.triangles,
        normals: t.normals,
    }
}

/// Steps in the order they are written: the first is applied first.
fn transform(steps: &[TransformSpec]) -> DAffine3 {
    steps.iter().fold(DAffine3::IDENTITY, |done, step| {
        let next = match step {
            TransformSpec::Translate(by) => DAffine3::from_translation(DVec3::from(plain(*by))),
            TransformSpec::Rotate { axis, angle_deg } => {
                let axis = DVec3::from(plain(*axis)).normalize_or(DVec3::Y);
                DAffine3::from_quat(DQuat::from_axis_angle(axis, angle_deg.0.to_radians()))
            }
            TransformSpec::Scale(by) => DAffine3::from_scale(DVec3::from(by.map(|s| s.0))),
        };
        next * done
    })
}
