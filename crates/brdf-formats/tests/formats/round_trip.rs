//! What is written comes back bit for bit, and no bytes make a reader panic.

use crate::fixtures;
use brdf_formats::{AstmFile, Channels, Error, FORMATS, File, MerlFile, MerlReader, PbrtTextFile};
use brdf_formats::{RglFile, TensorFile, detect, read};
use proptest::collection::vec;
use proptest::prelude::*;

/// Any f64 that a text file can hold, subnormals and -0 included.
fn finite() -> impl Strategy<Value = f64> {
    any::<u64>()
        .prop_map(f64::from_bits)
        .prop_filter("finite", |v| v.is_finite())
}

/// Rows of four angles and `channels` values.
fn rows(channels: usize) -> impl Strategy<Value = Vec<f64>> {
    let row = (
        vec(-3.0..3.0_f64, 4),
        vec(prop_oneof![finite(), -0.01..1.0_f64], channels),
    )
        .prop_map(|(angles, values)| [angles, values].concat());
    vec(row, 1..6).prop_map(|rows| rows.concat())
}

fn channels() -> impl Strategy<Value = Channels> {
    prop_oneof![
        Just(Channels::Rgb),
        Just(Channels::Xyz),
        wavelengths().prop_map(Channels::Wavelengths),
    ]
}

fn wavelengths() -> impl Strategy<Value = Vec<f64>> {
    vec(0.1..50.0_f64, 1..70).prop_map(|steps| {
        let sum = |at: &mut f64, step| {
            *at += step;
            Some(*at)
        };
        steps.into_iter().scan(300.0, sum).collect()
    })
}

fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn merl_keeps_every_bit_of_every_value(
        dims in [1_u32..5, 1_u32..5, 1_u32..9],
        seeds in vec(any::<u64>(), 512),
    ) {
        // Any bits: NaN with payloads, infinities, negatives and -1 are all values here.
        let bits_of = |channel: usize, cell: usize| seeds[(channel * 131 + cell) % seeds.len()];
        let file = MerlFile::from_fn(dims, |c, i| f64::from_bits(bits_of(c, i))).unwrap();
        let bytes = file.to_bytes();
        prop_assert_eq!(detect(&bytes).unwrap().name, "merl");
        let again = MerlFile::from_bytes(bytes.clone()).unwrap();
        prop_assert_eq!(again.dims(), dims);
        let reader = MerlReader::new(&bytes[..], bytes.len() as u64).unwrap();
        prop_assert_eq!(reader.cells(), again.cells() as u64);
        let mut read = Vec::new();
        for channel in 0..3 {
            for first in 0..reader.cells() {
                // up to three values, from anywhere
                let mut some = vec![0.0; 3.min(reader.cells() - first) as usize];
                reader.read(channel, first, &mut some).unwrap();
                read.extend(bits(&some[..1]));
            }
        }
        let mut planes = Vec::new();
        for channel in 0..3 {
            planes.extend(again.plane(channel).map(f64::to_bits));
            for cell in 0..again.cells() {
                prop_assert_eq!(again.value(channel, cell).to_bits(), bits_of(channel, cell));
            }
        }
        prop_assert_eq!(planes, read);
    }

    #[test]
    fn astm_keeps_every_bit_of_every_number(
        (channels, rows) in channels().prop_flat_map(|c| {
            let count = c.len();
            (Just(c), rows(count))
        }),
        name in "[ -~äß]{0,20}",
    ) {
        let file = AstmFile::new(&[("SAMPLE_NAME", &name)], channels, rows.clone()).unwrap();
        let bytes = file.to_bytes();
        prop_assert_eq!(detect(&bytes).unwrap().name, "astm");
        let again = AstmFile::from_bytes(&bytes).unwrap();
        prop_assert_eq!(bits(again.rows()), bits(&rows));
        prop_assert_eq!(again.channels(), file.channels());
        prop_assert_eq!(again.field("SAMPLE_NAME").unwrap(), name.trim());
        let third = AstmFile::from_bytes(&again.to_bytes()).unwrap();
        prop_assert_eq!(bits(third.rows()), bits(&rows));
    }

    #[test]
    fn pbrt_text_keeps_every_bit_of_every_number(
        (nm, rows) in wavelengths().prop_flat_map(|nm| {
            let count = nm.len();
            (Just(nm), rows(count))
        }),
        comment in "[ -~äß]{0,20}",
    ) {
        let file = PbrtTextFile::new(&[&comment], nm.clone(), rows.clone()).unwrap();
        let bytes = file.to_bytes();
        prop_assert_eq!(detect(&bytes).unwrap().name, "pbrt-text");
        let again = PbrtTextFile::from_bytes(&bytes).unwrap();
        prop_assert_eq!(bits(again.rows()), bits(&rows));
        prop_assert_eq!(bits(again.wavelengths_nm()), bits(&nm));
        prop_assert_eq!(again.comments().next().unwrap(), comment.trim());
        let third = PbrtTextFile::from_bytes(&again.to_bytes()).unwrap();
        prop_assert_eq!(bits(third.rows()), bits(&rows));
    }

    #[test]
    fn uniform_text_comes_back_byte_for_byte(
        integers in vec(-3_000_000..3_000_000_i64, 7..70),
        decimals in 1_usize..9,
        crlf: bool,
        last_end: bool,
    ) {
        let end = if crlf { "\r\n" } else { "\n" };
        let text = |n: &i64| format!("{:.*}", decimals, *n as f64 / 1e6);
        let rows: Vec<String> = integers
            .chunks_exact(7)
            .map(|row| row.iter().map(text).collect::<Vec<_>>().join(","))
            .collect();
        let mut file = format!("SAMPLE_NAME x{end}{end}VARS theta_i,phi_i,theta_s,phi_s,X,Y,Z{end}");
        file.push_str(&rows.join(end));
        file.push_str(if last_end { end } else { "" });
        let astm = AstmFile::from_bytes(file.as_bytes()).unwrap();
        prop_assert_eq!(String::from_utf8(astm.to_bytes()).unwrap(), file);
    }

    #[test]
    fn no_bytes_make_a_reader_panic(bytes in vec(any::<u8>(), 0..300)) {
        survive(&bytes);
        for magic in [&b"tensor_file\0\x01\0"[..], b"VARS theta_i,phi_i,theta_s,phi_s,R,G,B\n", b"2\n1 2\n"] {
            survive(&[magic, &bytes].concat());
        }
    }

    #[test]
    fn no_text_makes_a_reader_panic(text in "[-+.,eE# \n\r0-9a-zA-Z]{0,200}") {
        survive(text.as_bytes());
        survive(format!("VARS theta_i,phi_i,theta_s,phi_s,X,Y,Z\n{text}").as_bytes());
        survive(format!("# num wls\n1\n400\n{text}").as_bytes());
    }

    #[test]
    fn no_damage_to_a_sound_file_makes_a_reader_panic(
        which in 0_usize..5,
        damage in vec((any::<prop::sample::Index>(), any::<u8>()), 1..8),
        cut: prop::sample::Index,
        cut_it: bool,
    ) {
        let mut bytes = match which {
            0 => fixtures::merl(),
            1 => fixtures::ASTM.into(),
            2 => fixtures::PBRT.into(),
            3 => fixtures::tensor(&fixtures::rgl_fields()),
            _ => fixtures::tensor(&fixtures::rgl_spectral_fields()),
        };
        for (at, byte) in damage {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if cut_it {
            bytes.truncate(cut.index(bytes.len()));
        }
        survive(&bytes);
    }
}

/// Hands the bytes to every reader; whatever is read must also be written and read again.
fn survive(bytes: &[u8]) {
    let one_line = |error: Error| {
        let lines = error.to_string().lines().count();
        assert_eq!(lines, 1, "{error}");
    };
    for format in FORMATS {
        match (format.read)(bytes.to_vec()) {
            Err(error) => one_line(error),
            Ok(file) => write_again(&file),
        }
    }
    if let Err(error) = read(bytes.to_vec()) {
        one_line(error);
    }
    if let Ok(tensors) = TensorFile::from_bytes(bytes.to_vec()) {
        for field in tensors.fields() {
            let size = field.element_count() * field.dtype().size();
            assert_eq!(size, field.bytes().len(), "{}", field.name());
        }
    }
    if let Ok(file) = RglFile::from_bytes(bytes.to_vec()) {
        assert_eq!(file.view().is_ok(), file.is_isotropic(), "the view fails");
    }
    if let Ok(reader) = MerlReader::new(bytes, bytes.len() as u64) {
        let mut last = [0.0];
        reader.read(2, reader.cells() - 1, &mut last).unwrap();
        reader.check_end().unwrap();
    }
}

fn write_again(file: &File) {
    let mut out = Vec::new();
    if let Some(write) = file.format().writer {
        write(file, &mut out).unwrap();
        let again = (file.format().read)(out.clone()).unwrap();
        let mut third = Vec::new();
        write(&again, &mut third).unwrap();
        assert!(out == third, "writing is not stable");
    }
}

#[test]
fn rows_may_come_in_any_order_with_blank_lines_and_other_spellings() {
    let text = "VARS theta_i, phi_i ,theta_s,phi_s,400nm,410.5 nm\n\n\
                1e-1,0,.5,+2, 5. ,1E2\n   \n0.3,0,0.2,0,-0,7\n\n";
    let file = AstmFile::from_bytes(text.as_bytes()).unwrap();
    assert_eq!(file.channels(), &Channels::Wavelengths(vec![400.0, 410.5]));
    assert_eq!(file.angles(0), [0.1, 0.0, 0.5, 2.0]);
    assert_eq!(file.values(0), [5.0, 100.0]);
    assert_eq!(file.value_columns(), ["400nm", "410.5 nm"]);
    assert!(file.values(1)[0].is_sign_negative(), "-0 lost its sign");
    let again = AstmFile::from_bytes(&file.to_bytes()).unwrap();
    assert_eq!(again.rows(), file.rows());
    assert_eq!(again.header(), file.header());
}

#[test]
fn the_typed_view_gives_the_fields_as_they_are() {
    let file = RglFile::from_bytes(fixtures::tensor(&fixtures::rgl_fields())).unwrap();
    let view = file.view().unwrap();
    assert_eq!((view.phi_i, view.theta_i), (vec![0.0], vec![0.0, 1.5]));
    assert_eq!(view.values.shape, [1, 2, 3, 2, 2]);
    assert_eq!(view.values.data[23], 23.0);
    assert_eq!(view.valid, Some(vec![0b1010_0101]));
    assert_eq!(view.channels, Channels::Rgb);
    assert_eq!(view.description, "Paper");
    assert!(view.jacobian, "the file says 1");
    let spectral = fixtures::tensor(&fixtures::rgl_spectral_fields());
    let view = RglFile::from_bytes(spectral).unwrap().view().unwrap();
    let nm = vec![360.0, 420.0, 500.0, 700.5, 1000.0];
    assert_eq!(view.channels, Channels::Wavelengths(nm));
    assert_eq!(view.values.shape, [1, 2, 5, 2, 2]);
}
