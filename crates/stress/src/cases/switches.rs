//! Where a formula changes its form, or a limit takes its place: both sides against the same reference.
//!
//! Switches inside of private functions are tested beside them; docs/numerics.md lists all.

use crate::case::Case;
use crate::real::Real;
use crate::reference::{Args, REFERENCES, unpolarised};
use crate::tally::Tally;
use brdf::direction;
use brdf_models::{Fresnel, parse_model};
use glam::DVec3;
use spectrum::{lab_from_xyz, srgb_decode, srgb_encode, xyz_from_lab};
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Relative distances from a switch, to both sides, and on it.
const STEPS: [f64; 7] = [-1e-3, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-3];

#[expect(clippy::too_many_lines, reason = "a list, a row a case")]
pub(super) fn cases() -> Vec<Case> {
    vec![
        Case::new(
            "switch/Fresnel: cos^2 or sin^2 in the root, at 45 degrees",
            1e-11,
            "as the row of Fresnel's equations",
            |_, t| {
                for (n, k) in [
                    (1.5, 0.0),
                    (1.0 + 1e-9, 0.0),
                    (0.9, 0.0),
                    (0.2, 3.9),
                    (1e6, 1.0),
                ] {
                    each_step(|step| fresnel(n, k, FRAC_1_SQRT_2 * (1.0 + step), t));
                }
            },
        ),
        Case::new(
            "switch/Fresnel: total reflection begins",
            1e-6,
            "the slope is infinite there: 1e-15 of the squared sine is the root of it of the reflectance",
            |_, t| {
                for n in [0.05_f64, 0.66, 0.999] {
                    let critical = (1.0 - n * n).sqrt();
                    each_step(|step| fresnel(n, 0.0, critical * (1.0 + step), t));
                }
            },
        ),
        Case::new(
            "switch/Fresnel: f0 = 1 is a mirror",
            1e-6,
            "n = (1 + r)/(1 - r) of f0 = 1 - 1e-15 is 4e15; 1 - F is then 4/(n cos)",
            |_, t| {
                for f0 in [1.0 - 1e-15, 1.0] {
                    for c in [1e-3, 0.3, 1.0] {
                        let f = Fresnel::from_f0([f0]).eval(c)[0];
                        t.value(f, 1.0, 0.0, || format!("f0 = 1 - {:e}, cos {c}", 1.0 - f0));
                    }
                }
            },
        ),
        Case::new(
            "switch/power of a cosine: difference or product, at 60 degrees",
            1e-11,
            "1e-16 of the cosine, n times",
            |_, t| {
                for n in [0.5, 1.0, 100.0, 800.0] {
                    each_step(|step| {
                        let wi = direction(0.5 + PI / 3.0 * (1.0 + step), PI);
                        against(&format!("lewis:n={n},kd=0"), wi, direction(0.5, 0.0), t);
                    });
                }
            },
        ),
        Case::new(
            "switch/Smith: no shadow from cot = 6 m on",
            1e-11,
            "Lambda is 4e-20 there",
            |_, t| {
                for m in [0.01_f64, 0.2, 1.0] {
                    each_step(|step| {
                        let w = direction((1.0 / (6.0 * m)).atan() * (1.0 + step), 0.3);
                        against(&format!("cook-torrance-smith:m={m}"), w, w, t);
                    });
                }
            },
        ),
        Case::new(
            "switch/He: sum or integral, saddle point at 22",
            1e-4,
            "either side is good to 2e-5; the demand is 1e-4",
            |_, t| {
                // g = (4 pi sigma/lambda)^2 = 22 toward the normal
                let sigma = 22.0_f64.sqrt() * 0.55 / (4.0 * PI);
                each_step(|step| {
                    for tilt in [0.0, 0.02, 0.3] {
                        let text = format!("he:tau=3,mirror=0,sigma={}", sigma * (1.0 + step));
                        against(&text, direction(tilt, 0.1), DVec3::Z, t);
                    }
                });
            },
        ),
        Case::new(
            "switch/He: a smooth surface is a mirror",
            1e-4,
            "sigma = 0 leaves the widened mirror reflection; g = 5e-28 at 1e-15 um",
            |_, t| {
                for sigma in [0.0, 1e-15, 1e-9] {
                    for tilt in [0.0, 1e-3, 0.2] {
                        let text = format!("he:tau=3,width=0.02,sigma={sigma}");
                        against(&text, direction(tilt, 0.1), direction(0.4, 2.0), t);
                    }
                }
            },
        ),
        Case::new(
            "switch/power laws: the logarithm where an exponent is 0",
            1e-9,
            "(t^e - 1)/e by expm1, and ln t where e ln t is under 1e-12",
            |_, t| {
                each_step(|step| {
                    let (wi, wo) = (direction(0.7, 0.3), direction(0.5, 3.0));
                    for text in [
                        format!("harvey-shack:kd=0.2,l=0.01,s={}", -2.0 * (1.0 + step)),
                        format!("abg:kd=0.2,g={}", 2.0 * (1.0 + step)),
                        format!("abc:c={}", 1.0 + step),
                        format!("sgd:p={}", 1.0 + step),
                    ] {
                        against(&text, wi, wo, t);
                    }
                });
            },
        ),
        Case::new(
            "switch/azimuth at right angles: Oren-Nayar, EON",
            1e-11,
            "continuous, but its slope is not",
            |_, t| {
                each_step(|step| {
                    let wi = direction(0.9, 0.5 * PI * (1.0 + step));
                    for text in ["oren-nayar:sigma=0.4", "eon:r=0.7"] {
                        against(text, wi, direction(1.1, 0.0), t);
                    }
                });
            },
        ),
        Case::new(
            "limit/roughness of 1e-4: narrower lobes are refused",
            0.0,
            "one side works, the other is an error that says so: f32 directions cannot tell narrower lobes from a mirror",
            |_, t| {
                for text in ["ggx:alpha", "cook-torrance:m", "ward:alpha", "he:width"] {
                    let accepted = parse_model(&format!("{text}=0.0001")).is_ok();
                    let refused = parse_model(&format!("{text}=0.000099")).is_err();
                    t.error(f64::from(u8::from(!(accepted && refused))), || text.into());
                }
            },
        ),
        Case::new(
            "limit/horizon: nothing is reflected below a cosine of 1e-60",
            0.0,
            "finite and not negative above, 0 below",
            |_, t| {
                for info in brdf_models::MODELS {
                    let Ok(model) = parse_model(info.name) else {
                        t.error(f64::INFINITY, || info.name.into());
                        continue;
                    };
                    let f = |z: f64| model.built.brdf.eval(DVec3::new(1.0, 0.0, z), DVec3::Z);
                    for v in f(1.001e-60) {
                        t.sound(v, || info.name.into());
                    }
                    for v in f(0.999e-60) {
                        t.error(v.abs(), || info.name.into());
                    }
                }
            },
        ),
        Case::new(
            "switch/sRGB and CIELAB: line or power",
            1e-6,
            "the standard's constants are rounded: the two pieces of sRGB miss each other by 3e-8 of 0.04",
            |_, t| colour(t),
        ),
    ]
}

fn each_step(mut f: impl FnMut(f64)) {
    STEPS.into_iter().for_each(&mut f);
}

fn fresnel(n: f64, k: f64, c: f64, tally: &mut Tally) {
    let exact = Real::new(c);
    let sin2 = (1.0 - &exact) * (1.0 + &exact);
    let value = Fresnel::from_index([n], [k]).eval_at(c, sin2.to_f64())[0];
    let reference = unpolarised(n, k, &exact, &sin2).to_f64();
    tally.value(value, reference, 1e-25, || {
        format!("n {n}, k {k}, cos {c:e}")
    });
}

/// f and pdf of a model against 160 bits.
fn against(text: &str, wi: DVec3, wo: DVec3, tally: &mut Tally) {
    let place = || format!("{text}, wi {wi}, wo {wo}");
    let Ok(model) = parse_model(text) else {
        tally.error(f64::INFINITY, || format!("refused: {text}"));
        return;
    };
    let Some(reference) = REFERENCES.iter().find(|r| r.model == model.info.name) else {
        tally.error(f64::INFINITY, || format!("no reference: {text}"));
        return;
    };
    let args = Args::new(&model.values, 0, wi, wo);
    let f = model.built.brdf.eval(wi, wo)[0];
    tally.value(f, (reference.f)(&args).to_f64(), 1e-60, place);
    let value = model.built.sampler.pdf(wi, wo);
    tally.value(value, (reference.pdf)(&args).to_f64(), 1e-60, place);
}

fn colour(tally: &mut Tally) {
    each_step(|step| {
        let x = 0.003_130_8 * (1.0 + step);
        let (line, power) = (12.92 * x, 1.055 * x.powf(1.0 / 2.4) - 0.055);
        let value = srgb_encode(x);
        // whichever piece is taken, the other is as close as the constants allow, away from the corner not
        if step.abs() < 1e-6 {
            tally.value(value, line, 0.0, || format!("encode {x:e}, line"));
            tally.value(value, power, 0.0, || format!("encode {x:e}, power"));
        }
        tally.value(srgb_decode(value), x, 0.0, || format!("decode {value:e}"));
        let y = (6.0_f64 / 29.0).powi(3) * (1.0 + step);
        let lab = lab_from_xyz([y; 3], [1.0; 3]);
        let exact = (1.0 + step).cbrt() * 6.0 / 29.0 * 116.0 - 16.0;
        // the line has the slope of the root there: they part by the square of the step
        tally.value(lab[0], exact, 100.0, || format!("L* of {y:e}"));
        tally.value(xyz_from_lab(lab, [1.0; 3])[1], y, 0.0, || {
            format!("{y:e} from L*")
        });
    });
}
