//! What broken files have in common, and values that no file can hold.

use brdf_formats::{AstmFile, Channels, Error, ErrorKind, MerlFile, PbrtTextFile};

/// What a reader must say about `bytes`, to the letter.
pub(crate) fn expect<T>(result: Result<T, Error>, message: &str) {
    match result {
        Ok(_) => panic!("was read, but should say: {message}"),
        Err(error) => {
            assert_eq!(error.to_string(), message, "another error");
            let unsupported = message.ends_with("(not supported)");
            assert_eq!(
                error.kind() == ErrorKind::Unsupported,
                unsupported,
                "{message}"
            );
        }
    }
}

#[test]
fn values_that_no_file_can_hold_are_refused_when_a_file_is_made() {
    let row = vec![0.5, 0.0, 0.25, 0.0, 0.1, 0.2, 0.3];
    let with = |i: usize, v: f64| {
        let mut row = row.clone();
        row[i] = v;
        row
    };
    let rgb = |row| AstmFile::new(&[], Channels::Rgb, row);
    expect(
        rgb(vec![]),
        "file: rows: expected at least one row of 7 numbers, found 0 numbers",
    );
    expect(
        rgb(row[..6].to_vec()),
        "file: rows: expected at least one row of 7 numbers, found 6 numbers",
    );
    expect(
        rgb(with(5, f64::NAN)),
        "row 0: G: expected a finite number, found NaN",
    );
    let degrees = "row 0: theta_s: expected an angle in radians, at most 3.1416, \
                   found 45, which looks like degrees";
    expect(rgb(with(2, 45.0)), degrees);
    let fields = |key, value| AstmFile::new(&[(key, value)], Channels::Rgb, row.clone());
    let taken = "file: key: expected one word that is not NUM_POINTS or VARS, found `VARS`";
    expect(fields("VARS", "x"), taken);
    let two = "file: LAB_NAME: expected one line of text, found `a\\nb`";
    expect(fields("LAB_NAME", "a\nb"), two);
    let pbrt = |comment, nm| PbrtTextFile::new(&[comment], nm, row.clone());
    let bands = || vec![400.0, 500.0, 600.0];
    let none = "file: wavelengths: expected at least one wavelength, found none";
    expect(pbrt("", vec![]), none);
    expect(
        pbrt("a\nb", bands()),
        "file: comment: expected one line of text, found `a\\nb`",
    );
    let zero = "byte 4: theta_d count: expected a positive number, found 0";
    expect(MerlFile::from_fn([1, 0, 1], |_, _| 0.0), zero);
    let huge = "file: dims: expected a size that fits, found 2147483647 x 2147483647 x 1";
    expect(
        MerlFile::from_fn([i32::MAX as u32, i32::MAX as u32, 1], |_, _| 0.0),
        huge,
    );
}
