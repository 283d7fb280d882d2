//! EXR and PNG round trips; the metrics on pictures whose differences are known.

use scene_io::compare;
use scene_io::image::{
    Metadata, Picture, ToneMap, read_exr, read_exr_bytes, to_srgb8, write_exr, write_png,
};
use spectrum::GamutMapping;

/// Values that f16, 8 bits or any lossy compression would change, some negative.
fn picture() -> Picture {
    let value = |k: usize| (k as f32 * 0.377).sin() * 1e3 + 1.0 / 3.0;
    let pixels = (0..35)
        .map(|k| [value(k), value(k + 50), -value(k + 99)])
        .collect();
    let variance = (0..35).map(|k| [k as f32 * 1e-7, 0.0, 1e-30]).collect();
    Picture {
        variance: Some(variance),
        metadata: Metadata {
            scene: Some("scenes/benchmark/scene.ron".into()),
            seed: Some(u64::MAX),
            spp: Some(1 << 40),
            seconds: Some(1.0 / 3.0),
            version: Some("0.1.0".into()),
            sampler: Some("inversion".into()),
        },
        ..Picture::new(7, 5, pixels).unwrap()
    }
}

#[test]
fn exr_keeps_every_bit_and_every_entry() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.exr");
    write_exr(&path, &picture()).unwrap();
    assert_eq!(read_exr(&path).unwrap(), picture());
    let plain = Picture {
        variance: None,
        metadata: Metadata::default(),
        ..picture()
    };
    write_exr(&path, &plain).unwrap();
    assert_eq!(read_exr(&path).unwrap(), plain);
}

#[test]
fn rgba_files_of_other_programs_are_read_and_alpha_is_ignored() {
    use exr::prelude::{Image, SpecificChannels, WritableImage};
    let channels = SpecificChannels::rgba(|p: exr::prelude::Vec2<usize>| {
        (p.0 as f32, p.1 as f32, 0.5_f32, 0.25_f32)
    });
    let mut file = std::io::Cursor::new(Vec::new());
    Image::from_channels((3, 2), channels)
        .write()
        .to_buffered(&mut file)
        .unwrap();
    let read = read_exr_bytes(file.get_ref()).unwrap();
    assert_eq!((read.width, read.height), (3, 2));
    assert_eq!(read.pixels[5], [2.0, 1.0, 0.5]);
    assert_eq!(read.metadata, Metadata::default());
}

#[test]
fn png_holds_the_tone_mapped_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.png");
    let pixels = vec![[0.0, 0.5, 1.0], [0.1, -1.0, f32::NAN]];
    let picture = Picture::new(2, 1, pixels).unwrap();
    let tone = |gamut| ToneMap { scale: 1.0, gamut };
    let report = write_png(&path, &picture, tone(GamutMapping::Clip)).unwrap();
    let image = image::open(&path).unwrap().into_rgb8();
    // [Iec61966]: sRGB of 0.5 is 0.7354 -> 188; of 0.1 is 0.3492 -> 89
    assert_eq!(image.into_raw(), [0, 188, 255, 89, 0, 0]);
    assert_eq!((report.outside, report.of), (1, 2));
    assert!((report.worst + 1.0).abs() < 1e-6, "{report:?}");
}

#[test]
fn colours_out_of_gamut_are_shown_as_the_name_says() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.png");
    let red = [0.5, -0.05, 0.01];
    let picture = Picture::new(2, 1, vec![red, [0.2; 3]]).unwrap();
    let mut shown = Vec::new();
    for gamut in [GamutMapping::Clip, GamutMapping::Desaturate] {
        let report = write_png(&path, &picture, ToneMap { scale: 1.0, gamut }).unwrap();
        assert_eq!((report.outside, report.of), (1, 2), "{gamut:?}");
        assert!((report.worst + 0.1).abs() < 1e-6, "{report:?}");
        let bytes = image::open(&path).unwrap().into_rgb8().into_raw();
        let expected = gamut.apply(red.map(f64::from)).map(|v| to_srgb8(v as f32));
        assert_eq!(bytes[..3], expected, "{gamut:?}");
        shown.push(bytes);
    }
    assert_eq!(shown[0][3..], shown[1][3..], "grey is left alone");
    assert!(shown[0][..3] != shown[1][..3], "two mappings");
    // the film is never clipped
    let exr = folder.path().join("out.exr");
    write_exr(&exr, &picture).unwrap();
    assert_eq!(read_exr(&exr).unwrap().pixels[0], red);
}

#[test]
fn the_srgb_curve_meets_its_ends_and_never_falls() {
    assert_eq!((to_srgb8(0.0), to_srgb8(1.0), to_srgb8(7.0)), (0, 255, 255));
    let codes: Vec<u8> = (0..=1000).map(|k| to_srgb8(k as f32 / 1000.0)).collect();
    assert!(codes.is_sorted(), "not monotone");
}

#[test]
fn automatic_exposure_puts_the_90th_percentile_at_080() {
    let mut pixels: Vec<[f32; 3]> = (1..=100).map(|k| [k as f32; 3]).collect();
    pixels.extend([[0.0; 3]; 50]);
    let picture = Picture::new(150, 1, pixels).unwrap();
    let scale = f64::from(ToneMap::auto(&picture).scale);
    // rank 90 of 1 ... 100 is 91; the luminance weights sum to 1
    assert!((scale - 0.8 / 91.0).abs() < 1e-6, "{scale}");
    let black = Picture::new(1, 1, vec![[0.0; 3]]).unwrap();
    assert!((ToneMap::auto(&black).scale - 1.0).abs() < 1e-6, "black");
}

#[test]
fn metrics_follow_their_definitions() {
    // a - b = (1, -1, 0) in every channel of three pixels, b = (1, 2, 3)
    let a = Picture::new(3, 1, vec![[2.0; 3], [1.0; 3], [3.0; 3]]).unwrap();
    let b = Picture::new(3, 1, vec![[1.0; 3], [2.0; 3], [3.0; 3]]).unwrap();
    let m = compare(&a, &b).unwrap();
    let near = |x: f64, y: f64| (x - y).abs() < 1e-12;
    assert!(near(m.rmse, (2.0_f64 / 3.0).sqrt()), "{m:?}");
    assert!(near(m.mae, 2.0 / 3.0), "{m:?}");
    assert!(near(m.rel_rmse, (2.0_f64 / 14.0).sqrt()), "{m:?}");
    let floor = 0.02 * 0.02;
    let rel_mse = (1.0 / (1.0 + floor) + 1.0 / (4.0 + floor)) / 3.0;
    assert!(near(m.rel_mse, rel_mse), "{m:?}");
    assert!(near(m.mean_a, 2.0) && near(m.mean_b, 2.0), "{m:?}");
    assert_eq!((m.z, m.not_finite), (None, 0));
}

#[test]
fn z_is_the_difference_in_standard_errors() {
    let with = |value: f32, variance: f32| Picture {
        variance: Some(vec![[variance; 3]; 4]),
        ..Picture::new(2, 2, vec![[value; 3]; 4]).unwrap()
    };
    let m = compare(&with(3.0, 0.75), &with(1.0, 0.25)).unwrap();
    let z = m.z.unwrap();
    assert_eq!(z.count, 12);
    let near = |x: f64, y: f64| (x - y).abs() < 1e-12;
    assert!(near(z.mean, 2.0) && near(z.mean_square, 4.0), "{z:?}");
    assert!(near(z.of_means, 24.0 / 12.0_f64.sqrt()), "{z:?}");
    assert!(near(z.share_above_3, 0.0) && near(z.max_abs, 2.0), "{z:?}");
}

#[test]
fn pixels_that_are_not_finite_are_counted_and_left_out() {
    let a = Picture::new(2, 1, vec![[f32::NAN; 3], [1.0; 3]]).unwrap();
    let b = Picture::new(2, 1, vec![[1.0; 3], [1.0; 3]]).unwrap();
    let m = compare(&a, &b).unwrap();
    assert_eq!(m.not_finite, 3);
    assert!(m.rmse.abs() == 0.0, "{m:?}");
    let wide = Picture::new(1, 2, vec![[1.0; 3], [1.0; 3]]).unwrap();
    assert_eq!(
        compare(&a, &wide).unwrap_err().to_string(),
        "expected pictures of one size, found 2 x 1 and 1 x 2"
    );
}
