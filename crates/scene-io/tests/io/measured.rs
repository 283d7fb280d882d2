//! Measured files under every interpolation and policy.

use brdf::{Brdf, Measured, Projected, direction};
use brdf_formats::{AstmFile, Channels, MerlFile};
use brdf_table::{BeyondPolicy, GapPolicy, NegativePolicy};
use glam::DVec3;
use scene_io::material::{
    Detail, LoadedMeasured, MaterialOptions, Surface, identify, load_measured, material_rgb,
};
use scene_io::scene::{
    BeyondName, ColourChoice, GapName, InterpolationName, NegativeName, SamplerName,
};
use scene_io::{Cache, Overrides, Places, SceneFile, build_scene, write};
use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// Incidences, viewing angles and azimuths of the synthetic file, degrees; none at the pole.
const GRID: [&[f64]; 3] = [
    &[10.0, 25.0, 40.0, 55.0],
    &[8.0, 24.0, 48.0, 66.0],
    &[20.0, 70.0, 120.0, 175.0],
];

/// The directions of all rows, radians.
fn angles() -> impl Iterator<Item = [f64; 3]> {
    let along = |k: usize| GRID[k].iter().map(|a| a.to_radians());
    along(0).flat_map(move |i| along(1).flat_map(move |o| along(2).map(move |p| [i, o, p])))
}

/// What falls off from the mirror direction.
fn lobe([theta_i, theta_o, phi]: [f64; 3]) -> f64 {
    let half = direction(theta_i, 0.0) + direction(theta_o, phi);
    half.normalize().z.powi(20)
}

fn negative_blues() -> usize {
    angles().filter(|&a| lobe(a) < 0.02).count()
}

/// 64 rows of a glossy material whose blue is negative away from the mirror direction.
fn rows() -> (TempDir, PathBuf) {
    let mut rows = Vec::new();
    for [i, o, p] in angles() {
        let lobe = lobe([i, o, p]);
        rows.extend([i, 0.0, o, p, 0.2 + lobe, 0.1 + lobe, lobe - 0.02]);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rows.astm");
    let file = AstmFile::new(&[("SAMPLE_NAME", "made up")], Channels::Rgb, rows).unwrap();
    write::bytes(&path, &file.to_bytes()).unwrap();
    (folder, path)
}

fn with(interpolation: InterpolationName) -> MaterialOptions {
    MaterialOptions {
        interpolation,
        ..MaterialOptions::default()
    }
}

fn native(loaded: &LoadedMeasured, wi: DVec3, wo: DVec3) -> [f64; 3] {
    let mut out = [0.0; 3];
    loaded.measured.eval_native(wi, wo, &mut out);
    out
}

/// Pairs of directions in no special relation to the rows.
fn pairs() -> impl Iterator<Item = (DVec3, DVec3)> {
    (0..400).map(|k| {
        let u = |s: f64| (0.5 + s * f64::from(k)).fract();
        (
            direction(1.5 * u(0.819), 0.0),
            direction(1.5 * u(0.671), PI * u(0.55)),
        )
    })
}

#[test]
fn every_interpolation_of_rows_is_reachable_and_returns_the_rows() {
    let (_folder, path) = rows();
    let (wi, wo) = (
        direction(40.0_f64.to_radians(), 0.0),
        direction(24.0_f64.to_radians(), 70.0_f64.to_radians()),
    );
    let lobe = (wi + wo).normalize().z.powi(20);
    let mut between = Vec::new();
    for &name in InterpolationName::ALL {
        let loaded = load_measured(&path, &with(name)).unwrap_or_else(|e| panic!("{name}: {e}"));
        let found = native(&loaded, wi, wo);
        let expected = [0.2 + lobe, 0.1 + lobe, lobe - 0.02];
        for (f, e) in found.iter().zip(expected) {
            // angles and values have six decimals in the file
            assert!((f - e).abs() < 1e-4, "{name}: {found:?}, not {expected:?}");
        }
        let middle = native(&loaded, direction(0.6, 0.0), direction(0.6, 1.9));
        between.push((name, middle));
    }
    for (k, (a, x)) in between.iter().enumerate() {
        for (b, y) in &between[..k] {
            let same = [*a, *b]
                .map(|n| matches!(n, InterpolationName::Auto | InterpolationName::ThinPlate))
                == [true; 2];
            let nearest = [*a, *b]
                .map(|n| matches!(n, InterpolationName::Nearest | InterpolationName::KdNearest))
                == [true; 2];
            // the two nearest rows may be one
            assert!(nearest || (x == y) == same, "{a} and {b}: {x:?} and {y:?}");
        }
    }
}

#[test]
fn negative_values_are_kept_or_clamped_by_every_interpolation() {
    let (_folder, path) = rows();
    for &interpolation in InterpolationName::ALL {
        let least = |negatives| {
            let options = MaterialOptions {
                negatives,
                ..with(interpolation)
            };
            let loaded = load_measured(&path, &options).unwrap();
            pairs()
                .flat_map(|(wi, wo)| native(&loaded, wi, wo))
                .fold(f64::INFINITY, f64::min)
        };
        assert!(least(NegativeName::Keep) < 0.0, "{interpolation} keeps");
        assert!(least(NegativeName::Auto) < 0.0, "{interpolation} keeps");
        assert!(least(NegativeName::Clamp) >= 0.0, "{interpolation} clamps");
    }
}

#[test]
fn policies_reach_the_thin_plate_and_are_refused_elsewhere() {
    let (folder, path) = rows();
    let options = MaterialOptions {
        gap: Some(GapName::Nearest),
        beyond: Some(BeyondName::Nearest),
        negatives: NegativeName::Clamp,
        ..MaterialOptions::default()
    };
    let loaded = load_measured(&path, &options).unwrap();
    let Detail::Scattered { fill, .. } = &loaded.detail else {
        panic!("{loaded:?}");
    };
    assert_eq!(
        (
            fill.policies.gap,
            fill.policies.beyond,
            fill.policies.negative
        ),
        (
            GapPolicy::Nearest,
            BeyondPolicy::Nearest,
            NegativePolicy::Clamp
        )
    );
    load_measured(
        &path,
        &MaterialOptions {
            interpolation: InterpolationName::Linear,
            ..options
        },
    )
    .unwrap();

    let error = |path: &Path, options| load_measured(path, &options).unwrap_err().to_string();
    let extend = MaterialOptions {
        gap: Some(GapName::Extend),
        ..with(InterpolationName::SquaredLambda)
    };
    let text = error(&path, extend);
    let expected = "gap: expected \"nearest\", all that \"squared-lambda\" interpolation can do, found \"extend\"";
    assert!(text.ends_with(expected), "{text}");
    let schlick = MaterialOptions {
        beyond: Some(BeyondName::Schlick),
        ..with(InterpolationName::KdNearest)
    };
    let text = error(&path, schlick);
    assert!(text.contains("beyond: expected \"nearest\""), "{text}");

    let grid = folder.path().join("grid.binary");
    let file = MerlFile::from_fn([6, 6, 12], |_, _| 1.0).unwrap();
    write::bytes(&grid, &file.to_bytes()).unwrap();
    let beyond = MaterialOptions {
        beyond: Some(BeyondName::Nearest),
        ..MaterialOptions::default()
    };
    let text = error(&grid, beyond);
    let expected =
        "beyond: expected scattered measurements for this policy (\"nearest\"), found a grid";
    assert!(text.ends_with(expected), "{text}");
    let text = error(&grid, with(InterpolationName::LayeredLog));
    assert!(text.ends_with("found \"layered-log\""), "{text}");
}

#[test]
fn the_azimuths_of_a_grid_are_a_full_turn_if_they_are_four_times_the_elevations() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grid.binary");
    for (dims, reciprocal) in [
        ([6, 6, 12], true),
        ([6, 6, 24], false),
        ([90, 45, 180], false),
        ([6, 100, 200], true),
    ] {
        let file = MerlFile::from_fn(dims, |_, _| 1.0).unwrap();
        write::bytes(&path, &file.to_bytes()).unwrap();
        let loaded = load_measured(&path, &MaterialOptions::default()).unwrap();
        assert_eq!(
            loaded.measured.symmetry().reciprocal,
            reciprocal,
            "{dims:?}"
        );
        let identity = identify(&path, &ColourChoice::default()).unwrap();
        assert_eq!(identity.reciprocal, reciprocal, "{dims:?}");
        let Detail::Grid { dims: found, .. } = identity.detail else {
            panic!("{identity:?}");
        };
        assert_eq!(found, dims.map(|n| n as usize));
    }
}

#[test]
fn the_older_schemes_are_rendered_as_they_answer() {
    let (_folder, path) = rows();
    for name in [
        InterpolationName::Nearest,
        InterpolationName::KdNearest,
        InterpolationName::SquaredLambda,
    ] {
        let options = MaterialOptions {
            sampler: SamplerName::Cosine,
            ..with(name)
        };
        let loaded = load_measured(&path, &options).unwrap();
        let matrix = loaded.measured.basis().to_linear_srgb();
        let exact = Projected::new(Arc::clone(&loaded.measured), matrix).unwrap();
        let surface = Surface::of_file(&loaded, &options, &Cache::default()).unwrap();
        for (wi, wo) in pairs() {
            assert_eq!(surface.brdf().eval(wi, wo), exact.eval(wi, wo), "{name}");
        }
        let (_, report) = material_rgb(&loaded, &options, &Cache::default()).unwrap();
        let expected = format!("64 rows, {} negative values", negative_blues());
        assert_eq!(report.notes[0], expected, "{name}");
    }
}

#[test]
fn what_the_thin_plate_filled_is_in_the_report_of_the_material() {
    let (_folder, path) = rows();
    let options = MaterialOptions {
        sampler: SamplerName::Cosine,
        ..MaterialOptions::default()
    };
    let loaded = load_measured(&path, &options).unwrap();
    let (_, report) = material_rgb(&loaded, &options, &Cache::default()).unwrap();
    let notes = report.notes.join("\n");
    for part in ["policies: negatives Keep", "largest albedo", "RMS error"] {
        assert!(notes.contains(part), "{part} is not in: {notes}");
    }
    assert!(!loaded.notes().is_empty(), "nothing to report");
}

#[test]
fn a_file_is_identified_without_an_interpolant() {
    let (_folder, path) = rows();
    let identity = identify(&path, &ColourChoice::default()).unwrap();
    assert_eq!((identity.format.name, identity.basis.len()), ("astm", 3));
    assert!(!identity.reciprocal, "rows are not reciprocal");
    let Detail::Rows {
        rows,
        negative_values,
    } = identity.detail
    else {
        panic!("{identity:?}");
    };
    assert_eq!((rows, negative_values), (64, negative_blues()));
    let missing = identify(Path::new("missing.astm"), &ColourChoice::default())
        .unwrap_err()
        .to_string();
    assert!(missing.starts_with("missing.astm: "), "{missing}");
}

#[test]
fn scenes_choose_policies_and_roulette() {
    let (_folder, path) = rows();
    let text = format!(
        r#"(
        camera: (position: (0, 0, 5), target: (0, 0, 0)),
        render: (roulette: 3),
        materials: {{ "a": File(path: {path:?}, interpolation: "kd-nearest", gap: "nearest", beyond: "nearest") }},
        shapes: [(form: Sphere(center: (0, 0, 0), radius: 1), material: "a")],
    )"#
    );
    let scene = SceneFile::from_text(&text, Path::new(""), Path::new("")).unwrap();
    let built = build_scene(scene, &Overrides::default(), &Places::default());
    let built = built.unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(built.settings.roulette, Some(3));
    let text = text.replace("beyond: \"nearest\"", "beyond: \"schlick\"");
    let scene = SceneFile::from_text(&text, Path::new(""), Path::new("")).unwrap();
    let error = build_scene(scene, &Overrides::default(), &Places::default()).unwrap_err();
    assert!(error.to_string().contains("beyond"), "{error}");
    let text = text.replace("roulette: 3", "seed: 1");
    let scene = SceneFile::from_text(&text, Path::new(""), Path::new("")).unwrap();
    assert_eq!(scene.render.roulette, None);
}

#[test]
fn the_grid_of_a_thin_plate_is_kept_and_rebuilt_if_damaged() {
    let (folder, path) = rows();
    let cache = Cache::at(folder.path().join("cache"));
    let options = MaterialOptions::default();
    let loaded = load_measured(&path, &options).unwrap();
    let notes = |cache: &Cache| {
        let surface = Surface::of_file(&loaded, &options, cache).unwrap();
        let values: Vec<_> = pairs().map(|(i, o)| surface.brdf().eval(i, o)).collect();
        let (_, report) = surface.material(SamplerName::Cosine, cache).unwrap();
        (values, report.notes)
    };
    let fresh = notes(&Cache::default());
    assert_eq!(notes(&cache), fresh, "when built");
    let entries = std::fs::read_dir(folder.path().join("cache")).unwrap();
    let files: Vec<PathBuf> = entries.map(|e| e.unwrap().path()).collect();
    assert_eq!(files.len(), 1, "{files:?}");
    let mut bytes = scene_io::load::bytes(&files[0], 1 << 26).unwrap();
    assert_eq!(notes(&cache), fresh, "from the cache");
    bytes[5000] ^= 4;
    write::bytes(&files[0], &bytes).unwrap();
    let (values, said) = notes(&cache);
    assert_eq!(values, fresh.0, "rebuilt");
    assert!(said.iter().any(|n| n.contains("checksum")), "{said:?}");
    assert_eq!(notes(&cache), fresh, "and kept again");
}
