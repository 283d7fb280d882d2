//! The genuine files, where `GONIO_DATA` names a folder that has them.

use brdf_formats::{Channels, File, detect, read};
use std::path::PathBuf;

/// The bytes of every file with this extension in a folder of the data; empty without data.
#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn data_files(folder: &str, extension: &str) -> Vec<(PathBuf, Vec<u8>)> {
    let Some(root) = std::env::var_os("GONIO_DATA") else {
        println!("skipped: GONIO_DATA is not set");
        return Vec::new();
    };
    let folder = PathBuf::from(root).join(folder);
    let mut files: Vec<_> = std::fs::read_dir(&folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == extension))
        .map(|path| {
            let bytes = load(&path);
            (path, bytes)
        })
        .collect();
    files.sort();
    assert!(!files.is_empty(), "no .{extension} in {}", folder.display());
    files
}

#[expect(
    clippy::disallowed_methods,
    reason = "tests bring the bytes themselves"
)]
fn load(path: &std::path::Path) -> Vec<u8> {
    std::fs::read(path).unwrap()
}

#[test]
fn cornell_astm_files_come_back_byte_for_byte() {
    for (path, bytes) in data_files("cornell", "astm") {
        assert_eq!(detect(&bytes).unwrap().name, "astm");
        let File::Astm(file) = read(bytes.clone()).unwrap() else {
            panic!("{} is not ASTM", path.display());
        };
        assert_eq!(file.row_count(), 1439);
        assert_eq!(file.channels(), &Channels::Rgb);
        assert_eq!(file.field("NUM_POINTS").unwrap(), "1439");
        assert!(
            file.field("SAMPLE_TYPE")
                .unwrap()
                .starts_with("Medium-gloss")
        );
        assert!(
            (0..1439).all(|row| file.angles(row)[1] == 0.0),
            "phi_i is 0 in these files"
        );
        assert!(file.to_bytes() == bytes, "{} changed", path.display());
    }
}

#[test]
fn cornell_spectral_files_come_back_byte_for_byte() {
    for (path, bytes) in data_files("cornell-spectral", "brdf") {
        assert_eq!(detect(&bytes).unwrap().name, "pbrt-text");
        let File::PbrtText(file) = read(bytes.clone()).unwrap() else {
            panic!("{} is not pbrt text", path.display());
        };
        assert_eq!(file.row_count(), 1439);
        let nm: Vec<f64> = (0..31).map(|i| 400.0 + 10.0 * f64::from(i)).collect();
        assert_eq!(file.wavelengths_nm(), nm);
        assert!(
            file.comments()
                .next()
                .unwrap()
                .contains("Cornell University")
        );
        assert!(file.to_bytes() == bytes, "{} changed", path.display());
    }
}

#[test]
fn rgl_files_give_their_typed_view() {
    for (path, bytes) in data_files("rgl", "bsdf") {
        assert_eq!(detect(&bytes).unwrap().name, "rgl");
        let File::Rgl(file) = read(bytes).unwrap() else {
            panic!("{} is not RGL", path.display());
        };
        let view = file.view().unwrap();
        assert_eq!(view.phi_i.len(), 1);
        assert_eq!(view.theta_i.len(), 8);
        assert_eq!(view.sigma.shape, [2, 128]);
        assert_eq!(view.vndf.shape, [1, 8, 128, 128]);
        assert_eq!(view.luminance.shape, [1, 8, 32, 32]);
        assert_eq!(view.values.shape, [1, 8, 3, 32, 32]);
        assert_eq!(view.values.data.len(), 8 * 3 * 32 * 32);
        assert_eq!(view.valid.unwrap().len(), 1024);
        assert!(view.jacobian, "these files carry the Jacobian");
        assert!(!view.description.is_empty(), "{}", path.display());
    }
}

#[test]
fn other_data_is_not_mistaken_for_a_known_format() {
    let others = [
        ("curet", "dat"),
        ("alta", "alta"),
        ("radiance", "xml"),
        ("mbsdf", "mbsdf"),
        ("fits", "csv"),
    ];
    for (folder, extension) in others {
        for (path, bytes) in data_files(folder, extension) {
            assert!(detect(&bytes).is_none(), "{}", path.display());
        }
    }
}
