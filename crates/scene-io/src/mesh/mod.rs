//! Triangle meshes: OBJ and PLY files, and surfaces of revolution.

mod lathe;
mod obj;
mod ply;
mod triangles;

pub use lathe::{lathe, uv_sphere};
pub use triangles::{MAX_TRIANGLES, MAX_VERTICES, Triangles};

use crate::error::{Error, ErrorKind};
use crate::load;
use std::path::Path;

/// Largest mesh file, bytes: 2 GiB.
const MAX_BYTES: u64 = 2 << 30;

/// Reads an OBJ or PLY file, told apart by content. Materials and groups of the file are ignored.
///
/// # Errors
/// Unreadable or broken files, indices beyond the vertices, coordinates that are not finite, counts beyond
/// [`MAX_VERTICES`] and [`MAX_TRIANGLES`], no triangle left.
pub fn read_mesh(path: &Path) -> Result<Triangles, Error> {
    let bytes = load::bytes(path, MAX_BYTES)?;
    from_bytes(&bytes).map_err(|e| e.in_file(path))
}

/// [`read_mesh`] from memory.
///
/// # Errors
/// As [`read_mesh`].
pub fn from_bytes(bytes: &[u8]) -> Result<Triangles, Error> {
    let raw = if bytes.starts_with(b"ply") {
        ply::read(bytes)?
    } else if looks_like_obj(bytes) {
        obj::read(bytes)?
    } else {
        let message = "expected a mesh in OBJ or PLY, found neither";
        return Err(Error::new(ErrorKind::Unsupported, message));
    };
    raw.checked()
}

/// OBJ has no magic: some line near the top must begin with one of its words.
fn looks_like_obj(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(1 << 16)];
    let words: [&[u8]; 4] = [b"v ", b"v\t", b"vn ", b"f "];
    !head.contains(&0)
        && head
            .split(|b| *b == b'\n')
            .any(|line| words.iter().any(|w| line.trim_ascii_start().starts_with(w)))
}
