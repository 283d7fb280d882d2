//! The RGL reader and its typed view: no panic.
#![no_main]

use brdf_formats::RglFile;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(file) = RglFile::from_bytes(bytes.to_vec()) else {
        return;
    };
    assert_eq!(file.view().is_ok(), file.is_isotropic());
});
