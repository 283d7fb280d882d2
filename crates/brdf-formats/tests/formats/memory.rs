//! Full-size MERL files, read and streamed without a second copy.

use crate::fixtures::merl_header;
use brdf_formats::{MerlFile, MerlStream};
use std::io::{self, Read};

/// A MERL file that is never in memory: a header, then as many zero bytes as asked for.
struct Endless {
    header: io::Cursor<Vec<u8>>,
    left: u64,
    /// The longest read that was asked for.
    longest: usize,
}

impl Read for Endless {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        self.longest = self.longest.max(out.len());
        match self.header.read(out)? {
            0 => {
                let count = self.left.min(out.len() as u64) as usize;
                out[..count].fill(0);
                self.left -= count as u64;
                Ok(count)
            }
            count => Ok(count),
        }
    }
}

#[test]
fn a_stream_of_any_size_asks_for_small_pieces() {
    let values = 90 * 90 * 360 * 3;
    let mut source = Endless {
        header: io::Cursor::new(merl_header([90, 90, 360])),
        left: values * 8,
        longest: 0,
    };
    let mut stream = MerlStream::new(&mut source, 12 + values * 8).unwrap();
    let mut count = 0;
    while let Some(chunk) = stream.next_chunk().unwrap() {
        count += chunk.len() as u64;
    }
    assert_eq!(count, values);
    assert!(
        source.longest <= 1 << 16,
        "asked for {} bytes at once",
        source.longest
    );
}

#[test]
fn a_full_file_is_taken_over_not_copied() {
    let mut bytes = merl_header([90, 90, 180]);
    bytes.resize(34_992_012, 0);
    let address = bytes.as_ptr();
    let file = MerlFile::from_bytes(bytes).unwrap();
    assert_eq!(file.cells(), 1_458_000);
    assert_eq!(file.value(2, 1_457_999), 0.0);
    let bytes = file.into_bytes();
    assert_eq!(bytes.as_ptr(), address, "the file was copied");
}
