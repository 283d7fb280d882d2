//! The registry, and detection by content.

use crate::fixtures;
use brdf_formats::{ErrorKind, FORMATS, File, detect, detect_prefix, read};
use std::path::Path;

/// A sound file of the format (for KAIST: one that is recognised).
fn sample(name: &str) -> Vec<u8> {
    match name {
        "merl" => fixtures::merl(),
        "astm" => fixtures::ASTM.into(),
        "pbrt-text" => fixtures::PBRT.into(),
        "rgl" => fixtures::tensor(&fixtures::rgl_fields()),
        "kaist" => fixtures::tensor(&[fixtures::Field::ramp("M", &[1, 1, 1, 5, 4, 4])]),
        other => panic!("no sample of {other}"),
    }
}

#[test]
fn every_format_is_told_by_its_content_alone_and_by_no_other_format() {
    for format in FORMATS {
        let bytes = sample(format.name);
        assert_eq!(detect(&bytes).unwrap().name, format.name);
        for prefix in [1 << 16, 400] {
            let prefix = &bytes[..bytes.len().min(prefix)];
            let found = detect_prefix(prefix, bytes.len() as u64);
            assert_eq!(found.unwrap().name, format.name, "{} bytes", prefix.len());
        }
    }
}

#[test]
fn every_format_reads_and_writes_as_it_says() {
    for format in FORMATS {
        let bytes = sample(format.name);
        if format.name == "kaist" {
            let error = read(bytes).unwrap_err();
            assert_eq!(error.kind(), ErrorKind::Unsupported);
            let said = "file: M: expected unpolarised values, found Mueller matrices of shape \
                        [1, 1, 1, 5, 4, 4] (not supported)";
            assert_eq!(error.to_string(), said);
            continue;
        }
        let file: File = (format.read)(bytes.clone()).unwrap();
        assert_eq!(file.format().name, format.name);
        let mut out = Vec::new();
        match format.writer {
            Some(write) => {
                write(&file, &mut out).unwrap();
                assert_eq!(detect(&out).unwrap().name, format.name);
            }
            None => {
                let error = file.write(&mut out).unwrap_err();
                assert_eq!(error.kind(), std::io::ErrorKind::Unsupported);
            }
        }
    }
}

#[test]
fn every_format_has_its_docs_page_and_says_what_it_is() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    for (i, format) in FORMATS.iter().enumerate() {
        assert_eq!(format.docs, format!("docs/formats/{}.md", format.name));
        assert!(
            root.join(format.docs).is_file(),
            "{} is missing",
            format.docs
        );
        assert!(
            !format.title.is_empty() && !format.magic.is_empty(),
            "{}",
            format.name
        );
        assert!(!format.extensions.is_empty(), "{}", format.name);
        let same = FORMATS[..i].iter().any(|f| f.name == format.name);
        assert!(!same, "{} comes twice", format.name);
    }
}

#[test]
fn usual_merl_dims_are_recognised_even_when_the_size_is_wrong() {
    for phi_d in [180, 360] {
        let header = fixtures::merl_header([90, 90, phi_d]);
        assert_eq!(detect(&header).unwrap().name, "merl");
    }
    assert!(detect(&fixtures::merl_header([90, 90, 181])).is_none());
}

#[test]
fn broken_text_files_are_still_recognised_so_that_their_reader_can_say_why() {
    let astm = fixtures::ASTM.replace("VARS", "VARIABLES");
    assert_eq!(detect(astm.as_bytes()).unwrap().name, "astm");
    let no_comments = "3\n400 500 600\n0 0 0 0 1 x 3\n";
    assert_eq!(detect(no_comments.as_bytes()).unwrap().name, "pbrt-text");
    let spelled = fixtures::PBRT.replace("400 500", "four hundred");
    assert_eq!(detect(spelled.as_bytes()).unwrap().name, "pbrt-text");
}

#[test]
fn what_no_reader_knows_is_unsupported_and_an_empty_file_is_invalid() {
    let error = read(b"\x89PNG\r\n".to_vec()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert_eq!(
        error.to_string(),
        "file: format: expected one of kaist, rgl, merl, astm, pbrt-text, \
         found `\u{fffd}PNG\\r\\n` (not supported)"
    );
    let error = read(Vec::new()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Invalid);
    assert!(
        error.to_string().ends_with("found an empty file"),
        "{error}"
    );
}
