//! Resampling finds the same light as plain MIS, with less noise where lights are large or many.

use crate::common::{Polished, camera, constant, empty, floor, glossy, grey, shining, sphere};
use brdf::{DirectionSample, DirectionSampler, Material, Paired};
use glam::{DVec2, DVec3};
use sampling::Replicates;
use std::f64::consts::PI;
use tracer::{Description, Film, Object, Scene, Settings, Strategy, render};

/// Exponent of [`Polished`].
const N: f64 = 400.0;

/// Half vectors in proportion to cos^N: what a good sampler of a narrow lobe does.
struct Lobe;

impl DirectionSampler for Lobe {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        let z = (1.0 - u.x).powf(1.0 / (N + 1.0));
        let (r, phi) = ((1.0 - z * z).max(0.0).sqrt(), 2.0 * PI * u.y);
        let h = DVec3::new(r * phi.cos(), r * phi.sin(), z);
        let wi = 2.0 * wo.dot(h) * h - wo;
        let pdf = self.pdf(wi, wo);
        (pdf > 0.0).then_some(DirectionSample { wi, pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let h = (wi + wo).normalize();
        (N + 1.0) / (2.0 * PI) * h.z.powf(N) / (4.0 * wo.dot(h))
    }
}

fn polished() -> Box<dyn Material<1>> {
    Box::new(Paired {
        brdf: Polished,
        sampler: Lobe,
    })
}

/// A polished floor, seen at 45 degrees, and a ball of light of `radius` at distance 4, `off` degrees from the mirror
/// direction.
fn lamp(radius: f64, off: f64) -> Description<1> {
    let mut d = empty(
        camera([-3.0, 3.0, 0.0], [0.0, 0.0, 0.0], 2.0),
        vec![polished()],
    );
    let at = (45.0 + off).to_radians();
    let centre = [4.0 * at.cos(), 4.0 * at.sin(), 0.0];
    d.objects = vec![
        Object::new(floor(0.0, 5.0), 0),
        shining(sphere(centre, radius), (1.0 / (radius * radius)) as f32),
    ];
    d
}

/// Twelve lamps of several sizes over a glossy ball, and a little sky.
fn many() -> Description<1> {
    let mut d = empty(
        camera([0.0, 2.2, 6.5], [0.0, 0.8, 0.0], 30.0),
        vec![grey(0.5), glossy()],
    );
    d.objects = vec![
        Object::new(floor(0.0, 10.0), 0),
        Object::new(sphere([0.0, 1.0, 0.0], 1.0), 1),
    ];
    for k in 0..12 {
        let at = f64::from(k) * PI / 6.0;
        let radius = 0.05 + 0.02 * f64::from(k);
        let lamp = sphere([3.0 * at.cos(), 2.5, 3.0 * at.sin()], radius);
        d.objects.push(shining(lamp, 2.0 + k as f32));
    }
    d.environment = constant(0.1);
    d
}

struct Measured {
    mean: f64,
    error: f64,
    /// Relative variance of a sample.
    variance: f64,
    work: f64,
}

fn measure(description: Description<1>, strategy: Strategy, replicates: u32) -> Measured {
    const SPP: u32 = 64;
    let scene = Scene::new(description).unwrap();
    let mut film = Film::new(6, 6, replicates);
    let settings = Settings {
        strategy,
        spp: SPP * replicates,
        max_depth: 2,
        ..Settings::default()
    };
    let stats = render(&scene, &settings, &mut film, &()).unwrap();
    let means = |r: usize| {
        let sums = film
            .tiles()
            .flat_map(|t| t.sums().chunks(replicates as usize));
        sums.map(|pixel| pixel[r][0]).sum::<f64>() / (36.0 * f64::from(SPP))
    };
    let all: Replicates = (0..replicates as usize).map(means).collect();
    let estimate = film.estimate(0.95);
    Measured {
        mean: all.mean(),
        error: all.standard_error(),
        variance: estimate.rel_rmse.powi(2) * f64::from(settings.spp),
        work: (stats.closest_rays + stats.shadow_rays) as f64,
    }
}

#[test]
fn resampling_finds_the_light_that_mis_finds() {
    let scenes: [(&str, &dyn Fn() -> Description<1>); 4] = [
        ("small lamp", &|| lamp(0.02, 0.0)),
        ("large lamp", &|| lamp(1.4, 0.0)),
        ("lamp beside the lobe", &|| lamp(0.35, 10.0)),
        ("many lamps", &many),
    ];
    for (what, make) in scenes {
        let mis = measure(make(), Strategy::Mis, 32);
        let ris = measure(make(), Strategy::Ris, 32);
        let error = mis.error.hypot(ris.error);
        // four scenes, 62 degrees of freedom: 3.7 errors are passed by chance once in 500; rounding of f32 beside it
        assert!(
            (mis.mean - ris.mean).abs() < 3.7 * error + 1e-5 * mis.mean,
            "{what}: {} and {} +- {error}",
            mis.mean,
            ris.mean
        );
        assert!(
            error < 0.02 * mis.mean,
            "{what}: {error} of {} tells nothing",
            mis.mean
        );
    }
}

#[test]
fn slow_resampling_against_mis() {
    for off in [0.0, 10.0] {
        for radius in [0.02, 0.35, 1.4] {
            let mis = measure(lamp(radius, off), Strategy::Mis, 256);
            let ris = measure(lamp(radius, off), Strategy::Ris, 256);
            println!(
                "radius {radius}, {off} degrees off: relative variance mis {:.4} ris {:.4} ratio {:.2}, rays {:.2}",
                mis.variance,
                ris.variance,
                mis.variance / ris.variance,
                ris.work / mis.work
            );
            // what resampling can lose is the spread of its choice: never seen to matter
            assert!(
                ris.variance < 1.2 * mis.variance,
                "radius {radius}, {off} degrees off"
            );
        }
    }
    let mis = measure(many(), Strategy::Mis, 256);
    let ris = measure(many(), Strategy::Ris, 256);
    println!("many lamps: ratio {:.2}", mis.variance / ris.variance);
    assert!(ris.variance < mis.variance, "many lamps");
}
