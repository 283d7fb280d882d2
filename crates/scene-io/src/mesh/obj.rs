//! Wavefront OBJ through `tobj`; all its objects become one mesh.

use super::triangles::Triangles;
use crate::error::Error;
use glam::Vec3;
use std::io::Cursor;

pub(super) fn read(bytes: &[u8]) -> Result<Triangles, Error> {
    let options = tobj::LoadOptions {
        triangulate: true,
        single_index: true,
        ignore_points: true,
        ignore_lines: true,
    };
    // Material libraries are files of their own; nothing in them is of use here.
    let no_materials = |_: &std::path::Path| Ok(Default::default());
    let (models, _) = tobj::load_obj_buf(&mut Cursor::new(bytes), &options, no_materials)
        .map_err(|e| Error::invalid(format!("broken OBJ file: {e}")))?;
    let mut out = Triangles {
        normals: Some(Vec::new()),
        ..Triangles::default()
    };
    for model in models {
        append(&mut out, &model.mesh)?;
    }
    Ok(out)
}

fn append(out: &mut Triangles, mesh: &tobj::Mesh) -> Result<(), Error> {
    let first = u32::try_from(out.positions.len())
        .map_err(|_| Error::invalid("expected fewer than 2^32 vertices, found more"))?;
    out.positions.extend(vectors(&mesh.positions));
    // Normals are kept only if every model has them; the length check later does the rest.
    if let Some(normals) = &mut out.normals {
        normals.extend(vectors(&mesh.normals));
    }
    let (triples, rest) = mesh.indices.as_chunks::<3>();
    if !rest.is_empty() {
        return Err(Error::invalid(
            "broken OBJ file: a face with fewer than three corners",
        ));
    }
    for t in triples {
        let shifted = t.map(|i| i.checked_add(first));
        let [Some(a), Some(b), Some(c)] = shifted else {
            return Err(Error::invalid(
                "expected indices below 2^32, found a larger one",
            ));
        };
        out.triangles.push([a, b, c]);
    }
    Ok(())
}

fn vectors(flat: &[f32]) -> impl Iterator<Item = Vec3> {
    flat.as_chunks::<3>().0.iter().map(|v| Vec3::from_array(*v))
}
