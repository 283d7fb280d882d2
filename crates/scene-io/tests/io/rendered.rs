//! Whole lines from scene file to film: closed forms, checkpoints, the default picture.

use crate::scenes::folder;
use scene_io::image::Picture;
use scene_io::{BuiltScene, Overrides, Places, SceneFile, build_scene, checkpoint};
use tracer::{Film, render};

fn built(name: &str, overrides: &Overrides) -> BuiltScene {
    let scene = SceneFile::load(&folder().join(name).join("scene.ron")).unwrap();
    build_scene(scene, overrides, &Places::default()).unwrap_or_else(|e| panic!("{e}"))
}

fn film(built: &BuiltScene) -> Film<3> {
    let mut film = Film::new(built.size.0, built.size.1, 8);
    render(&built.scene, &built.settings, &mut film, &()).unwrap();
    film
}

#[test]
fn the_white_furnace_shows_its_albedo_to_a_thousandth() {
    let built = built("white-furnace", &Overrides::default());
    let picture = Picture::of_film(&film(&built)).unwrap();
    let middle = picture.pixels[64 * 128 + 64];
    let corner = picture.pixels[0];
    // 256 samples of a constant: only f32 rounding is left
    assert!(middle.iter().all(|v| (v - 0.8).abs() < 8e-4), "{middle:?}");
    assert!(corner.iter().all(|v| (v - 1.0).abs() < 1e-6), "{corner:?}");
}

#[test]
fn the_closed_form_scene_is_its_formula() {
    const N: usize = 24;
    let built = built(
        "closed-form",
        &Overrides {
            size: Some((N as u32, N as u32)),
            spp: Some(2048),
            ..Overrides::default()
        },
    );
    let picture = Picture::of_film(&film(&built)).unwrap();
    let variance = picture.variance.as_ref().unwrap();
    // the camera hangs 8 above the plane and looks straight down; x to the right, z down in the picture
    let half = 8.0 * 20.0_f64.to_radians().tan();
    let at = |k: f64| (k * 2.0 / N as f64 - 1.0) * half;
    let radiance = |d2: f64| 0.5 * 4.0 * 0.25 * 2.0 / (d2 + 4.0).powf(1.5);
    let (mut count, mut zz, mut sum, mut sum_of_variance) = (0.0, 0.0, 0.0, 0.0);
    for (x, y) in (0..N * N).map(|k| (k % N, k / N)) {
        // the light hides the plane around the middle: seen from 8 above, its rim reaches 0.67
        if at(x as f64 + 0.5).hypot(at(y as f64 + 0.5)) < 0.9 {
            continue;
        }
        // the mean over the pixel by 8 x 8 midpoints, whose own error is below 1e-4 of it
        let inside = |k: usize, i: usize| at(k as f64 + (i as f64 + 0.5) / 8.0).powi(2);
        let exact = (0..64)
            .map(|i| radiance(inside(x, i % 8) + inside(y, i / 8)) / 64.0)
            .sum::<f64>();
        let difference = f64::from(picture.pixels[y * N + x][0]) - exact;
        let v = f64::from(variance[y * N + x][0]);
        count += 1.0;
        zz += difference * difference / v;
        sum += difference;
        sum_of_variance += v;
    }
    // Student's t with 7 degrees of freedom has mean square 7/5 and, over 500 pixels, a standard error of
    // that of 0.13
    let mean_square: f64 = zz / count;
    assert!((0.9..2.0).contains(&mean_square), "mean z^2 {mean_square}");
    let z: f64 = sum / f64::sqrt(sum_of_variance);
    assert!(
        z.abs() < 3.0,
        "the whole picture is off by {z} standard errors"
    );
}

#[test]
fn a_checkpoint_goes_on_to_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("film.gonio");
    let small = |spp| Overrides {
        size: Some((40, 24)),
        spp: Some(spp),
        ..Overrides::default()
    };
    let whole = film(&built("benchmark-env", &small(32)));
    let half = film(&built("benchmark-env", &small(16)));
    let about = checkpoint::About {
        scene: "benchmark-env".into(),
        seed: 1 << 40,
        spp: 32,
        exposure: Some(2.0),
        shard: Some(tracer::Shard { index: 1, count: 3 }),
        ..checkpoint::About::default()
    };
    checkpoint::save(&path, &half, &about, 99).unwrap();
    let mut resumed = Film::new(40, 24, 8);
    let found = checkpoint::restore(&path, &mut resumed, 99).unwrap();
    assert_eq!(found, about);
    assert_eq!(checkpoint::open::<3>(&path).unwrap().key, 99);
    assert_eq!(resumed, half);
    let scene = built("benchmark-env", &small(32));
    render(&scene.scene, &scene.settings, &mut resumed, &()).unwrap();
    assert!(resumed == whole, "the resumed film differs");

    let error = checkpoint::restore(&path, &mut resumed, 98)
        .unwrap_err()
        .to_string();
    assert!(
        error.ends_with("not a checkpoint of this render: belongs to other input"),
        "{error}"
    );
    let error = checkpoint::restore(&path, &mut Film::<3>::new(40, 25, 8), 99).unwrap_err();
    let expected = "expected a film of 40 x 25 pixels and 8 replicates, found 40 x 24 and 8";
    assert!(error.to_string().ends_with(expected), "{error}");
    assert!(resumed == whole, "a refused checkpoint changed the film");
}
