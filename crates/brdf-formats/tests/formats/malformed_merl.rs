//! Broken MERL files, each with the one line that says what is wrong.

use crate::fixtures::{merl, merl_header};
use crate::malformed::expect;
use brdf_formats::{Error, ErrorKind, MerlFile, MerlReader, Place, ReadAt};
use std::io;

#[test]
fn broken_merl_files_are_refused_with_one_clear_line() {
    let sized = |dims| [merl_header(dims), vec![0; 24]].concat();
    let cases: [(Vec<u8>, &str); 10] = [
        (
            vec![],
            "file: dims: expected a header of 12 bytes, found 0 bytes",
        ),
        (
            vec![90; 11],
            "file: dims: expected a header of 12 bytes, found 11 bytes",
        ),
        (
            sized([0, 90, 180]),
            "byte 0: theta_h count: expected a positive number, found 0",
        ),
        (
            sized([90, -1, 180]),
            "byte 4: theta_d count: expected a positive number, found -1",
        ),
        (
            sized([90, 90, i32::MIN]),
            "byte 8: phi_d count: expected a positive number, found -2147483648",
        ),
        (
            merl_header([90, 90, 180]),
            "file: size: expected 34992012 bytes for dims 90 x 90 x 180, found 12 bytes",
        ),
        (
            merl()[..587].to_vec(),
            "file: size: expected 588 bytes for dims 2 x 3 x 4, found 587 bytes",
        ),
        (
            [merl(), vec![0]].concat(),
            "file: size: expected 588 bytes for dims 2 x 3 x 4, found 589 bytes",
        ),
        (
            sized([i32::MAX, 1, 1]),
            "file: size: expected 51539607540 bytes for dims 2147483647 x 1 x 1, found 36 bytes",
        ),
        (
            sized([i32::MAX; 3]),
            "byte 0: dims: expected the dims of a file of 36 bytes, \
             found 2147483647 x 2147483647 x 2147483647",
        ),
    ];
    for (bytes, message) in cases {
        expect(MerlFile::from_bytes(bytes.clone()), message);
        expect(MerlReader::new(&bytes[..], bytes.len() as u64), message);
    }
}

/// Reads a whole file in pieces of at most 72 values and counts these.
fn drain(source: &(impl ReadAt + ?Sized), total: u64) -> Result<usize, Error> {
    let reader = MerlReader::new(source, total)?;
    let mut count = 0;
    for channel in 0..3 {
        for first in (0..reader.cells()).step_by(72) {
            let mut piece = vec![0.0; 72.min(reader.cells() - first) as usize];
            reader.read(channel, first, &mut piece)?;
            count += piece.len();
        }
    }
    reader.check_end()?;
    Ok(count)
}

/// A source that fails after its bytes, with a message of its own.
struct Broken<'a>(&'a [u8]);

impl ReadAt for Broken<'_> {
    fn read_exact_at(&self, into: &mut [u8], at: u64) -> io::Result<()> {
        let read = self.0.read_exact_at(into, at);
        read.map_err(|_| io::Error::other("the disk is gone"))
    }
}

#[test]
fn files_that_do_not_keep_their_length_are_refused() {
    let bytes = merl();
    assert_eq!(drain(&bytes[..], 588).unwrap(), 72);
    let short = "byte 396: values: expected 588 bytes in all, found the end of the file";
    expect(drain(&bytes[..500], 588), short);
    let short = "byte 0: dims: expected 588 bytes in all, found the end of the file";
    expect(drain(&bytes[..11], 588), short);
    let long = [bytes.clone(), vec![1]].concat();
    let message = "byte 588: end: expected the end of the file, found more bytes";
    expect(drain(&long[..], 588), message);
    // Under a length that fits the header, nothing is allocated that the source does not deliver.
    let lying = merl_header([i32::MAX, 1, 1]);
    let message = "byte 12: values: expected 51539607540 bytes in all, found the end of the file";
    expect(drain(&lying[..], 51539607540), message);
}

#[test]
fn a_failing_source_is_an_io_error_with_its_cause() {
    let bytes = merl();
    for (source, at) in [(&bytes[..0], 0), (&bytes[..12], 12), (&bytes[..], 588)] {
        let error = drain(&Broken(source), 588).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Io);
        assert_eq!(error.place(), Place::Byte(at));
        assert!(
            error.to_string().ends_with("found the disk is gone"),
            "{error}"
        );
        assert!(std::error::Error::source(&error).is_some(), "no cause");
    }
}

#[test]
fn cells_that_are_not_there_are_refused() {
    let bytes = merl();
    let reader = MerlReader::new(&bytes[..], 588).unwrap();
    for (channel, first, count) in [
        (3, 0, 1),
        (0, 24, 1),
        (2, 20, 5),
        (0, u64::MAX, 2),
        (1, 0, 25),
    ] {
        let error = reader.read(channel, first, &mut vec![0.0; count]);
        let message = format!(
            "file: values: expected cells of 3 planes of 24, found {count} from number {first} of plane {channel}"
        );
        expect(error, &message);
    }
}
