//! Detection and refusal of KAIST files: no panic.
#![no_main]

use brdf_formats::{FORMATS, File, read};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for format in FORMATS.iter().filter(|f| f.name == "kaist") {
        if (format.detect)(bytes, bytes.len() as u64) {
            assert!((format.read)(bytes.to_vec()).is_err());
        }
    }
    if let Ok(File::Rgl(file)) = read(bytes.to_vec()) {
        assert!(file.tensors().field("M").is_none());
    }
});
