//! Maps without a width, and choices among a few: there and back at the ends of u.

use super::warps::{US, weights};
use crate::case::Case;
use crate::tally::Tally;
use glam::{DVec2, DVec3};
use sampling::{Mixture, Rejection, warp};

/// A map from the square: how far u is sent from the set it belongs to, and how far the inverse is from coming back.
///
/// Points are compared, not u: at a pole many u are the same point.
type Map = (&'static str, fn(DVec2) -> [f64; 2]);

const MAPS: &[Map] = &[
    ("warp/concentric disk", |u| {
        let p = warp::concentric_disk(u);
        let again = warp::concentric_disk(warp::concentric_disk_inverse(p));
        [(p.length() - 1.0).max(0.0), again.distance(p)]
    }),
    ("warp/uniform hemisphere", |u| {
        let w = warp::uniform_hemisphere(u);
        let again = warp::uniform_hemisphere(warp::uniform_hemisphere_inverse(w));
        [off_hemisphere(w), again.distance(w)]
    }),
    ("warp/cosine hemisphere", |u| {
        let w = warp::cosine_hemisphere(u);
        let again = warp::cosine_hemisphere(warp::cosine_hemisphere_inverse(w));
        [off_hemisphere(w), again.distance(w)]
    }),
    ("warp/uniform sphere", |u| {
        let w = warp::uniform_sphere(u);
        let again = warp::uniform_sphere(warp::uniform_sphere_inverse(w));
        [(w.length() - 1.0).abs(), again.distance(w)]
    }),
    ("warp/triangle", |u| {
        let b = warp::triangle(u);
        let again = warp::triangle(warp::triangle_inverse(b));
        let outside = (-b.min_element()).max(0.0) + (b.element_sum() - 1.0).abs();
        [outside, again.distance(b)]
    }),
];

fn off_hemisphere(w: DVec3) -> f64 {
    (w.length() - 1.0).abs() + (-w.z).max(0.0)
}

pub(super) fn cases() -> Vec<Case> {
    let mut all: Vec<_> = MAPS
        .iter()
        .map(|(name, errors)| {
            Case::new(
                *name,
                3e-8,
                "an angle from its cosine is known to the root of 1e-16; u to 1 - 2^-53",
                move |_, tally| {
                    for u in US.into_iter().flat_map(|x| US.map(|y| DVec2::new(x, y))) {
                        let [outside, back] = errors(u);
                        tally.error(outside, || format!("outside, u {u}"));
                        tally.error(back, || format!("back, u {u}"));
                    }
                },
            )
        })
        .collect();
    all.extend([
        Case::new(
            "choice/Mixture",
            1e-12,
            "sums of a dozen probabilities; u to 1 - 2^-53",
            |_, tally| mixture(tally),
        ),
        Case::new(
            "choice/Rejection",
            0.0,
            "nothing is never accepted, the bound always; bounds of 1e-300 to 1e300",
            |_, tally| rejection(tally),
        ),
    ]);
    all
}

fn mixture(tally: &mut Tally) {
    for (name, values) in weights(12) {
        let Ok(mixture) = Mixture::new(&values) else {
            // documented: a subnormal sum has lost its digits
            let refused = if name == "all subnormal" { 0.0 } else { 1.0 };
            tally.error(refused, || format!("{name}: refused"));
            continue;
        };
        let sum: f64 = mixture.weights().iter().sum();
        tally.value(sum, 1.0, 0.0, || format!("{name}: sum"));
        for u in US {
            let (k, rest) = mixture.choose(u);
            let chosen = mixture.weights()[k] > 0.0 && (0.0..1.0).contains(&rest);
            tally.error(f64::from(u8::from(!chosen)), || format!("{name}, u {u:e}"));
        }
        let pdf = mixture.pdf(|_| 1.0);
        tally.value(pdf, 1.0, 0.0, || format!("{name}: pdf"));
    }
}

fn rejection(tally: &mut Tally) {
    for bound in [1e-300, 1e-30, 1.0, 3.7, 1e30, 1e300] {
        let Some(mut rejection) = Rejection::new(bound) else {
            tally.error(f64::INFINITY, || format!("{bound:e} is refused"));
            continue;
        };
        for u in US {
            let right = !rejection.accept(0.0, u) && rejection.accept(bound, u);
            tally.error(f64::from(u8::from(!right)), || {
                format!("bound {bound:e}, u {u:e}")
            });
        }
    }
}
