//! Stanford PLY (text, little and big endian) through `ply-rs-bw`.

use super::triangles::{MAX_TRIANGLES, MAX_VERTICES, Triangles};
use crate::error::Error;
use glam::Vec3;
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Property, PropertyAccess, PropertyAccessResult};

/// One vertex or one face; whichever it is, the other's entries stay empty.
#[derive(Default)]
struct Element {
    position: Vec3,
    normal: Option<Vec3>,
    corners: Option<Vec<u32>>,
}

impl PropertyAccess for Element {
    fn new() -> Self {
        Self::default()
    }

    fn set_property(&mut self, name: &str, value: Property) -> PropertyAccessResult {
        match name {
            "x" | "y" | "z" => set(&mut self.position, &name[..1], &value),
            "nx" | "ny" | "nz" => {
                let normal = self.normal.get_or_insert(Vec3::ZERO);
                set(normal, &name[1..], &value)
            }
            "vertex_indices" | "vertex_index" => match indices(value) {
                Some(corners) => {
                    self.corners = Some(corners);
                    PropertyAccessResult::Set
                }
                None => PropertyAccessResult::UnsupportedType,
            },
            _ => PropertyAccessResult::Ignored,
        }
    }
}

fn set(v: &mut Vec3, axis: &str, value: &Property) -> PropertyAccessResult {
    let Some(number) = value.to_f32_lossy() else {
        return PropertyAccessResult::UnsupportedType;
    };
    match axis {
        "x" => v.x = number,
        "y" => v.y = number,
        _ => v.z = number,
    }
    PropertyAccessResult::Set
}

/// Negative indices become large ones, which the check of the whole mesh refuses by value.
fn indices(value: Property) -> Option<Vec<u32>> {
    let wrap = |i: i64| u32::try_from(i).unwrap_or(u32::MAX);
    Some(match value {
        Property::ListChar(v) => v.into_iter().map(|i| wrap(i.into())).collect(),
        Property::ListUChar(v) => v.into_iter().map(u32::from).collect(),
        Property::ListShort(v) => v.into_iter().map(|i| wrap(i.into())).collect(),
        Property::ListUShort(v) => v.into_iter().map(u32::from).collect(),
        Property::ListInt(v) => v.into_iter().map(|i| wrap(i.into())).collect(),
        Property::ListUInt(v) => v,
        _ => return None,
    })
}

pub(super) fn read(bytes: &[u8]) -> Result<Triangles, Error> {
    let broken = |e: ParseError| {
        let text = e.to_string();
        let words: Vec<&str> = text.split_whitespace().collect();
        let line: String = words.join(" ").chars().take(160).collect();
        Error::invalid(format!("broken PLY file: {line}"))
    };
    let mut reader = Reader::new(bytes);
    let parser = Parser::<Element>::new();
    let header = parser.read_header(&mut reader).map_err(broken)?;
    let mut out = Triangles::default();
    for (name, definition) in &header.elements {
        check_count(name, definition, bytes.len())?;
        let elements = parser
            .read_payload_for_element(&mut reader, definition, &header)
            .map_err(broken)?;
        match name.as_str() {
            "vertex" => {
                out.normals = elements.iter().map(|e| e.normal).collect();
                out.positions = elements.iter().map(|e| e.position).collect();
            }
            "face" => {
                for face in elements {
                    fan(&mut out, face.corners.as_deref().unwrap_or_default());
                }
            }
            _ => {}
        }
    }
    Ok(out)
}

/// A header may promise any count: every element takes at least a byte of the file.
fn check_count(name: &str, definition: &ElementDef, bytes: usize) -> Result<(), Error> {
    let bound = bytes.min(MAX_VERTICES.max(MAX_TRIANGLES));
    if definition.count > bound {
        return Err(Error::invalid(format!(
            "broken PLY file: expected at most {bound} of element \"{name}\", found {}",
            definition.count
        )));
    }
    if definition.properties.is_empty() && definition.count > 0 {
        return Err(Error::invalid(format!(
            "broken PLY file: expected properties of element \"{name}\", found none"
        )));
    }
    Ok(())
}

/// A polygon as triangles around its first corner; fewer than three corners have no area.
fn fan(out: &mut Triangles, corners: &[u32]) {
    match corners {
        [first, rest @ ..] if rest.len() >= 2 => {
            let pairs = rest.iter().zip(&rest[1..]);
            out.triangles.extend(pairs.map(|(b, c)| [*first, *b, *c]));
        }
        _ => out.dropped += 1,
    }
}
