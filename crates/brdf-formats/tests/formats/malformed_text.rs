//! Broken ASTM and pbrt text files, each with the one line that says what is wrong.

use crate::fixtures::{ASTM, PBRT};
use crate::malformed::expect;
use brdf_formats::{AstmFile, Error, PbrtTextFile, read};

/// Each case: what to replace in the sound file, by what, and the error.
type Edits<'a> = [(&'a str, &'a str, &'a str)];

fn check_edits<T>(sound: &str, edits: &Edits<'_>, parse: impl Fn(&[u8]) -> Result<T, Error>) {
    assert!(parse(sound.as_bytes()).is_ok(), "the sound file is refused");
    for (old, new, message) in edits {
        assert!(sound.contains(old), "{old} is not in the sound file");
        let broken = sound.replacen(old, new, 1);
        expect(parse(broken.as_bytes()), message);
    }
}

#[test]
fn wrong_row_counts_are_refused_with_one_clear_line() {
    let edits = [
        (
            "NUM_POINTS 2",
            "NUM_POINTS 3",
            "line 4: NUM_POINTS: expected 3 rows, found 2 rows",
        ),
        (
            "NUM_POINTS 2",
            "NUM_POINTS 1",
            "line 4: NUM_POINTS: expected 1 row, found 2 rows",
        ),
        (
            "NUM_POINTS 2",
            "NUM_POINTS 18446744073709551615",
            "line 4: NUM_POINTS: expected 18446744073709551615 rows, found 2 rows",
        ),
        (
            "NUM_POINTS 2",
            "NUM_POINTS many",
            "line 4: NUM_POINTS: expected a row count, found `many`",
        ),
        (
            "NUM_POINTS 2",
            "NUM_POINTS -2",
            "line 4: NUM_POINTS: expected a row count, found `-2`",
        ),
        (
            "NUM_POINTS 2",
            "NUM_POINTS",
            "line 4: NUM_POINTS: expected a row count, found ``",
        ),
        (
            "NUM_POINTS 2",
            "NUM_POINTS 2\r\nNUM_POINTS 2",
            "line 5: NUM_POINTS: expected one line of this key, found a second",
        ),
    ];
    check_edits(ASTM, &edits, AstmFile::from_bytes);
    check_edits(ASTM, &edits, |bytes| read(bytes.to_vec()));
}

#[test]
fn broken_astm_column_lists_are_refused_with_one_clear_line() {
    const VARS: &str = "theta_i,phi_i,theta_s,phi_s,R,G,B";
    let edits = [
        (
            "VARS",
            "VARIABLES",
            "line 8: VARS: expected a VARS line that ends the header, found the end of the file",
        ),
        (
            "Paper",
            "Pa\0per",
            "line 3: header: expected text, found byte 0x00",
        ),
        (
            VARS,
            "R,G,B",
            "line 5: VARS: expected columns that start with theta_i,phi_i,theta_s,phi_s, \
             found `R,G,B` (not supported)",
        ),
        (
            VARS,
            "",
            "line 5: VARS: expected columns that start with theta_i,phi_i,theta_s,phi_s, \
             found `` (not supported)",
        ),
        (
            ",R,G,B",
            "",
            "line 5: VARS: expected R,G,B or X,Y,Z or <wavelength>nm value columns, found none",
        ),
        (
            "R,G,B",
            "Integrated,G,B",
            "line 5: VARS: expected R,G,B or X,Y,Z or <wavelength>nm value columns, \
             found `Integrated` (not supported)",
        ),
        (
            "R,G,B",
            "400nm,500nm,450nm",
            "line 5: VARS: expected ascending wavelengths in nm, found 450 after 500",
        ),
        (
            "R,G,B",
            "400nm,500nm,NaNnm",
            "line 5: VARS: expected ascending wavelengths in nm, found NaN after 500",
        ),
        (
            "R,G,B",
            "400nm,500nm,fivenm",
            "line 5: VARS: expected R,G,B or X,Y,Z or <wavelength>nm value columns, \
             found `fivenm` (not supported)",
        ),
    ];
    check_edits(ASTM, &edits, AstmFile::from_bytes);
    check_edits(ASTM, &edits, |bytes| read(bytes.to_vec()));
}

#[test]
fn broken_astm_rows_are_refused_with_one_clear_line() {
    let edits = [
        (
            "0.573513",
            "abc",
            "line 7: theta_s: expected a finite number, found `abc`",
        ),
        (
            "0.011364",
            "nan",
            "line 7: R: expected a finite number, found `nan`",
        ),
        (
            "0.000718",
            "-inf",
            "line 8: G: expected a finite number, found `-inf`",
        ),
        (
            "0.000718",
            "1e999",
            "line 8: G: expected a finite number, found `1e999`",
        ),
        (
            "0.000718",
            "",
            "line 8: G: expected a finite number, found ``",
        ),
        (
            ",0.002329",
            "",
            "line 7: row: expected 7 comma-separated numbers, found 6",
        ),
        (
            "0.002329",
            "0.002329,1",
            "line 7: row: expected 7 comma-separated numbers, found 8",
        ),
        (
            "0.002329",
            "0.002329,",
            "line 7: row: expected 7 comma-separated numbers, found 8",
        ),
        (
            "0.698132,0.000000,0.427512",
            "0.698132 0.000000 0.427512",
            "line 8: theta_i: expected a finite number, found `0.698132 0.000000 0.427512`",
        ),
        (
            "0.872665",
            "50.000000",
            "line 7: theta_i: expected an angle in radians, at most 3.1416, \
             found 50, which looks like degrees",
        ),
        (
            "-0.261799",
            "-15.0",
            "line 8: phi_s: expected an angle in radians, at most 6.2832, \
             found -15, which looks like degrees",
        ),
        (
            "0.573513",
            "\u{1}\u{1b}\u{7f}",
            "line 7: theta_s: expected a finite number, found `\\u{1}\\u{1b}\\u{7f}`",
        ),
        (
            "0.872665",
            "# 0.872665",
            "line 7: theta_i: expected a finite number, found `# 0.872665`",
        ),
    ];
    check_edits(ASTM, &edits, AstmFile::from_bytes);
    let header = &ASTM[..ASTM.find("0.872665").unwrap()];
    let message = "line 6: rows: expected at least one row, found the end of the file";
    expect(AstmFile::from_bytes(header.as_bytes()), message);
    let garbage: Vec<u8> = ASTM.bytes().chain([0xff, 0xfe, 0x00]).collect();
    let message = "line 9: theta_i: expected a finite number, found `\u{fffd}\u{fffd}\\u{0}`";
    expect(AstmFile::from_bytes(&garbage), message);
    let message =
        "line 1: VARS: expected a VARS line that ends the header, found the end of the file";
    expect(AstmFile::from_bytes(b""), message);
}

#[test]
fn broken_pbrt_text_files_are_refused_with_one_clear_line() {
    let edits = [
        (
            "\n3\n",
            "\nthree\n",
            "line 3: wavelength count: expected a positive count alone on its line, found `three`",
        ),
        (
            "\n3\n",
            "\n0\n",
            "line 3: wavelength count: expected a positive count alone on its line, found `0`",
        ),
        (
            "\n3\n",
            "\n3 400\n",
            "line 3: wavelength count: expected a positive count alone on its line, found `3 400`",
        ),
        (
            "\n3\n",
            "\n2\n",
            "line 6: row: expected 6 blank-separated numbers, found 1",
        ),
        (
            "400 500",
            "400 five",
            "line 5: wavelengths: expected a wavelength in nm, found `five`",
        ),
        (
            "\n3\n",
            "\n1\n",
            "line 5: wavelengths: expected 1 numbers, the last ending its line, found 2 up to here",
        ),
        (
            "400 500",
            "500 400",
            "line 6: wavelengths: expected ascending wavelengths in nm, found 400 after 500",
        ),
        (
            "400 500",
            "-400 500",
            "line 6: wavelengths: expected ascending wavelengths in nm, found -400 after 0",
        ),
        (
            "# Paper",
            "# Pa\u{7}per",
            "line 1: header: expected text, found byte 0x07",
        ),
        (
            "0.2",
            "zero",
            "line 8: 500nm: expected a finite number, found `zero`",
        ),
        (
            " 0.6",
            " NaN",
            "line 9: 600.5nm: expected a finite number, found `NaN`",
        ),
        (
            " 0.3\n",
            "\n",
            "line 8: row: expected 7 blank-separated numbers, found 6",
        ),
        (
            "0.3\n",
            "0.3 0.4\n",
            "line 8: row: expected 7 blank-separated numbers, found 8",
        ),
        (
            "0.573513",
            "32.86",
            "line 8: theta_o: expected an angle in radians, at most 3.1416, \
             found 32.86, which looks like degrees",
        ),
        (
            "0.3\n",
            "0.3\n# more\n",
            "line 9: comment: expected comments above the rows only, found `# more` (not supported)",
        ),
    ];
    check_edits(PBRT, &edits, PbrtTextFile::from_bytes);
    check_edits(PBRT, &edits, |bytes| read(bytes.to_vec()));
}

#[test]
fn truncated_pbrt_text_files_say_what_is_missing() {
    let head = |end: &str| &PBRT.as_bytes()[..PBRT.find(end).unwrap()];
    let cases = [
        (
            &b""[..],
            "line 1: wavelength count: expected a positive count, found the end of the file",
        ),
        (
            head("3\n"),
            "line 2: wavelength count: expected a positive count, found the end of the file",
        ),
        (
            head("600.5"),
            "line 5: wavelengths: expected 3 numbers, found the end of the file",
        ),
        (
            head("0.872665"),
            "line 7: rows: expected at least one row, found the end of the file",
        ),
    ];
    for (bytes, message) in cases {
        expect(PbrtTextFile::from_bytes(bytes), message);
    }
    let lying = PBRT.replace("\n3\n", "\n18446744073709551615\n");
    let message = "line 9: wavelengths: expected 18446744073709551615 numbers, \
                   found the end of the file";
    expect(PbrtTextFile::from_bytes(lying.as_bytes()), message);
}
