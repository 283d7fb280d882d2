//! The MERL reader: no panic, and the same bytes back.
#![no_main]

use brdf_formats::MerlFile;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(file) = MerlFile::from_bytes(bytes.to_vec()) {
        assert_eq!(file.to_bytes(), bytes);
        assert_eq!(
            (0..3).map(|c| file.plane(c).count()).sum::<usize>(),
            3 * file.cells()
        );
    }
});
