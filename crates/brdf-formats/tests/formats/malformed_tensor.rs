//! Broken tensor files, each with the one line that says what is wrong.

use crate::fixtures::{F32, Field, U8, rgl_fields, rgl_spectral_fields, tensor};
use crate::malformed::expect;
use brdf_formats::{RglFile, TensorFile, read};

#[test]
fn broken_containers_are_refused_with_one_clear_line() {
    // One field named "ab" with 2 axes: its entry starts at 18, is 31 bytes long, its data at 56.
    let sound = tensor(&[Field::ramp("ab", &[2, 3])]);
    assert!(
        TensorFile::from_bytes(sound.clone()).is_ok(),
        "the sound file is refused"
    );
    let patched = |at: usize, new: &[u8]| {
        let mut bytes = sound.clone();
        bytes[at..at + new.len()].copy_from_slice(new);
        bytes
    };
    let huge = u64::MAX.to_le_bytes();
    let shape = |axes: [u64; 2]| patched(33, &axes.map(u64::to_le_bytes).concat());
    let twice = tensor(&[Field::bytes("a", b"x"), Field::bytes("a", b"y")]);
    let outside = "byte 18: data of `ab`: expected data within the file's 80 bytes, found shape";
    let cases: [(Vec<u8>, String); 15] = [
        (
            vec![],
            "byte 0: magic: expected 12 bytes, found 0 before the end of the file".into(),
        ),
        (
            patched(0, b"T"),
            "byte 0: magic: expected `tensor_file\\0`, found `Tensor_file\\u{0}`".into(),
        ),
        (
            patched(12, &[2]),
            "byte 12: version: expected 1.x, found 2.0 (not supported)".into(),
        ),
        (
            sound[..15].to_vec(),
            "byte 14: field count: expected 4 bytes, found 1 before the end of the file".into(),
        ),
        (
            sound[..18].to_vec(),
            "byte 18: name length: expected 2 bytes, found 0 before the end of the file".into(),
        ),
        (
            patched(18, &[0xff, 0xff]),
            "byte 20: name: expected 65535 bytes, found 60 before the end of the file".into(),
        ),
        (
            patched(20, &[0xff, 0xfe]),
            "byte 18: name: expected UTF-8, found `\u{fffd}\u{fffd}`".into(),
        ),
        (
            patched(22, &[0xff, 0xff]),
            "byte 33: shape: expected 524280 bytes, found 47 before the end of the file".into(),
        ),
        (
            patched(24, &[12]),
            "byte 18: dtype of `ab`: expected a code from 1 to 11, found 12".into(),
        ),
        (
            patched(24, &[0]),
            "byte 18: dtype of `ab`: expected a code from 1 to 11, found 0".into(),
        ),
        (
            patched(25, &huge),
            format!("{outside} [2, 3] of f32 at byte {}", u64::MAX),
        ),
        (
            patched(25, &[57]),
            format!("{outside} [2, 3] of f32 at byte 57"),
        ),
        (shape([2, 4]), format!("{outside} [2, 4] of f32 at byte 56")),
        (
            shape([1 << 63, 8]),
            format!("{outside} [{}, 8] of f32 at byte 56", 1_u64 << 63),
        ),
        (
            twice,
            "byte 40: name: expected each name once, found `a`".into(),
        ),
    ];
    for (bytes, message) in cases {
        expect(TensorFile::from_bytes(bytes.clone()), &message);
        expect(RglFile::from_bytes(bytes), &message);
    }
    let many = patched(14, &u32::MAX.to_le_bytes());
    let error = TensorFile::from_bytes(many).unwrap_err().to_string();
    assert!(error.starts_with("byte 49: "), "{error}");
}

/// The error after one field of a sound RGL file was replaced by another.
fn with(field: Field) -> String {
    let mut fields = rgl_fields();
    let old = fields.iter_mut().find(|f| f.name == field.name).unwrap();
    *old = field;
    read(tensor(&fields)).unwrap_err().to_string()
}

#[test]
fn every_field_of_an_rgl_file_is_checked_on_its_own() {
    assert!(
        read(tensor(&rgl_fields())).is_ok(),
        "the sound file is refused"
    );
    let f64s = |name| Field {
        name,
        dtype: 11,
        shape: vec![1],
        data: vec![0; 8],
    };
    let cases = [
        (f64s("phi_i"), ": phi_i: expected f32, found f64"),
        (f64s("sigma"), ": sigma: expected f32, found f64"),
        (f64s("jacobian"), ": jacobian: expected u8, found f64"),
        (f64s("valid"), ": valid: expected u8, found f64"),
        (f64s("description"), ": description: expected u8, found f64"),
        (
            Field::ramp("phi_i", &[0]),
            ": phi_i: expected a shape of 1 axes, none empty, found [0]",
        ),
        (
            Field::ramp("theta_i", &[1, 2]),
            ": theta_i: expected a shape of 1 axes, none empty, found [1, 2]",
        ),
        (
            Field::floats("theta_i", &[2], &[1.0, 1.0]),
            "file: theta_i: expected ascending radians from 0 to 1.571, found 1 at index 1",
        ),
        (
            Field::floats("theta_i", &[2], &[0.0, 80.0]),
            "file: theta_i: expected ascending radians from 0 to 1.571, found 80 at index 1",
        ),
        (
            Field::floats("phi_i", &[1], &[f32::NAN]),
            "file: phi_i: expected ascending radians from -7 to 7, found NaN at index 0",
        ),
        (
            Field::ramp("ndf", &[1, 4]),
            ": ndf: expected shape [>=2, >=2], found [1, 4]",
        ),
        (
            Field::ramp("vndf", &[1, 3, 2, 2]),
            ": vndf: expected shape [1, 2, >=2, >=2], found [1, 3, 2, 2]",
        ),
        (
            Field::ramp("luminance", &[2, 2, 2, 2]),
            ": luminance: expected shape [1, 2, >=2, >=2], found [2, 2, 2, 2]",
        ),
        (
            Field::ramp("rgb", &[1, 2, 4, 2, 2]),
            ": rgb: expected shape [1, 2, 3, >=2, >=2], found [1, 2, 4, 2, 2]",
        ),
        (
            Field::ramp("rgb", &[1, 2, 3, 2]),
            ": rgb: expected a shape of 5 axes, none empty, found [1, 2, 3, 2]",
        ),
        (
            Field::bytes("jacobian", &[1, 1]),
            ": jacobian: expected shape [1], found [2]",
        ),
        (
            Field::bytes("valid", &[1, 1]),
            ": valid: expected shape [1], found [2]",
        ),
    ];
    for (field, ending) in cases {
        let error = with(field);
        assert!(error.ends_with(ending), "{error}\nshould end in\n{ending}");
        assert!(
            error.starts_with("byte ") || error.starts_with("file: "),
            "{error}"
        );
    }
}

#[test]
fn fields_an_rgl_file_can_not_do_without_are_asked_for() {
    let needed = [
        "phi_i",
        "theta_i",
        "sigma",
        "ndf",
        "vndf",
        "luminance",
        "jacobian",
    ];
    for name in needed {
        let mut fields = rgl_fields();
        fields.retain(|f| f.name != name);
        let message = format!("file: {name}: expected a field of this name, found none");
        expect(read(tensor(&fields)), &message);
    }
    let mut fields = rgl_fields();
    fields.retain(|f| f.name != "rgb");
    let neither = "file: values: expected a field `rgb` or `spectra`, found neither";
    expect(read(tensor(&fields)), neither);
    fields = rgl_fields();
    fields.push(Field::ramp("spectra", &[1, 2, 5, 2, 2]));
    let both = "file: values: expected a field `rgb` or `spectra`, found both";
    expect(read(tensor(&fields)), both);
    for name in ["valid", "description", "version"] {
        let mut fields = rgl_fields();
        fields.retain(|f| f.name != name);
        assert!(read(tensor(&fields)).is_ok(), "{name} may be absent");
    }
}

#[test]
fn spectral_rgl_files_need_ascending_wavelengths() {
    let mut fields = rgl_spectral_fields();
    assert!(read(tensor(&fields)).is_ok(), "the sound file is refused");
    let nm = fields.pop().unwrap();
    let message = "file: wavelengths: expected a field of this name, found none";
    expect(read(tensor(&fields)), message);
    fields.push(Field::floats(
        "wavelengths",
        &[5],
        &[5.0, 4.0, 3.0, 2.0, 1.0],
    ));
    let error = read(tensor(&fields)).unwrap_err().to_string();
    assert!(
        error.ends_with("expected ascending wavelengths in nm, found 4 after 5"),
        "{error}"
    );
    *fields.last_mut().unwrap() = Field::floats("wavelengths", &[4], &[1.0, 2.0, 3.0, 4.0]);
    let error = read(tensor(&fields)).unwrap_err().to_string();
    assert!(
        error.ends_with("expected shape [1, 2, 4, >=2, >=2], found [1, 2, 5, 2, 2]"),
        "{error}"
    );
    *fields.last_mut().unwrap() = Field { dtype: U8, ..nm };
    let error = read(tensor(&fields)).unwrap_err().to_string();
    assert!(
        error.ends_with("wavelengths: expected f32, found u8"),
        "{error}"
    );
}

#[test]
fn anisotropic_rgl_files_are_sound_but_have_no_typed_view_yet() {
    let fields = [
        Field::floats("phi_i", &[4], &[-3.0, -1.0, 1.0, 3.0]),
        Field::floats("theta_i", &[1], &[0.5]),
        Field::ramp("sigma", &[2, 2]),
        Field::ramp("ndf", &[2, 2]),
        Field::ramp("vndf", &[4, 1, 2, 2]),
        Field::ramp("luminance", &[4, 1, 2, 2]),
        Field::ramp("rgb", &[4, 1, 3, 2, 2]),
        Field::bytes("jacobian", &[1]),
    ];
    let file = RglFile::from_bytes(tensor(&fields)).unwrap();
    assert!(!file.is_isotropic(), "four azimuths");
    let message = "file: phi_i: expected an isotropic file, with at most 2 azimuths, \
                   found 4 azimuths (not supported)";
    expect(file.view(), message);
}

#[test]
fn kaist_files_with_empty_axes_are_still_recognised() {
    let empty = |name| Field {
        name,
        dtype: F32,
        shape: vec![0, 9],
        data: vec![],
    };
    let fields = [
        empty("theta_h"),
        empty("theta_d"),
        Field::ramp("M", &[1, 1, 1, 5, 4, 4]),
    ];
    let message = "file: M: expected unpolarised values, \
                   found Mueller matrices of shape [1, 1, 1, 5, 4, 4] (not supported)";
    expect(read(tensor(&fields)), message);
}
