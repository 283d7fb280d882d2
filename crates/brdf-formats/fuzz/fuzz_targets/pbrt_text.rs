//! The pbrt text reader: no panic, and the same numbers, bit for bit, after writing.
#![no_main]

use brdf_formats::PbrtTextFile;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(file) = PbrtTextFile::from_bytes(bytes) else {
        return;
    };
    let again = PbrtTextFile::from_bytes(&file.to_bytes()).expect("what was written can be read");
    let bits = |file: &PbrtTextFile| file.rows().iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&file), bits(&again));
    assert_eq!(file.header(), again.header());
});
