//! KAIST's polarimetric measurements: recognised, so that the error can say what they are.

use crate::error::{Error, Place};
use crate::file::File;
use crate::format::Format;
use crate::tensor::{self, TensorFile};

/// The registry item.
pub(crate) const FORMAT: Format = Format {
    name: "kaist",
    title: "KAIST polarimetric tensor file (recognised, not read)",
    magic: "`tensor_file` and a NUL, with a field named `M`",
    extensions: &["pbsdf"],
    detect,
    read,
    writer: None,
    docs: "docs/formats/kaist.md",
};

fn detect(prefix: &[u8], total_len: u64) -> bool {
    prefix.starts_with(tensor::MAGIC)
        && tensor::parse_entries(prefix, total_len).is_ok_and(|e| e.iter().any(|e| e.name == "M"))
}

fn read(bytes: Vec<u8>) -> Result<File, Error> {
    let tensors = TensorFile::from_bytes(bytes)?;
    let shape = tensors.field("M").map(|t| t.shape().to_vec());
    let found = format!("Mueller matrices of shape {:?}", shape.unwrap_or_default());
    Err(Error::unsupported(
        Place::File,
        "M",
        "unpolarised values",
        found,
    ))
}
