//! MERL decoding in small pieces, for tables that are built while the file is read.

use crate::error::{Error, Place};
use crate::merl::{self, HEADER};
use std::io::{self, Read};

/// Values handed out at a time: 64 KiB, which stays in the cache.
const CHUNK: usize = 8192;

/// A MERL file being read: dims first, then its values in file order (plane R, then G, then B).
///
/// Holds one chunk of 64 KiB, whatever the dims claim.
///
/// ```
/// # use brdf_formats::{MerlFile, MerlStream};
/// # let bytes = MerlFile::from_fn([1, 1, 2], |channel, cell| (2 * channel + cell) as f64)?.to_bytes();
/// let mut stream = MerlStream::new(&bytes[..], bytes.len() as u64)?;
/// let mut values = Vec::new();
/// while let Some(chunk) = stream.next_chunk()? {
///     values.extend(chunk.iter().map(|&v| v as f32));
/// }
/// assert_eq!(stream.dims(), [1, 1, 2]);
/// assert_eq!(values, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0]);
/// # Ok::<(), brdf_formats::Error>(())
/// ```
#[derive(Debug)]
pub struct MerlStream<R> {
    source: R,
    dims: [u32; 3],
    /// Values not yet handed out.
    left: u64,
    total_len: u64,
    chunk: Vec<f64>,
}

impl<R: Read> MerlStream<R> {
    /// Reads the header of a file of `total_len` bytes.
    ///
    /// # Errors
    /// If the header is cut off, a dimension is not positive, the length does not follow from them, or
    /// the source fails.
    pub fn new(mut source: R, total_len: u64) -> Result<Self, Error> {
        let mut header = Vec::with_capacity(HEADER);
        source
            .by_ref()
            .take(HEADER as u64)
            .read_to_end(&mut header)
            .map_err(|e| Error::io(Place::Byte(0), "dims", e))?;
        let dims = merl::parse_header(&header, total_len)?;
        let left = (total_len - HEADER as u64) / 8;
        Ok(Self {
            source,
            dims,
            left,
            total_len,
            chunk: Vec::new(),
        })
    }

    /// Cell counts in theta_h, theta_d, phi_d; all positive.
    #[must_use]
    pub fn dims(&self) -> [u32; 3] {
        self.dims
    }

    /// Cells in one plane: the product of the dims. A third of the values the stream hands out.
    #[must_use]
    pub fn cells(&self) -> u64 {
        (self.total_len - HEADER as u64) / 24
    }

    /// The next values (at most 8192, at least one), or `None` after the last.
    ///
    /// # Errors
    /// If the source fails, ends early, or has bytes beyond the announced length.
    pub fn next_chunk(&mut self) -> Result<Option<&[f64]>, Error> {
        let at = self.total_len - 8 * self.left;
        if self.left == 0 {
            return self.check_end().map(|()| None);
        }
        let count = usize::try_from(self.left).map_or(CHUNK, |left| left.min(CHUNK));
        self.chunk.resize(count, 0.0);
        self.source
            .read_exact(bytemuck::cast_slice_mut(&mut self.chunk))
            .map_err(|e| match e.kind() {
                io::ErrorKind::UnexpectedEof => Error::invalid(
                    Place::Byte(at),
                    "values",
                    format_args!("{} bytes in all", self.total_len),
                    "the end of the file",
                ),
                _ => Error::io(Place::Byte(at), "values", e),
            })?;
        for value in &mut self.chunk {
            *value = f64::from_bits(u64::from_le(value.to_bits()));
        }
        self.left -= count as u64;
        Ok(Some(&self.chunk))
    }

    fn check_end(&mut self) -> Result<(), Error> {
        let place = Place::Byte(self.total_len);
        let mut more = Vec::new();
        self.source
            .by_ref()
            .take(1)
            .read_to_end(&mut more)
            .map_err(|e| Error::io(place, "end", e))?;
        if more.is_empty() {
            return Ok(());
        }
        Err(Error::invalid(
            place,
            "end",
            "the end of the file",
            "more bytes",
        ))
    }
}
