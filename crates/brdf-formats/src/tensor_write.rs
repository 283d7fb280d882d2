//! The tensor container the other way round: named arrays to bytes, for who makes up a file.

use crate::tensor::{Dtype, MAGIC};

/// A field to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TensorField<'a> {
    /// Its name, at most 65535 bytes.
    pub name: &'a str,
    /// The type of its elements.
    pub dtype: Dtype,
    /// Its shape, slowest axis first.
    pub shape: &'a [u64],
    /// Its elements, little-endian.
    pub data: Vec<u8>,
}

impl<'a> TensorField<'a> {
    /// A field of f32.
    #[must_use]
    pub fn floats(name: &'a str, shape: &'a [u64], data: &[f32]) -> Self {
        Self {
            name,
            dtype: Dtype::F32,
            shape,
            data: data.iter().flat_map(|v| v.to_le_bytes()).collect(),
        }
    }

    /// Bytes of its entry in the header.
    const fn head(&self) -> usize {
        13 + self.name.len() + 8 * self.shape.len()
    }
}

/// The bytes of a tensor file of version 1.0 that holds `fields` in this order: the header, then the data without gaps.
/// [`crate::TensorFile::from_bytes`] gives them back if every shape fits its data.
#[must_use]
#[expect(
    clippy::cast_possible_truncation,
    reason = "names and shapes are written in sources, not read from files"
)]
pub fn write_tensor(fields: &[TensorField<'_>]) -> Vec<u8> {
    let mut out = MAGIC.to_vec();
    out.extend([1, 0]);
    out.extend((fields.len() as u32).to_le_bytes());
    let heads: usize = fields.iter().map(TensorField::head).sum();
    let mut offset = out.len() + heads;
    for field in fields {
        out.extend((field.name.len() as u16).to_le_bytes());
        out.extend(field.name.bytes());
        out.extend((field.shape.len() as u16).to_le_bytes());
        out.push(field.dtype.code());
        out.extend((offset as u64).to_le_bytes());
        out.extend(field.shape.iter().flat_map(|n| n.to_le_bytes()));
        offset += field.data.len();
    }
    for field in fields {
        out.extend(&field.data);
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{TensorField, write_tensor};
    use crate::{Dtype, TensorFile};

    #[test]
    fn comes_back_as_it_was() {
        let fields = [
            TensorField::floats("a", &[2, 3], &[1.0, 2.0, -0.0, 4.0, 5.0, 6.0]),
            TensorField {
                name: "empty",
                dtype: Dtype::F64,
                shape: &[0],
                data: vec![],
            },
            TensorField {
                name: "flag",
                dtype: Dtype::U8,
                shape: &[1],
                data: vec![7],
            },
        ];
        let file = TensorFile::from_bytes(write_tensor(&fields)).unwrap();
        assert_eq!(file.fields().len(), fields.len());
        for (read, written) in file.fields().zip(&fields) {
            let shape: Vec<u64> = read.shape().iter().map(|n| *n as u64).collect();
            assert_eq!(
                (read.name(), read.dtype(), &shape[..], read.bytes()),
                (
                    written.name,
                    written.dtype,
                    written.shape,
                    &written.data[..]
                )
            );
        }
    }
}
