//! Genuine files, where `GONIO_DATA` names a folder with them.

use crate::chain::rows_come_back;
use crate::program::{Bench, numbers, repository};
use scene_io::image::{Picture, read_exr};

/// A folder with a copy of a genuine file; `None`, after saying so, if it is not there.
fn with(bench: &Bench, file: &str) -> Option<String> {
    let name = file.rsplit('/').next().unwrap_or(file);
    bench.write(name, testkit::read_data(file)?);
    Some(name.to_owned())
}

#[test]
fn cornell_files_are_described_and_evaluated() {
    let bench = Bench::new();
    for (file, negatives) in [
        ("cornell/garnet_red_RGB.astm", true),
        ("cornell/krylon_blue_RGB.astm", true),
    ] {
        let Some(name) = with(&bench, file) else {
            return;
        };
        let info = bench.json(&format!("info {name}"));
        assert_eq!(
            (&info["format"], &info["dims"]),
            (&"astm".into(), &serde_json::json!([1439]))
        );
        assert_eq!(info["channels"], serde_json::json!(["R", "G", "B"]));
        for scale in numbers(&info["scale"]) {
            assert!((scale * 0.358 - 1.0).abs() < 1e-3, "{scale}");
        }
        assert_eq!(
            numbers(&info["negatives"]).iter().sum::<f64>() > 0.0,
            negatives,
            "{info}"
        );
        assert!(info["header"].to_string().contains("Cornell"), "{info}");
        rows_come_back(&bench, &name, 37);
    }
}

#[test]
fn every_genuine_file_is_plotted() {
    let bench = Bench::new();
    let files = [
        "cornell/garnet_red_RGB.astm",
        "cornell-spectral/krylon_blue.brdf",
        "rgl/paper_white_rgb.bsdf",
    ];
    for file in files {
        let Some(name) = with(&bench, file) else {
            return;
        };
        for log in ["", "--log"] {
            bench.text(&format!("plot {name} --theta-i 45,75,85 {log} -o a.png"));
            assert!(
                bench.read("a.png").len() > 10_000,
                "{file}: an empty picture"
            );
        }
    }
}

/// Sums of the channels over all pixels but those of a background of exactly 1.
fn sums(picture: &Picture) -> [f64; 3] {
    let covered = picture
        .pixels
        .iter()
        .filter(|p| p.iter().any(|v| v.to_bits() != 1_f32.to_bits()));
    let mut sum = [0.0; 3];
    for pixel in covered {
        (0..3).for_each(|c| sum[c] += f64::from(pixel[c]));
    }
    sum
}

/// The RGB and the spectral file of one material give one picture.
#[test]
fn slow_rgb_and_spectral_files_render_alike() {
    let bench = Bench::new();
    for name in ["garnet_red", "krylon_blue"] {
        let rgb = with(&bench, &format!("cornell/{name}_RGB.astm"));
        let spectral = with(&bench, &format!("cornell-spectral/{name}.brdf"));
        let (Some(rgb), Some(spectral)) = (rgb, spectral) else {
            return;
        };
        for scene in ["scenes/white-furnace/scene.ron", "scenes/thesis/base.ron"] {
            let [a, b] =
                [(rgb.as_str(), "a.exr"), (spectral.as_str(), "b.exr")].map(|(file, out)| {
                    let scene = repository(scene);
                    bench.text(&format!(
                        "render {scene} --material {file} --size 64x48 --spp 256 -o {out}"
                    ));
                    sums(&read_exr(&bench.path(out)).unwrap())
                });
            let total = |m: [f64; 3]| m.iter().sum::<f64>();
            let worst = (0..3)
                .map(|c| (a[c] - b[c]).abs() / (total(b) / 3.0))
                .fold(0.0, f64::max);
            println!("{name} in {scene}: {a:?} {b:?}, largest difference {worst:.5} of the mean");
            assert!(worst < 0.01, "{name} in {scene}: {a:?} {b:?}");
        }
    }
}
