//! What the numbers of measured files mean: by convention, and as users say instead.

use brdf::{Measured, direction};
use brdf_formats::{AstmFile, Channels, MERL_SCALE, MerlFile};
use scene_io::material::{MaterialOptions, Source, Surface, identify, load_measured};
use scene_io::scene::{ColourChoice, InterpolationName, SpectrumName};
use scene_io::{Cache, DataDirs, Overrides, Places, SceneFile, build_any_scene, write};
use spectrum::{Basis, RgbSpace, matrix};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn choice(primaries: &str, white: &str, scale: &str) -> ColourChoice {
    let some = |text: &str| (!text.is_empty()).then(|| text.to_owned());
    ColourChoice {
        primaries: some(primaries).map(|t| t.parse().unwrap()),
        white: some(white).map(|t| t.parse().unwrap()),
        scale: some(scale).map(|t| t.parse().unwrap()),
    }
}

fn with(colour: ColourChoice) -> MaterialOptions {
    MaterialOptions {
        colour,
        ..MaterialOptions::default()
    }
}

/// A MERL file of one colour, and its numbers.
fn merl() -> (TempDir, PathBuf, [f64; 3]) {
    let numbers = [300.0, 200.0, 100.0];
    let file = MerlFile::from_fn([6, 6, 12], |c, _| numbers[c]).unwrap();
    kept("one.binary", &file.to_bytes(), numbers)
}

/// Cornell rows of one colour.
fn astm() -> (TempDir, PathBuf, [f64; 3]) {
    let numbers = [0.3, 0.2, 0.1];
    let mut rows = Vec::new();
    for i in 1..6 {
        for o in 1..7 {
            for p in 0..7 {
                let [i, o, p] = [0.2 * f64::from(i), 0.2 * f64::from(o), 0.5 * f64::from(p)];
                rows.extend([i, 0.0, o, p]);
                rows.extend(numbers);
            }
        }
    }
    let file = AstmFile::new(&[("SAMPLE_NAME", "made up")], Channels::Rgb, rows).unwrap();
    kept("one.astm", &file.to_bytes(), numbers)
}

fn kept(name: &str, bytes: &[u8], numbers: [f64; 3]) -> (TempDir, PathBuf, [f64; 3]) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    write::bytes(&path, bytes).unwrap();
    (folder, path, numbers)
}

/// f_r in linear sRGB as rendering sees it.
fn seen(path: &Path, options: &MaterialOptions) -> [f64; 3] {
    let loaded = load_measured(path, options).unwrap();
    let surface = Surface::of_file(&loaded, options, &Cache::default()).unwrap();
    let (wi, wo) = (direction(0.4, 0.0), direction(0.6, 1.0));
    let rendered = surface.brdf().eval(wi, wo);
    let mut native = [0.0; 3];
    loaded.measured.eval_native(wi, wo, &mut native);
    let rows = loaded.measured.basis().to_linear_srgb();
    for c in 0..3 {
        let direct: f64 = (0..3).map(|k| native[k] * rows[k][c]).sum();
        assert!(
            (direct - rendered[c]).abs() < 1e-6 * direct.abs().max(1.0),
            "{direct} and {rendered:?}"
        );
    }
    rendered
}

fn close(found: [f64; 3], expected: [f64; 3]) {
    for (f, e) in found.iter().zip(expected) {
        assert!((f - e).abs() < 2e-6, "{found:?} instead of {expected:?}");
    }
}

#[test]
fn a_scale_replaces_that_of_the_format() {
    for (_folder, path, numbers) in [merl(), astm()] {
        let said = with(choice("sRGB", "", "0.001,0.002,0.003"));
        let expected = std::array::from_fn(|c| numbers[c] * [0.001, 0.002, 0.003][c]);
        close(seen(&path, &said), expected);
    }
    // saying what is so changes nothing
    let (_folder, path, _) = merl();
    let [r, g, b] = MERL_SCALE;
    let same = with(choice("sRGB", "D65", &format!("{r},{g},{b}")));
    close(seen(&path, &same), seen(&path, &MaterialOptions::default()));
}

#[test]
fn primaries_and_white_replace_those_of_the_format() {
    for (_folder, path, numbers) in [merl(), astm()] {
        let as_read = with(choice("Rec.2020", "", "0.5"));
        let wide = RgbSpace::rec2020().convert_to(&RgbSpace::srgb()).unwrap();
        let expected = matrix::transform(&wide, numbers.map(|v| 0.5 * v));
        let found = seen(&path, &as_read);
        for (f, e) in found.iter().zip(expected) {
            assert!(
                (f / e - 1.0).abs() < 1e-5,
                "{found:?} instead of {expected:?}"
            );
        }
        // white stays white whichever it is, a colour does not
        let other = seen(&path, &with(choice("Rec.2020", "A", "0.5")));
        assert!(
            (0..3).any(|c| (other[c] / found[c] - 1.0).abs() > 0.01),
            "{other:?}"
        );
    }
}

#[test]
fn every_interpolation_of_rows_reads_them_alike() {
    let (_folder, path, _) = astm();
    let said = choice("ACEScg", "", "2");
    let expected = seen(&path, &with(said));
    for name in [
        InterpolationName::Nearest,
        InterpolationName::Linear,
        InterpolationName::KdNearest,
    ] {
        let options = MaterialOptions {
            interpolation: name,
            ..with(said)
        };
        close(seen(&path, &options), expected);
    }
}

#[test]
fn what_is_in_effect_is_told_with_its_source() {
    let (_folder, path, _) = astm();
    let plain = identify(&path, &ColourChoice::default()).unwrap();
    let meaning = &plain.colour;
    assert_eq!(
        [
            meaning.channels_from,
            meaning.white_from,
            meaning.scale_from
        ],
        [Source::Convention; 3]
    );
    assert!(
        (meaning.scale[0] - RgbSpace::trinitron().white_level.recip()).abs() < 1e-12,
        "{meaning:?}"
    );
    let said = identify(&path, &choice("", "0.33,0.34", "2,3,4")).unwrap();
    let meaning = &said.colour;
    assert_eq!(
        [
            meaning.channels_from,
            meaning.white_from,
            meaning.scale_from
        ],
        [Source::Convention, Source::User, Source::User]
    );
    assert_eq!(meaning.scale, [2.0, 3.0, 4.0]);
    let Basis::Rgb(space) = &said.basis else {
        panic!("{said:?}")
    };
    assert_eq!((space.white, space.white_level), ([0.33, 0.34], 1.0));
    assert_eq!(space.primaries, RgbSpace::trinitron().primaries);
    let named = identify(&path, &choice("ACEScg", "", "")).unwrap();
    assert_eq!(
        named.colour.white_from,
        Source::User,
        "the white of the name"
    );
}

#[test]
fn spectra_take_one_factor_and_no_primaries() {
    let rows = [0.3, 0.0, 0.4, 1.0, 0.1, 0.2, 0.3, 0.4];
    let nm = vec![400.0, 500.0, 600.0, 700.0];
    let all: Vec<f64> = (0..40)
        .flat_map(|k| {
            let mut row = rows;
            row[2] = 0.03 * f64::from(k);
            row
        })
        .collect();
    let file = AstmFile::new(&[], Channels::Wavelengths(nm), all).unwrap();
    let (_folder, path, _) = kept("bands.astm", &file.to_bytes(), [0.0; 3]);
    let error = |colour| identify(&path, &colour).unwrap_err().to_string();
    for (colour, expected) in [
        (
            choice("sRGB", "", ""),
            "primaries: expected an RGB file for other primaries, found 4 bands",
        ),
        (
            choice("", "D50", ""),
            "white: expected an RGB file for other white, found 4 bands",
        ),
        (
            choice("", "", "1,2,3"),
            "scale: expected one factor for 4 bands, found three",
        ),
    ] {
        let found = error(colour);
        assert!(found.contains(expected), "{found}");
    }
    let identity = identify(&path, &choice("", "", "3")).unwrap();
    assert_eq!(identity.colour.scale, [3.0; 4]);
    assert_eq!(identity.colour.channels_from, Source::File);
    let nearest = |colour| MaterialOptions {
        interpolation: InterpolationName::KdNearest,
        ..with(colour)
    };
    let value = |colour| {
        let loaded = load_measured(&path, &nearest(colour)).unwrap();
        let mut out = [0.0; 4];
        loaded
            .measured
            .eval_native(direction(0.3, 0.0), direction(0.4, 1.0), &mut out);
        out
    };
    let (plain, thrice) = (value(ColourChoice::default()), value(choice("", "", "3")));
    for (a, b) in plain.iter().zip(thrice) {
        assert!((3.0 * a - b).abs() < 1e-12, "{plain:?} and {thrice:?}");
    }
}

#[test]
fn primaries_on_a_line_are_refused() {
    let (_folder, path, _) = merl();
    let error = identify(&path, &choice("0.2,0.2,0.3,0.3,0.4,0.4", "", "")).unwrap_err();
    let found = error.to_string();
    assert!(
        found.contains("primaries: expected primaries of which white can be mixed"),
        "{found}"
    );
}

/// What a scene says reaches the picture, and the command line has the last word.
#[test]
fn scenes_say_it_too() {
    let (folder, path, numbers) = merl();
    let name = path.file_name().unwrap().to_string_lossy();
    let text = format!(
        r#"(
    camera: (position: (0, 0, 3), target: (0, 0, 0), fov_y_deg: 40),
    film: (width: 2, height: 2), render: (spp: 64, depth: 1, sampler: "cosine"),
    main_material: "m",
    materials: {{ "m": File(path: "{name}", colour: (primaries: "Rec.2020", white: "E", scale: (0.001, 0.001, 0.001))) }},
    shapes: [(form: Quad(corner: (-5, -5, 0), edge_u: (10, 0, 0), edge_v: (0, 10, 0)), material: "m")],
    lights: [Constant(radiance: 1)],
)"#
    );
    let scene = || SceneFile::from_text(&text, Path::new("s"), folder.path()).unwrap();
    let mean = |overrides: &Overrides| {
        let built = build_any_scene(scene(), overrides, &Places::default()).unwrap();
        let mut film = built.scene.film([2, 2], 8);
        built.scene.render(&built.settings, &mut film, &()).unwrap();
        film.rgb().mean()[0]
    };
    let expected = |space: &RgbSpace, scale: f64| {
        let to = space.convert_to(&RgbSpace::srgb()).unwrap();
        // a constant f_r in even light: its albedo, pi f_r
        matrix::transform(&to, numbers.map(|v| scale * v * std::f64::consts::PI))
    };
    let e = RgbSpace {
        white: [1.0 / 3.0; 2],
        ..RgbSpace::rec2020()
    };
    let near = |found: [f64; 3], expected: [f64; 3]| {
        for (f, e) in found.iter().zip(expected) {
            assert!(
                (f / e - 1.0).abs() < 0.01,
                "{found:?} instead of {expected:?}"
            );
        }
    };
    for spectrum in [
        SpectrumName::Rgb,
        SpectrumName::FortyFive,
        SpectrumName::Hero,
    ] {
        let spectrum = Some(spectrum);
        near(
            mean(&Overrides {
                spectrum,
                ..Overrides::default()
            }),
            expected(&e, 0.001),
        );
        let colour = choice("sRGB", "D65", "0.002");
        near(
            mean(&Overrides {
                spectrum,
                colour,
                ..Overrides::default()
            }),
            expected(&RgbSpace::srgb(), 0.002),
        );
    }
    let bad = text.replace("\"E\"", "\"D66\"");
    let error = SceneFile::from_text(&bad, Path::new("s"), folder.path())
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("expected A, C, D50") && error.contains("found \"D66\""),
        "{error}"
    );
    assert_eq!(error.lines().count(), 1, "{error}");
}

/// Genuine files of both kinds.
#[test]
fn genuine_files_are_read_as_said() {
    let Some(folder) = testkit::data_dir_or_skip() else {
        return;
    };
    let data = DataDirs::new([folder]);
    let path = data
        .find(Path::new("garnet_red_RGB.astm"), Path::new(""))
        .unwrap();
    let options = |colour| MaterialOptions {
        interpolation: InterpolationName::KdNearest,
        ..with(colour)
    };
    let native = |colour| {
        let loaded = load_measured(&path, &options(colour)).unwrap();
        let mut out = [0.0; 3];
        // a row of the file: 0.872665, 0, 0.573513, 0: 0.011364, 0.000779, 0.002329
        loaded
            .measured
            .eval_native(direction(0.872665, 0.0), direction(0.573513, 0.0), &mut out);
        out
    };
    close(
        native(ColourChoice::default()),
        [0.011364, 0.000779, 0.002329],
    );
    close(
        native(choice("Rec.2020", "", "2")),
        [0.022728, 0.001558, 0.004658],
    );
    // level 0.358 is the scale 2.79, to the digits given
    let [by_level, by_scale] =
        [ColourChoice::default(), choice("", "", "2.7913226")].map(|c| seen(&path, &options(c)));
    for (a, b) in by_level.iter().zip(by_scale) {
        assert!((a / b - 1.0).abs() < 1e-6, "{by_level:?} and {by_scale:?}");
    }
}
