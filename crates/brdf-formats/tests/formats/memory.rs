//! Full-size MERL files, read whole and in places without a second copy.

use crate::fixtures::merl_header;
use brdf_formats::{MerlFile, MerlReader, ReadAt};
use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A MERL file that is never in memory: a header, then zeros without end.
struct Endless {
    header: Vec<u8>,
    /// The longest read that was asked for.
    longest: AtomicUsize,
}

impl ReadAt for Endless {
    fn read_exact_at(&self, into: &mut [u8], at: u64) -> io::Result<()> {
        self.longest.fetch_max(into.len(), Ordering::Relaxed);
        into.fill(0);
        if at == 0 {
            let count = into.len().min(self.header.len());
            into[..count].copy_from_slice(&self.header[..count]);
        }
        Ok(())
    }
}

#[test]
fn a_file_of_any_size_is_asked_for_what_is_wanted_of_it() {
    let source = Endless {
        header: merl_header([90, 90, 360]),
        longest: AtomicUsize::new(0),
    };
    let reader = MerlReader::new(&source, 12 + 90 * 90 * 360 * 24).unwrap();
    let mut piece = vec![1.0; 8192];
    for first in (0..reader.cells() - 8192).step_by(8192) {
        reader.read(1, first, &mut piece).unwrap();
    }
    assert_eq!(piece, vec![0.0; 8192]);
    assert_eq!(source.longest.into_inner(), 1 << 16, "bytes at once");
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
