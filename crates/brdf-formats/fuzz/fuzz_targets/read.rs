//! Detection and reading of anything: no panic, and writers take what readers gave.
#![no_main]

use brdf_formats::{detect, read};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let format = detect(bytes).map(|f| f.name);
    let Ok(file) = read(bytes.to_vec()) else {
        return;
    };
    assert_eq!(format, Some(file.format().name));
    if let Some(write) = file.format().writer {
        let mut out = Vec::new();
        write(&file, &mut out).expect("a Vec takes everything");
        assert_eq!(detect(&out).map(|f| f.name), format);
    }
});
