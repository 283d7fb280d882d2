//! The MERL isotropic `.binary` layout: three cell counts, then three planes of f64.

use crate::error::{Error, Place};
use crate::file::File;
use crate::format::Format;
use std::io::{self, Write};

/// Factor per plane (R, G, B) from a stored value to f_r in 1/sr. \[Matusik2003\]
///
/// The reader does not apply it.
pub const MERL_SCALE: [f64; 3] = [1.0 / 1500.0, 1.15 / 1500.0, 1.66 / 1500.0];

/// Bytes before the first plane: three i32.
pub(crate) const HEADER: usize = 12;

/// A MERL file: dims (theta_h, theta_d, phi_d) and three planes R, G, B of unscaled f64.
///
/// The bytes of the file are kept as they came and decoded on access, so there is never a second copy
/// and even the payload of a NaN survives. Negative values mark cells without measurement; see
/// `docs/formats/merl.md` for the cell layout.
#[derive(Clone, PartialEq, Eq)]
pub struct MerlFile {
    dims: [u32; 3],
    /// The whole file, header included: `HEADER + 24 * cells` bytes.
    bytes: Vec<u8>,
}

impl std::fmt::Debug for MerlFile {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut show = f.debug_struct("MerlFile");
        show.field("dims", &self.dims).finish_non_exhaustive()
    }
}

impl MerlFile {
    /// Reads a file; takes the buffer over instead of copying it.
    ///
    /// # Errors
    /// If the header is cut off, a dimension is not positive, or the size does not follow from them.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, Error> {
        let dims = parse_header(&bytes, bytes.len() as u64)?;
        Ok(Self { dims, bytes })
    }

    /// A file of the given dims from the unscaled value of each `(channel, cell)`, asked in file order.
    ///
    /// # Errors
    /// If a dimension is zero or above `i32::MAX`, or the file would not fit into memory.
    pub fn from_fn(
        dims: [u32; 3],
        mut value: impl FnMut(usize, usize) -> f64,
    ) -> Result<Self, Error> {
        let header: Vec<u8> = dims.iter().flat_map(|d| d.to_le_bytes()).collect();
        let len = expected_len(check_dims(&header)?).and_then(|n| usize::try_from(n).ok());
        let too_large = || Error::invalid(Place::File, "dims", "a size that fits", show(dims));
        let len = len
            .filter(|&n| isize::try_from(n).is_ok())
            .ok_or_else(too_large)?;
        let mut bytes = Vec::new();
        bytes.try_reserve_exact(len).map_err(|_| too_large())?;
        bytes.extend(header);
        let cells = (len - HEADER) / 24;
        for channel in 0..3 {
            for cell in 0..cells {
                bytes.extend(value(channel, cell).to_le_bytes());
            }
        }
        Ok(Self { dims, bytes })
    }

    /// Cell counts in theta_h, theta_d, phi_d; all positive.
    #[must_use]
    pub fn dims(&self) -> [u32; 3] {
        self.dims
    }

    /// Cells in one plane: the product of the dims.
    #[must_use]
    pub fn cells(&self) -> usize {
        (self.bytes.len() - HEADER) / 24
    }

    /// The unscaled value of a cell; `cell = phi_d + n_phi_d * (theta_d + n_theta_d * theta_h)`.
    ///
    /// # Panics
    /// If `channel > 2` or `cell` is not below [`MerlFile::cells`].
    #[must_use]
    pub fn value(&self, channel: usize, cell: usize) -> f64 {
        assert!(cell < self.cells(), "cell {cell} of {}", self.cells());
        let at = HEADER + 8 * (channel * self.cells() + cell);
        decode(&self.bytes[at..at + 8])
    }

    /// The unscaled values of one channel in cell order, at memory speed.
    ///
    /// # Panics
    /// If `channel > 2`.
    pub fn plane(&self, channel: usize) -> impl ExactSizeIterator<Item = f64> + '_ {
        let size = 8 * self.cells();
        let plane = &self.bytes[HEADER + channel * size..][..size];
        plane.chunks_exact(8).map(decode)
    }

    /// The file's bytes.
    #[must_use]
    pub fn as_bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// A copy of the file's bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        self.bytes.clone()
    }

    /// The file's bytes, handed back without a copy.
    #[must_use]
    pub fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    /// Writes the file's bytes.
    ///
    /// # Errors
    /// Whatever the writer returns.
    pub fn write(&self, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
        out.write_all(&self.bytes)
    }
}

/// The registry item.
pub(crate) const FORMAT: Format = Format {
    name: "merl",
    title: "MERL isotropic binary",
    magic: "three i32 cell counts from which the file's length follows, or 90, 90, 180 or 360",
    extensions: &["binary"],
    detect,
    read,
    writer: Some(File::write_to),
    docs: "docs/formats/merl.md",
};

/// The size follows from the first 12 bytes, or they are the usual dims.
fn detect(prefix: &[u8], total_len: u64) -> bool {
    check_dims(prefix).is_ok_and(|dims| {
        expected_len(dims) == Some(total_len) || matches!(dims, [90, 90, 180 | 360])
    })
}

fn read(bytes: Vec<u8>) -> Result<File, Error> {
    MerlFile::from_bytes(bytes).map(File::Merl)
}

/// The dims in the first bytes of a file of `total_len` bytes, checked against that length.
pub(crate) fn parse_header(prefix: &[u8], total_len: u64) -> Result<[u32; 3], Error> {
    let dims = check_dims(prefix)?;
    match expected_len(dims) {
        Some(len) if len == total_len => Ok(dims),
        Some(len) => Err(Error::invalid(
            Place::File,
            "size",
            format_args!("{len} bytes for dims {}", show(dims)),
            format_args!("{total_len} bytes"),
        )),
        None => Err(Error::invalid(
            Place::Byte(0),
            "dims",
            format_args!("the dims of a file of {total_len} bytes"),
            show(dims),
        )),
    }
}

fn check_dims(prefix: &[u8]) -> Result<[u32; 3], Error> {
    let Some(header) = prefix.first_chunk::<HEADER>() else {
        let (want, found) = ("a header of 12 bytes", format!("{} bytes", prefix.len()));
        return Err(Error::invalid(Place::File, "dims", want, found));
    };
    let mut dims = [0; 3];
    for (i, four) in header.as_chunks::<4>().0.iter().enumerate() {
        let count = i32::from_le_bytes(*four);
        dims[i] = u32::try_from(count)
            .ok()
            .filter(|&n| n > 0)
            .ok_or_else(|| {
                let name = ["theta_h", "theta_d", "phi_d"][i];
                let place = Place::Byte(4 * i as u64);
                Error::invalid(
                    place,
                    format_args!("{name} count"),
                    "a positive number",
                    count,
                )
            })?;
    }
    Ok(dims)
}

/// File size for these dims, `None` beyond u64.
fn expected_len(dims: [u32; 3]) -> Option<u64> {
    let cells = dims
        .iter()
        .try_fold(1_u64, |n, &d| n.checked_mul(d.into()))?;
    cells.checked_mul(24)?.checked_add(HEADER as u64)
}

fn show([a, b, c]: [u32; 3]) -> String {
    format!("{a} x {b} x {c}")
}

fn decode(eight: &[u8]) -> f64 {
    let mut bytes = [0; 8];
    bytes.copy_from_slice(eight);
    f64::from_le_bytes(bytes)
}
