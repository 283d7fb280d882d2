//! The MERL reader under a true and a false length: no panic, and all values that are there.
#![no_main]

use brdf_formats::MerlReader;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (u64, &[u8])| {
    let (claimed, bytes) = input;
    for total in [bytes.len() as u64, claimed] {
        let Ok(reader) = MerlReader::new(bytes, total) else {
            continue;
        };
        let mut count = 0;
        let mut piece = [0.0];
        for channel in 0..3 {
            for cell in 0..reader.cells().min(1 << 12) {
                count += usize::from(reader.read(channel, cell, &mut piece).is_ok());
            }
        }
        assert!(count * 8 <= bytes.len());
        let _ = reader.check_end();
    }
});
