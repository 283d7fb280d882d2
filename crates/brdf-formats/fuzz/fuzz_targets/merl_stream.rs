//! The MERL stream under a true and a false length: no panic, and all values.
#![no_main]

use brdf_formats::MerlStream;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|input: (u64, &[u8])| {
    let (claimed, bytes) = input;
    for total in [bytes.len() as u64, claimed] {
        let Ok(mut stream) = MerlStream::new(bytes, total) else {
            continue;
        };
        let mut count = 0;
        while let Ok(Some(chunk)) = stream.next_chunk() {
            count += chunk.len();
        }
        assert!(count * 8 <= bytes.len());
    }
});
