//! The tensor container: named arrays with dtype and shape, as RGL and KAIST publish them.

use crate::error::{Error, Place, quote};
use std::collections::HashSet;

/// First bytes of every tensor file.
pub(crate) const MAGIC: &[u8] = b"tensor_file\0";

/// A tensor file, kept as its bytes and an index of its fields.
#[derive(Clone, PartialEq, Eq)]
pub struct TensorFile {
    bytes: Vec<u8>,
    entries: Vec<Entry>,
}

impl std::fmt::Debug for TensorFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(&self.entries).finish()
    }
}

/// Element type of a tensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Dtype {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    U64,
    I64,
    F16,
    F32,
    F64,
}

impl Dtype {
    /// Bytes of one element.
    #[must_use]
    pub fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 | Self::F16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::U64 | Self::I64 | Self::F64 => 8,
        }
    }

    /// Short name: `f32`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::U8 => "u8",
            Self::I8 => "i8",
            Self::U16 => "u16",
            Self::I16 => "i16",
            Self::U32 => "u32",
            Self::I32 => "i32",
            Self::U64 => "u64",
            Self::I64 => "i64",
            Self::F16 => "f16",
            Self::F32 => "f32",
            Self::F64 => "f64",
        }
    }

    /// By code in the file, from 1 on.
    const CODES: [Self; 11] = [
        Self::U8,
        Self::I8,
        Self::U16,
        Self::I16,
        Self::U32,
        Self::I32,
        Self::U64,
        Self::I64,
        Self::F16,
        Self::F32,
        Self::F64,
    ];

    fn from_code(code: u8) -> Option<Self> {
        let at = usize::from(code.checked_sub(1)?);
        Self::CODES.get(at).copied()
    }

    /// What stands for it in a file.
    pub(crate) fn code(self) -> u8 {
        let mut codes = (1..).zip(Self::CODES);
        codes.find(|(_, d)| *d == self).map_or(0, |(code, _)| code)
    }
}

/// A field's place in the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Entry {
    pub(crate) name: String,
    dtype: Dtype,
    shape: Vec<usize>,
    offset: usize,
    /// Bytes of data; `offset + len` lies within the file.
    len: usize,
    /// Where the entry itself starts, for errors.
    place: Place,
}

/// A field of a tensor file.
#[derive(Clone, Copy, Debug)]
pub struct Tensor<'a> {
    entry: &'a Entry,
    bytes: &'a [u8],
}

impl TensorFile {
    /// Reads a file; takes the buffer over instead of copying it.
    ///
    /// # Errors
    /// If the header is broken or cut off, a dtype is unknown, a name comes twice, or a field's data does
    /// not lie within the file. A container version other than 1 is unsupported.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, Error> {
        let entries = parse_entries(&bytes, bytes.len() as u64)?;
        Ok(Self { bytes, entries })
    }

    /// The fields in the file's order.
    pub fn fields(&self) -> impl ExactSizeIterator<Item = Tensor<'_>> {
        self.entries.iter().map(|entry| self.tensor(entry))
    }

    /// The field of this name.
    #[must_use]
    pub fn field(&self, name: &str) -> Option<Tensor<'_>> {
        self.fields().find(|t| t.name() == name)
    }

    /// The whole file.
    #[must_use]
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    fn tensor<'a>(&'a self, entry: &'a Entry) -> Tensor<'a> {
        let bytes = &self.bytes[entry.offset..][..entry.len];
        Tensor { entry, bytes }
    }
}

impl<'a> Tensor<'a> {
    /// The field's name.
    #[must_use]
    pub fn name(&self) -> &'a str {
        &self.entry.name
    }

    /// The type of its elements.
    #[must_use]
    pub fn dtype(&self) -> Dtype {
        self.entry.dtype
    }

    /// Its shape, slowest axis first. An axis may be empty.
    #[must_use]
    pub fn shape(&self) -> &'a [usize] {
        &self.entry.shape
    }

    /// How many elements it has: the product of the shape.
    #[must_use]
    pub fn element_count(&self) -> usize {
        self.bytes.len() / self.dtype().size()
    }

    /// Its data, little-endian, as it stands in the file.
    #[must_use]
    pub fn bytes(&self) -> &'a [u8] {
        self.bytes
    }

    /// Its elements, if they are f32.
    #[must_use]
    pub fn to_f32(&self) -> Option<Vec<f32>> {
        (self.dtype() == Dtype::F32).then(|| {
            let (fours, _) = self.bytes.as_chunks::<4>();
            fours.iter().map(|four| f32::from_le_bytes(*four)).collect()
        })
    }

    /// Where its entry in the header starts.
    pub(crate) fn place(&self) -> Place {
        self.entry.place
    }
}

/// The index of a file of `total_len` bytes, of which `prefix` holds at least the header.
pub(crate) fn parse_entries(prefix: &[u8], total_len: u64) -> Result<Vec<Entry>, Error> {
    let mut head = Head {
        bytes: prefix,
        offset: 0,
    };
    if head.take(MAGIC.len(), "magic")? != MAGIC {
        let found = quote(&prefix[..MAGIC.len()]);
        return Err(Error::invalid(
            Place::Byte(0),
            "magic",
            "`tensor_file\\0`",
            found,
        ));
    }
    let version = head.place();
    let [major, minor] = head.array("version")?;
    if major != 1 {
        let found = format!("{major}.{minor}");
        return Err(Error::unsupported(version, "version", "1.x", found));
    }
    let count = u32::from_le_bytes(head.array("field count")?);
    let (mut entries, mut seen) = (Vec::new(), HashSet::new());
    for _ in 0..count {
        let entry = head.entry(total_len)?;
        if !seen.insert(entry.name.clone()) {
            let found = quote(entry.name.as_bytes());
            return Err(Error::invalid(entry.place, "name", "each name once", found));
        }
        entries.push(entry);
    }
    Ok(entries)
}

/// The header while it is being read.
struct Head<'a> {
    bytes: &'a [u8],
    offset: usize,
}

impl<'a> Head<'a> {
    fn place(&self) -> Place {
        Place::Byte(self.offset as u64)
    }

    fn take(&mut self, count: usize, what: &str) -> Result<&'a [u8], Error> {
        let rest = &self.bytes[self.offset..];
        let Some(taken) = rest.get(..count) else {
            let expected = format!("{count} bytes");
            let found = format!("{} before the end of the file", rest.len());
            return Err(Error::invalid(self.place(), what, expected, found));
        };
        self.offset += count;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Error> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N, what)?);
        Ok(array)
    }

    fn entry(&mut self, total_len: u64) -> Result<Entry, Error> {
        let place = self.place();
        let length = u16::from_le_bytes(self.array("name length")?);
        let raw = self.take(length.into(), "name")?;
        let Ok(name) = std::str::from_utf8(raw).map(String::from) else {
            return Err(Error::invalid(place, "name", "UTF-8", quote(raw)));
        };
        let dims = u16::from_le_bytes(self.array("number of axes")?);
        let [code] = self.array("dtype")?;
        let Some(dtype) = Dtype::from_code(code) else {
            let field = format!("dtype of {}", quote(raw));
            return Err(Error::invalid(place, field, "a code from 1 to 11", code));
        };
        let offset = u64::from_le_bytes(self.array("offset")?);
        let (axes, _) = self.take(usize::from(dims) * 8, "shape")?.as_chunks::<8>();
        let axes: Vec<u64> = axes.iter().map(|a| u64::from_le_bytes(*a)).collect();
        let (shape, len) = checked_shape(&axes, dtype, offset, total_len).ok_or_else(|| {
            let shape = format!("shape {axes:?} of {} at byte {offset}", dtype.name());
            let field = format!("data of {}", quote(raw));
            let expected = format!("data within the file's {total_len} bytes");
            Error::invalid(place, field, expected, shape)
        })?;
        Ok(Entry {
            name,
            dtype,
            shape,
            offset: usize::try_from(offset).unwrap_or(0),
            len,
            place,
        })
    }
}

/// Shape and byte count of data that lies within the file.
fn checked_shape(
    axes: &[u64],
    dtype: Dtype,
    offset: u64,
    total_len: u64,
) -> Option<(Vec<usize>, usize)> {
    // An empty axis makes the product 0 whatever the others claim, so bound those on their own.
    let mut shape = Vec::with_capacity(axes.len());
    for &axis in axes {
        shape.push(usize::try_from(axis).ok().filter(|_| axis <= total_len)?);
    }
    let mut len = dtype.size() as u64;
    if axes.contains(&0) {
        len = 0;
    }
    for &axis in axes {
        len = len.checked_mul(axis)?;
    }
    let fits = offset.checked_add(len)? <= total_len;
    Some((shape, usize::try_from(len).ok()?)).filter(|_| fits)
}
