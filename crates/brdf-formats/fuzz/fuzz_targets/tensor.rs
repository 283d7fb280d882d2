//! The tensor container: no panic, and every field within the file.
#![no_main]

use brdf_formats::TensorFile;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(file) = TensorFile::from_bytes(bytes.to_vec()) else {
        return;
    };
    for field in file.fields() {
        let count = field.element_count();
        assert_eq!(field.bytes().len(), count * field.dtype().size());
        assert!(field.to_f32().is_none_or(|v| v.len() == count));
    }
});
