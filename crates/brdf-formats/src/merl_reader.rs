//! MERL files read in places: many threads make one table, and nothing but the table is held.

use crate::error::{Error, Place};
use crate::merl::{self, HEADER};
use std::io;

/// Bytes that any number of threads read at once, anywhere.
pub trait ReadAt: Sync {
    /// Fills `into` with the bytes from number `at` on.
    ///
    /// # Errors
    /// [`io::ErrorKind::UnexpectedEof`] if they end before; whatever else the source says.
    fn read_exact_at(&self, into: &mut [u8], at: u64) -> io::Result<()>;
}

impl ReadAt for [u8] {
    fn read_exact_at(&self, into: &mut [u8], at: u64) -> io::Result<()> {
        let from = usize::try_from(at).ok().and_then(|at| self.get(at..));
        let from = from.and_then(|rest| rest.get(..into.len()));
        into.copy_from_slice(from.ok_or(io::ErrorKind::UnexpectedEof)?);
        Ok(())
    }
}

/// A MERL file being read: dims first, then values of a plane (R, G, B) from any cell on.
///
/// ```
/// # use brdf_formats::{MerlFile, MerlReader};
/// # let bytes = MerlFile::from_fn([1, 1, 2], |channel, cell| (2 * channel + cell) as f64)?.to_bytes();
/// let reader = MerlReader::new(&bytes[..], bytes.len() as u64)?;
/// assert_eq!(reader.dims(), [1, 1, 2]);
/// let mut values = [0.0; 2];
/// reader.read(2, 0, &mut values)?;
/// assert_eq!(values, [4.0, 5.0]);
/// reader.check_end()?;
/// # Ok::<(), brdf_formats::Error>(())
/// ```
#[derive(Debug)]
pub struct MerlReader<'a, S: ?Sized> {
    source: &'a S,
    dims: [u32; 3],
    total_len: u64,
}

impl<'a, S: ReadAt + ?Sized> MerlReader<'a, S> {
    /// Reads the header of a file of `total_len` bytes.
    ///
    /// # Errors
    /// If the header is cut off, a dimension is not positive, the length does not follow from them, or
    /// the source fails.
    pub fn new(source: &'a S, total_len: u64) -> Result<Self, Error> {
        let mut header = [0; HEADER];
        let header = &mut header[..HEADER.min(usize::try_from(total_len).unwrap_or(HEADER))];
        source
            .read_exact_at(header, 0)
            .map_err(|e| failed(Place::Byte(0), "dims", total_len, e))?;
        Ok(Self {
            source,
            dims: merl::parse_header(header, total_len)?,
            total_len,
        })
    }

    /// Cell counts in theta_h, theta_d, phi_d; all positive.
    #[must_use]
    pub fn dims(&self) -> [u32; 3] {
        self.dims
    }

    /// Cells in one plane: the product of the dims.
    #[must_use]
    pub fn cells(&self) -> u64 {
        (self.total_len - HEADER as u64) / 24
    }

    /// The unscaled values of plane `channel` from cell `first` on, as many as `into` takes.
    ///
    /// # Errors
    /// If there are not so many, or the source fails or ends early.
    pub fn read(&self, channel: usize, first: u64, into: &mut [f64]) -> Result<(), Error> {
        let (cells, count) = (self.cells(), into.len() as u64);
        if channel > 2 || count > cells || first > cells - count {
            return Err(Error::invalid(
                Place::File,
                "values",
                format_args!("cells of 3 planes of {cells}"),
                format_args!("{count} from number {first} of plane {channel}"),
            ));
        }
        let at = HEADER as u64 + 8 * (channel as u64 * cells + first);
        self.source
            .read_exact_at(bytemuck::cast_slice_mut(into), at)
            .map_err(|e| failed(Place::Byte(at), "values", self.total_len, e))?;
        for value in into {
            *value = f64::from_bits(u64::from_le(value.to_bits()));
        }
        Ok(())
    }

    /// Whether the source ends where the file does.
    ///
    /// # Errors
    /// If it has more bytes, or fails.
    pub fn check_end(&self) -> Result<(), Error> {
        let place = Place::Byte(self.total_len);
        match self.source.read_exact_at(&mut [0], self.total_len) {
            Ok(()) => Err(Error::invalid(
                place,
                "end",
                "the end of the file",
                "more bytes",
            )),
            Err(e) if e.kind() == io::ErrorKind::UnexpectedEof => Ok(()),
            Err(e) => Err(Error::io(place, "end", e)),
        }
    }
}

fn failed(place: Place, field: &str, total_len: u64, e: io::Error) -> Error {
    match e.kind() {
        io::ErrorKind::UnexpectedEof => Error::invalid(
            place,
            field,
            format_args!("{total_len} bytes in all"),
            "the end of the file",
        ),
        _ => Error::io(place, field, e),
    }
}
