//! Paths with wavelengths of their own.

use crate::common::{Cosine, Lambert, camera, floor, quad};
use brdf::{HERO, LANES, Lanes3, Paired, ROTATIONS, RotatedTable, Rotation, TaggedBrdf};
use glam::DVec3;
use std::num::NonZeroUsize;
use std::sync::Arc;
use tracer::{
    Camera, Description, Environment, EnvironmentImage, Film, Hero, HeroEmission, LightSelection,
    Object, PointLight, Scene, Settings, render,
};

/// An albedo that grows along the spectrum.
struct Ramp;

/// Place of a wavelength in the spectrum, [0, 1).
fn place(rotation: usize, wavelength: usize) -> f64 {
    (wavelength * ROTATIONS + rotation) as f64 / (HERO * ROTATIONS) as f64
}

fn table(f: impl Fn(f64) -> f64) -> RotatedTable {
    std::array::from_fn(|r| std::array::from_fn(|c| f(place(r, c)) as f32))
}

impl TaggedBrdf<HERO, Rotation> for Ramp {
    fn eval_tagged(
        &self,
        wi: &Lanes3,
        wo: &Lanes3,
        tags: &[Rotation; LANES],
    ) -> [[f32; LANES]; HERO] {
        let one = TaggedBrdf::<1, ()>::eval_tagged(&Lambert(1.0), wi, wo, &[(); LANES]);
        std::array::from_fn(|c| {
            std::array::from_fn(|k| one[0][k] * place(tags[k].index(), c) as f32)
        })
    }
}

/// The film's channels: the mean over the spectrum, over its lower half, and its first moment.
fn weights() -> Arc<[[[f32; 3]; HERO]; ROTATIONS]> {
    let of = |x: f64| {
        let w = 1.0 / HERO as f64;
        [w, if x < 0.5 { w } else { 0.0 }, w * x].map(|v| v as f32)
    };
    Arc::new(std::array::from_fn(|r| {
        std::array::from_fn(|c| of(place(r, c)))
    }))
}

/// A floor under light that is `light(x)` at place x of the spectrum, seen from above.
fn scene(light: impl Fn(f64) -> f64) -> Scene<HERO, Hero> {
    let emission = HeroEmission::Table(Arc::new(table(light)));
    Scene::with_mode(
        Hero::new(weights()),
        Description {
            camera: camera([0.0, 3.0, 0.1], [0.0, 0.0, 0.0], 30.0),
            materials: vec![Box::new(Paired {
                brdf: Ramp,
                sampler: Cosine,
            })],
            objects: vec![Object::new(floor(0.0, 5.0), 0)],
            lights: vec![],
            environment: Some(Environment::Constant(emission)),
            selection: LightSelection::Auto,
        },
    )
    .unwrap()
}

fn film<const N: usize>(scene: &Scene<N, Hero>, spp: u32, threads: usize) -> Film<3>
where
    Hero: tracer::Develop<N, 3>,
{
    let mut film = Film::new(20, 18, 8);
    let settings = Settings {
        spp,
        max_depth: 2,
        threads: NonZeroUsize::new(threads),
        ..Settings::default()
    };
    render(scene, &settings, &mut film, &()).unwrap();
    film
}

#[test]
fn wavelengths_add_up_to_the_integral_over_the_spectrum() {
    // radiance 1 + x, albedo x, one bounce: x + x^2
    let scene = scene(|x| 1.0 + x);
    // every stratum of 64 rotations is met once by 64 samples of a replicate
    let film = film(&scene, 8 * ROTATIONS as u32, 2);
    let n = (HERO * ROTATIONS) as f64;
    let sum =
        |f: &dyn Fn(f64) -> f64| (0..HERO * ROTATIONS).map(|k| f(k as f64 / n)).sum::<f64>() / n;
    let all = |x: f64| x + x * x;
    let exact = [
        sum(&all),
        sum(&|x| if x < 0.5 { all(x) } else { 0.0 }),
        sum(&|x| x * all(x)),
    ];
    for pixel in film.mean() {
        for c in 0..3 {
            // f32 tables and sums: a sample has 24 bits
            let error = (pixel[c] / exact[c] - 1.0).abs();
            assert!(error < 2e-6, "channel {c}: {} for {}", pixel[c], exact[c]);
        }
    }
}

#[test]
fn few_samples_are_unbiased_and_know_their_error() {
    let scene = scene(|x| 1.0 + x);
    let estimate = film(&scene, 16, 2).moments();
    let exact = 5.0 / 6.0 - 1.0 / (HERO * ROTATIONS) as f64;
    let n = estimate.mean.len() as f64;
    let mean = estimate.mean.iter().map(|p| p[0]).sum::<f64>() / n;
    let error = estimate.variance.iter().map(|v| v[0]).sum::<f64>().sqrt() / n;
    assert!(
        error > 0.0 && error < 1e-3 * exact,
        "standard error {error}"
    );
    // left Riemann sum of x + x^2: 5/6 less half a step of its rise of 2
    assert!(
        (mean - exact).abs() < 4.0 * error,
        "{mean} +- {error}, exact {exact}"
    );
}

#[test]
fn threads_do_not_change_a_bit_of_hero_paths() {
    let scene = scene(|x| x);
    let one = film(&scene, 24, 1);
    assert_eq!(one, film(&scene, 24, 2));
    assert_eq!(one, film(&scene, 24, 3));
}

/// All kinds of lights, given as a table or as parts of three spectra, send out the same.
#[test]
fn lights_are_asked_at_the_wavelengths_of_the_path() {
    let basis = Arc::new([table(|_| 1.0), table(|x| x), table(|x| x * x)]);
    let mixture = HeroEmission::Mixture {
        parts: [0.5, 1.0, 0.25],
        basis,
    };
    let tabled = HeroEmission::Table(Arc::new(table(|x| 0.5 + x + 0.25 * x * x)));
    let look = |emission: &HeroEmission| {
        let lamp = Object {
            emission: Some(emission.clone()),
            ..Object::new(quad([-1.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 0.0, 2.0]), 0)
        };
        let pixels = vec![emission.clone(); 8];
        let image = EnvironmentImage {
            width: 4,
            height: 2,
            pixels,
            to_world: glam::DMat3::IDENTITY,
        };
        let scene = Scene::with_mode(
            Hero::new(weights()),
            Description {
                camera: Camera {
                    eye: DVec3::new(0.0, 1.0, 6.0),
                    target: DVec3::ZERO,
                    up: DVec3::Y,
                    vertical_fov_deg: 40.0,
                },
                materials: vec![Box::new(Paired {
                    brdf: Ramp,
                    sampler: Cosine,
                })],
                objects: vec![Object::new(floor(0.0, 5.0), 0), lamp],
                lights: vec![
                    PointLight::Point {
                        position: DVec3::new(1.0, 3.0, 1.0),
                        intensity: emission.clone(),
                    },
                    PointLight::Directional {
                        direction: -DVec3::Y,
                        irradiance: emission.clone(),
                    },
                ],
                environment: Some(Environment::Image(image)),
                selection: LightSelection::Auto,
            },
        )
        .unwrap();
        film(&scene, 16, 1).mean()
    };
    for (a, b) in look(&mixture).iter().zip(look(&tabled)) {
        for c in 0..3 {
            // three products and two sums in f32 instead of one rounding
            assert!((a[c] - b[c]).abs() < 3e-6 * b[c].abs(), "{a:?} and {b:?}");
        }
    }
}

#[test]
fn a_film_is_mapped_replicate_by_replicate() {
    let scene = scene(|x| 1.0 + x);
    let film = film(&scene, 12, 1);
    let rows = [[1.0, 0.0], [2.0, 1.0], [0.0, -1.0]];
    let mapped = film.mapped(&rows);
    assert_eq!((mapped.width(), mapped.spp()), (film.width(), film.spp()));
    for (a, b) in film.mean().iter().zip(&mapped.mean()) {
        assert!((b[0] - a[0] - 2.0 * a[1]).abs() < 1e-13, "{a:?} to {b:?}");
        assert!((b[1] - a[1] + a[2]).abs() < 1e-13, "{a:?} to {b:?}");
    }
    let rmse = mapped.estimate(0.9).rmse;
    assert!(rmse > 0.0 && rmse.is_finite(), "{rmse}");
}
