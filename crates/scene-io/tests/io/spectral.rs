//! Scenes in every spectral mode: what must agree, what must differ, what must not change a bit.

use scene_io::image::{
    Picture, SpectralPicture, read_exr, read_spectral_exr, write_exr, write_spectral_exr,
};
use scene_io::scene::SpectrumName;
use scene_io::spectral::{AnyFilm, AnyScene};
use scene_io::{BuiltScene, Overrides, Places, SceneFile, build_any_scene, write};
use spectrum::{Basis, Illuminant, Observer, Outside, Spectrum, Viewing, matrix};
use std::num::NonZeroUsize;
use std::path::Path;

fn built(text: &str, name: SpectrumName) -> BuiltScene<AnyScene> {
    let scene = SceneFile::from_text(text, Path::new("test"), Path::new("")).unwrap();
    let overrides = Overrides {
        spectrum: Some(name),
        ..Overrides::default()
    };
    build_any_scene(scene, &overrides, &Places::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn film(text: &str, name: SpectrumName, threads: usize) -> AnyFilm {
    let mut built = built(text, name);
    built.settings.threads = NonZeroUsize::new(threads);
    let mut film = built.scene.film([built.size.0, built.size.1], 8);
    let settings = &built.settings;
    built.scene.render(settings, &mut film, &()).unwrap();
    film
}

/// Colours, a coloured lamp, a fluorescent point light, a measured model and a mixture.
const STILL: &str = r#"(
    camera: (position: (0, 2, 6), target: (0, 1, 0), fov_y_deg: 35),
    film: (width: 24, height: 18),
    render: (spp: 32, depth: 3),
    main_material: "glossy",
    materials: {
        "glossy": Model(model: "ggx:alpha=0.3,f0=0.9/0.5/0.2"),
        "green": Lambert(reflectance: (0.1, 0.6, 0.2)),
        "steps": Lambert(reflectance: 0.9, spectrum: [(450, 0.2), (550, 0.9), (650, 0.4)]),
    },
    shapes: [
        (form: Sphere(center: (-0.7, 1, 0), radius: 0.8), material: "glossy"),
        (form: Sphere(center: (1.0, 0.8, 0), radius: 0.7), material: "steps"),
        (form: Quad(corner: (-9, 0, 9), edge_u: (18, 0, 0), edge_v: (0, 0, -18)), material: "green"),
        (form: Sphere(center: (0, 4, 1), radius: 0.5), material: "green", emission: (6, 5, 3)),
    ],
    lights: [
        Constant(radiance: 0.3, spectrum: Illuminant("A")),
        Point(position: (2, 3, 3), intensity: 4, spectrum: Blackbody(5000)),
    ],
)"#;

#[test]
fn threads_change_no_bit_in_any_mode() {
    for &name in SpectrumName::ALL {
        let (one, two) = (film(STILL, name, 1), film(STILL, name, 2));
        assert!(*one.rgb() == *two.rgb(), "{name}");
        assert!(one.spectral() == two.spectral(), "{name}");
    }
}

#[test]
fn modes_agree_on_the_picture_as_far_as_they_can() {
    let reference = Picture::of_film(&film(STILL, SpectrumName::Hero, 2).rgb()).unwrap();
    // what is lost: 8 bins of three lights and five surfaces, then 16, 45 and 65 (whose ends are at 400 and 720 nm)
    let bounds = [
        (SpectrumName::Eight, 0.03),
        (SpectrumName::Sixteen, 0.012),
        (SpectrumName::FortyFive, 0.006),
        (SpectrumName::Native, 0.006),
    ];
    for (name, bound) in bounds {
        let picture = Picture::of_film(&film(STILL, name, 2).rgb()).unwrap();
        let metrics = scene_io::compare(&picture, &reference).unwrap();
        assert!(metrics.rel_rmse < bound, "{name}: {}", metrics.rel_rmse);
        assert!(metrics.rel_rmse > 0.0, "{name} is the reference");
    }
}

/// A table of light power or reflectance in RON.
fn rows(nm: &[f64], values: &[f64]) -> String {
    let pairs: Vec<String> = nm
        .iter()
        .zip(values)
        .map(|(l, v)| format!("({l}, {v})"))
        .collect();
    format!("[{}]", pairs.join(", "))
}

/// Two reflectances at 31 bands that look alike under D65: the second is the first and a bump less what is seen of it.
fn metamers() -> (Vec<f64>, [Vec<f64>; 2]) {
    let nm: Vec<f64> = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
    let weights = Basis::Bands(nm.clone()).xyz_weights(&Viewing::standard());
    let bump: Vec<f64> = nm
        .iter()
        .map(|l| (-((l - 570.0) / 25.0_f64).powi(2)).exp())
        .collect();
    // the part of the bump in the span of the three weights: w (w^T w)^-1 w^T bump
    let gram: [[f64; 3]; 3] =
        std::array::from_fn(|i| std::array::from_fn(|j| weights.iter().map(|w| w[i] * w[j]).sum()));
    let seen: [f64; 3] =
        std::array::from_fn(|c| weights.iter().zip(&bump).map(|(w, b)| w[c] * b).sum());
    let parts = matrix::transform(&matrix::inverse(&gram).unwrap(), seen);
    let black: Vec<f64> = (bump.iter().zip(&weights))
        .map(|(b, w)| b - (0..3).map(|c| parts[c] * w[c]).sum::<f64>())
        .collect();
    let first: Vec<f64> = nm
        .iter()
        .map(|l| 0.4 + 0.15 * ((l - 500.0) / 60.0).sin())
        .collect();
    let second = first.iter().zip(&black).map(|(a, b)| a + 0.3 * b).collect();
    (nm, [first, second])
}

/// Two squares that fill the picture, left and right, in even light.
fn pair(light: &str) -> String {
    let (nm, [a, b]) = metamers();
    let quad =
        |x: f64| format!("Quad(corner: ({x}, -5, 0), edge_u: (5, 0, 0), edge_v: (0, 10, 0))");
    format!(
        r#"(
    camera: (position: (0, 0, 3), target: (0, 0, 0), fov_y_deg: 40),
    film: (width: 2, height: 1), render: (spp: 512, depth: 1),
    materials: {{
        "a": Lambert(reflectance: 1, spectrum: {}),
        "b": Lambert(reflectance: 1, spectrum: {}),
    }},
    shapes: [(form: {}, material: "a"), (form: {}, material: "b")],
    lights: [Constant(radiance: 1, spectrum: Illuminant("{light}"))],
)"#,
        rows(&nm, &a),
        rows(&nm, &b),
        quad(-5.0),
        quad(0.0)
    )
}

#[test]
fn metamers_part_under_another_light_as_theory_says() {
    let (nm, reflectances) = metamers();
    let matrix = spectrum::table_srgb_from_xyz(&Viewing::standard());
    let theory = |light: Illuminant| {
        let viewing = Viewing::new(&light.spectrum(), &Observer::CIE_1931);
        let seen = |r: &Vec<f64>| {
            let s = Spectrum::new(nm.clone(), r.clone(), Outside::Hold).unwrap();
            matrix::transform(&matrix, viewing.xyz(&s))
        };
        [seen(&reflectances[0]), seen(&reflectances[1])]
    };
    for light in [Illuminant::D65, Illuminant::A] {
        let exact = theory(light);
        let apart = exact[0]
            .iter()
            .zip(exact[1])
            .map(|(a, b)| (a - b).abs())
            .fold(0.0, f64::max);
        match light {
            Illuminant::D65 => assert!(apart < 1e-12, "metamers: {apart}"),
            _ => assert!(apart > 0.02, "under {light} they differ: {apart}"),
        }
        // exact integrals of 45 bins of 6 nm over bands of 10 nm; 512 bins of 1 nm, each met as often; linear in RGB
        for (name, bound) in [(SpectrumName::FortyFive, 1e-3), (SpectrumName::Hero, 1e-4)] {
            let pixels = film(&pair(&light.to_string()), name, 1).rgb().mean();
            for (seen, exact) in pixels.iter().zip(&exact) {
                for c in 0..3 {
                    let error = (seen[c] - exact[c]).abs();
                    assert!(
                        error < bound,
                        "{light} in {name}: {seen:?}, theory {exact:?}"
                    );
                }
            }
        }
        // red, green and blue alone cannot tell them apart
        let [a, b]: [[f64; 3]; 2] = film(&pair(&light.to_string()), SpectrumName::Rgb, 1)
            .rgb()
            .mean()
            .try_into()
            .unwrap();
        assert!((0..3).all(|c| (a[c] - b[c]).abs() < 1e-6), "{a:?}, {b:?}");
    }
}

/// A wall of one colour that fills the picture, in even white light.
fn wall(material: &str, render: &str) -> String {
    format!(
        r#"(
    camera: (position: (0, 0, 3), target: (0, 0, 0), fov_y_deg: 40),
    film: (width: 2, height: 1), render: (spp: 512, depth: 1, {render}),
    materials: {{ "wall": {material}, "part": Lambert(reflectance: (0.8, 0.1, 0.3)), "other": Lambert(reflectance: (0.0, 0.9, 0.5)) }},
    shapes: [(form: Quad(corner: (-5, -5, 0), edge_u: (10, 0, 0), edge_v: (0, 10, 0)), material: "wall")],
    lights: [Constant(radiance: 1)],
)"#
    )
}

/// The colour of the wall, linear sRGB.
fn seen(material: &str, name: SpectrumName) -> [f64; 3] {
    film(&wall(material, ""), name, 1).rgb().mean()[0]
}

#[test]
fn colours_of_a_scene_come_back_in_every_mode() {
    for [r, g, b] in [
        [0.02, 0.7, 0.05],
        [0.9, 0.03, 0.1],
        [0.0, 0.0, 1.0],
        [1.0, 1.0, 0.0],
        [0.18, 0.18, 0.18],
    ] {
        let material = format!("Lambert(reflectance: ({r}, {g}, {b}))");
        // what bins lose in one reflection: [JakobHanika2019] is met to 1e-9 by the spectrum itself, XYZ by the film
        for (name, bound) in [
            (SpectrumName::Rgb, 1e-6),
            (SpectrumName::Xyz, 2e-6),
            (SpectrumName::Eight, 0.06),
            (SpectrumName::Sixteen, 0.02),
            (SpectrumName::FortyFive, 2e-3),
            (SpectrumName::Native, 2e-3),
            (SpectrumName::Hero, 3e-4),
        ] {
            let found = seen(&material, name);
            for (f, e) in found.iter().zip([r, g, b]) {
                assert!((f - e).abs() < bound, "{material} in {name}: {found:?}");
            }
        }
    }
}

#[test]
fn flat_colours_are_smooth_spectra_and_mixtures_are_linear() {
    // reflected twice between walls a colour shows its spectrum: the sigmoid of a green is not the linear basis'
    let [green, linear] = [
        spectrum::SigmoidFitter::new()
            .fit([0.1, 0.6, 0.2])
            .sigmoid
            .spectrum(),
        spectrum::LinearUplift::spectrum([0.1, 0.6, 0.2]),
    ];
    let spectral = |material: &str| {
        let film = film(
            &wall(material, "range_nm: (400, 700)"),
            SpectrumName::FortyFive,
            1,
        );
        let film = film.spectral().unwrap();
        let white = self::film(
            &wall("Lambert(reflectance: 1)", "range_nm: (400, 700)"),
            SpectrumName::FortyFive,
            1,
        );
        let white = white.spectral().unwrap();
        let of = |k: usize| f64::from(film.planes[k][0]) / f64::from(white.planes[k][0]);
        (0..45)
            .map(|k| (film.lambda_nm[k], of(k)))
            .collect::<Vec<_>>()
    };
    let found = spectral("Lambert(reflectance: (0.1, 0.6, 0.2))");
    let away = |s: &Spectrum| {
        found
            .iter()
            .map(|(nm, v)| (v - s.at(*nm)).abs())
            .fold(0.0, f64::max)
    };
    assert!(
        away(&green) < 0.02 && away(&linear) > 0.1,
        "{} and {}",
        away(&green),
        away(&linear)
    );
    // half of each: the linear uplift of half the sum
    let mixed = spectral("Mix(parts: [(\"part\", 0.5), (\"other\", 0.5)])");
    let sum = spectrum::LinearUplift::spectrum([0.4, 0.5, 0.4]);
    for (nm, v) in mixed {
        // cells of the grid are f32
        assert!(
            (v - sum.at(nm)).abs() < 0.02,
            "{nm} nm: {v} and {}",
            sum.at(nm)
        );
    }
}

#[test]
fn ranges_and_edges_of_bins_are_what_the_scene_says() {
    let edges = [
        400.0, 430.0, 470.0, 500.0, 540.0, 580.0, 600.0, 640.0, 700.0,
    ];
    let list: Vec<String> = edges.iter().map(f64::to_string).collect();
    let render = format!("edges_nm: [{}], range_nm: (420, 680)", list.join(", "));
    let text = wall("Lambert(reflectance: 0.5)", &render);
    let planes = |name| film(&text, name, 1).spectral().unwrap().edges_nm;
    assert_eq!(planes(SpectrumName::Eight), edges);
    let sixteen = planes(SpectrumName::Sixteen);
    assert_eq!((sixteen[0], sixteen[16], sixteen.len()), (420.0, 680.0, 17));
    // white stays white whatever the bins
    for name in [SpectrumName::Eight, SpectrumName::Sixteen] {
        for v in film(&text, name, 1).rgb().mean()[0] {
            assert!((v - 0.5).abs() < 1e-6, "{name}: {v}");
        }
    }
    for (bad, expected) in [
        (
            "edges_nm: [400, 500]",
            "render.edges_nm: expected 9, 17 or 46 edges for 8, 16 or 45 bins, found 2",
        ),
        (
            "edges_nm: [400, 430, 420, 500, 540, 580, 600, 640, 700]",
            "render.edges_nm: edge 2 (from 0) is 420 nm",
        ),
        (
            "edges_nm: [1]",
            "a wavelength from 100 to 10000 nm, found 1",
        ),
        (
            "range_nm: (700, 400)",
            "render.range_nm: expected two ascending wavelengths",
        ),
    ] {
        let text = wall("Lambert(reflectance: 0.5)", bad);
        let error = SceneFile::from_text(&text, Path::new("s"), Path::new(""))
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{bad}: {error}");
    }
}

#[test]
fn hero_is_as_even_under_lines_as_under_daylight() {
    let noise = |light: &str| {
        let text = wall("Lambert(reflectance: (0.7, 0.4, 0.2))", "")
            .replace(
                "radiance: 1",
                &format!("radiance: 1, spectrum: Illuminant(\"{light}\")"),
            )
            .replace("spp: 512", "spp: 128");
        film(&text, SpectrumName::Hero, 1)
            .rgb()
            .estimate(0.95)
            .rel_rmse
    };
    let [even, lines] = [noise("D65"), noise("F11")];
    // 16 samples a replicate: what wavelengths leave of noise, path noise being none on an even wall
    println!("D65 {even:.2e}, F11 {lines:.2e}");
    assert!(lines < 0.01, "{lines}, D65: {even}");
}

#[test]
fn spectral_pictures_come_back_bit_by_bit() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.exr");
    for (name, planes) in [
        (SpectrumName::Eight, 8),
        (SpectrumName::FortyFive, 45),
        (SpectrumName::Native, 65),
    ] {
        let film = film(STILL, name, 2);
        let spectral = film.spectral().unwrap();
        let picture = Picture::of_film(&film.rgb()).unwrap();
        write_spectral_exr(&path, &picture, &spectral).unwrap();
        let back = read_spectral_exr(&path).unwrap();
        assert_eq!(back.planes.len(), planes);
        assert!(back == spectral, "{name}: planes differ");
        assert_eq!(read_exr(&path).unwrap(), picture);
        let edges = if name == SpectrumName::Native {
            0
        } else {
            planes + 1
        };
        assert_eq!(back.edges_nm.len(), edges);
    }
    assert!(film(STILL, SpectrumName::Hero, 1).spectral().is_none());
}

#[test]
fn planes_add_up_to_the_luminance_of_the_picture() {
    // equal energy and greys: no bin varies
    let text = r#"(
    camera: (position: (0, 0, 3), target: (0, 0, 0)),
    film: (width: 2, height: 2), render: (spp: 8, depth: 1),
    lights: [Constant(radiance: 2, spectrum: Illuminant("E"))],
)"#;
    let film = film(text, SpectrumName::FortyFive, 1);
    let spectral = film.spectral().unwrap();
    let y = Observer::CIE_1931.spectra()[1].clone();
    let sum: f64 = (spectral.edges_nm.windows(2).zip(&spectral.planes))
        .map(|(edges, plane)| f64::from(plane[0]) * y.integral([edges[0], edges[1]]))
        .sum();
    // beyond 410 and 690 nm lies 0.5 % of y
    assert!((sum / 2.0 - 1.0).abs() < 0.01, "{sum}");
}

#[test]
fn pictures_that_are_not_spectral_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rgb.exr");
    let picture = Picture::new(2, 1, vec![[0.0; 3]; 2]).unwrap();
    write_exr(&path, &picture).unwrap();
    let error = read_spectral_exr(&path).unwrap_err().to_string();
    assert!(
        error.ends_with("expected channels named like S0.550nm, found none"),
        "{error}"
    );
    write::bytes(&path, b"no picture").unwrap();
    assert!(read_spectral_exr(&path).is_err());
    let wrong = SpectralPicture {
        width: 2,
        height: 1,
        lambda_nm: vec![550.0, 500.0],
        edges_nm: vec![],
        planes: vec![vec![0.0; 2]; 2],
    };
    let error = write_spectral_exr(&path, &picture, &wrong)
        .unwrap_err()
        .to_string();
    assert!(
        error.ends_with("expected ascending wavelengths, found others"),
        "{error}"
    );
}

#[test]
fn a_film_of_another_mode_is_refused() {
    let scene = built(STILL, SpectrumName::Eight);
    let mut other = film(STILL, SpectrumName::Sixteen, 1);
    let error = scene.scene.render(&scene.settings, &mut other, &());
    assert!(error.is_err(), "8 bins on a film of 16");
}

#[test]
fn wrong_spectra_are_refused_where_they_stand() {
    let message = |light: &str| {
        let text = format!(
            "(camera: (position: (0, 0, 3), target: (0, 0, 0)), lights: [Constant({light})])"
        );
        SceneFile::from_text(&text, Path::new("s"), Path::new(""))
            .unwrap_err()
            .to_string()
    };
    for (light, expected) in [
        (
            "radiance: (1, 2, 3), spectrum: Illuminant(\"A\")",
            "lights[0].spectrum: expected one number for the brightness of a spectrum, found (1, 2, 3)",
        ),
        (
            "radiance: 1, spectrum: Table([(500, 1), (400, 1)])",
            "lights[0].spectrum: knot 1 (from 0): 400 nm comes after a longer wavelength",
        ),
        (
            "radiance: 1, spectrum: Table([(500, 0)])",
            "lights[0].spectrum: expected power between 360 and 830 nm, found a spectrum of no luminance",
        ),
        (
            "radiance: 1, spectrum: Blackbody(3)",
            "expected a temperature from 500 to 100000 K, found 3",
        ),
    ] {
        let found = message(light);
        assert!(found.contains(expected), "{light}: {found}");
    }
    assert!(message("radiance: 1, spectrum: Illuminant(\"D66\")").contains("D66"));
}

#[test]
fn metals_have_the_index_of_every_channel() {
    // a mirror of gold and one that reflects everything, in the same light: their ratio is the reflectance
    let scene = |material: &str| {
        format!(
            r#"(
    camera: (position: (0, 0, 4), target: (0, 0, 0), fov_y_deg: 5),
    film: (width: 8, height: 8),
    render: (spp: 64, depth: 2),
    main_material: "metal",
    materials: {{ "metal": Model(model: "{material}") }},
    shapes: [(form: Quad(corner: (-1, -1, 0), edge_u: (2, 0, 0), edge_v: (0, 2, 0)), material: "metal")],
    lights: [Constant(radiance: 1)],
)"#
        )
    };
    let mean = |planes: &SpectralPicture, c: usize| -> f64 {
        planes.planes[c].iter().map(|v| f64::from(*v)).sum()
    };
    let gold = brdf_models::Substance::named("au").unwrap();
    for name in [
        SpectrumName::Eight,
        SpectrumName::Sixteen,
        SpectrumName::FortyFive,
    ] {
        let of = |material: &str| film(&scene(material), name, 2).spectral().unwrap();
        let (metal, white) = (of("ggx:alpha=0.02,index=au"), of("ggx:alpha=0.02"));
        let n = white.planes.len();
        for c in 1..n - 1 {
            let found = mean(&metal, c) / mean(&white, c);
            let [from, to] = [metal.edges_nm[c], metal.edges_nm[c + 1]];
            let steps = 64;
            let exact = (0..steps).map(|k| {
                let nm = from + (to - from) * (f64::from(k) + 0.5) / f64::from(steps);
                let [n, k] = gold.at(nm);
                brdf_models::Fresnel::from_index([n], [k]).eval(1.0)[0]
            });
            let exact = exact.sum::<f64>() / f64::from(steps);
            // within 2.5 degrees of the normal; a bin's mean is weighted by what is seen, here it is not
            let tolerance = 2e-3 + 2e-4 * (to - from);
            assert!(
                (found - exact).abs() < tolerance,
                "{name} {c}: {found} {exact}"
            );
        }
    }
    let colour = |name| {
        let rgb = film(&scene("ggx:alpha=0.02,index=cu"), name, 2)
            .rgb()
            .mean();
        let sum: [f64; 3] = std::array::from_fn(|c| rgb.iter().map(|p| p[c]).sum());
        sum.map(|v| v / rgb.len() as f64)
    };
    let rgb = colour(SpectrumName::Rgb);
    for name in [
        SpectrumName::Xyz,
        SpectrumName::Eight,
        SpectrumName::FortyFive,
        SpectrumName::Hero,
    ] {
        let found = colour(name);
        for c in 0..3 {
            // one reflection of daylight: the colour is that of RGB, but for 64 rotations and the width of bins
            let tolerance = if name == SpectrumName::Eight {
                0.02
            } else {
                5e-3
            };
            let off = (found[c] - rgb[c]).abs();
            assert!(off < tolerance, "{name}: {found:?} {rgb:?}");
        }
    }
}
