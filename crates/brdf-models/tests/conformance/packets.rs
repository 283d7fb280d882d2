//! The f32 packets against the f64 functions.

use crate::cases::{all, random_direction};
use brdf::{EvalPacket, LANES, Lanes3, SamplePacket};
use brdf_models::ParsedModel;
use glam::DVec2;
use testkit::Rng;

/// f32 rounding, grown by the square of a lobe's steepness: 1e-7 / 0.02.
const TOLERANCE: f64 = 3e-5;

/// Directions that are exactly representable in f32, so that both sides see the same ones.
fn directions(rng: &mut Rng) -> Lanes3 {
    let mut w = Lanes3::ZERO;
    for k in 0..LANES {
        w.set(k, random_direction(rng).as_vec3());
    }
    // one lane below the horizon
    w.z[3] = -w.z[3];
    w
}

fn close(a: f32, b: f64) -> bool {
    let a = f64::from(a);
    (a - b).abs() <= TOLERANCE * a.abs().max(b.abs()) + 1e-12
}

fn check_eval(model: &ParsedModel<3>, rng: &mut Rng) {
    let (wi, wo) = (directions(rng), directions(rng));
    let f = model.built.brdf.eval_lanes(&wi, &wo);
    let pdf = model.built.sampler.pdf_lanes(&wi, &wo);
    let mut packet = [EvalPacket {
        wi,
        wo,
        ..EvalPacket::ZERO
    }];
    model.built.material.eval(&mut packet);
    for k in 0..LANES {
        let (a, b) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
        let exact = model.built.brdf.eval(a, b);
        for c in 0..3 {
            assert!(
                close(f[c][k], exact[c]),
                "{model}: f({a}, {b}) {} {}",
                f[c][k],
                exact[c]
            );
            let f_cos = exact[c] * a.z.max(0.0);
            assert!(
                close(packet[0].f_cos[c][k], f_cos),
                "{model}: {} {f_cos}",
                packet[0].f_cos[c][k]
            );
        }
        let exact = model.built.sampler.pdf(a, b);
        assert!(
            close(pdf[k], exact),
            "{model}: pdf({a}, {b}) {} {exact}",
            pdf[k]
        );
    }
}

fn check_sample(model: &ParsedModel<3>, rng: &mut Rng) {
    let wo = directions(rng);
    let u = [(); 2].map(|()| [(); LANES].map(|()| rng.uniform() as f32 * 0.999));
    let lanes = model.built.sampler.sample_lanes(&wo, &u);
    let mut packet = [SamplePacket {
        wo,
        u,
        ..SamplePacket::ZERO
    }];
    model.built.material.sample(&mut packet);
    for k in 0..LANES {
        let (o, i) = (wo.get(k).as_dvec3(), lanes.wi.get(k).as_dvec3());
        let u = DVec2::new(f64::from(u[0][k]), f64::from(u[1][k]));
        let scalar = model.built.sampler.sample(o, u);
        let pdf = f64::from(lanes.pdf[k]);
        match scalar {
            // f32 may lose or keep a direction within rounding of the horizon
            Some(s) if s.wi.z > 1e-5 => {
                assert!(i.distance(s.wi) < 2e-5, "{model}: {i} {}", s.wi);
                // the density of the direction before or after its rounding to f32
                let (before, after) = (s.pdf, model.built.sampler.pdf(i, o));
                let sound = close(lanes.pdf[k], before) || close(lanes.pdf[k], after);
                assert!(sound, "{model}: pdf {pdf} {before} {after}");
            }
            Some(_) => {}
            None => assert!(
                pdf <= 0.0 || i.z < 1e-5,
                "{model}: {i} was to be lost, pdf {pdf}"
            ),
        }
        for c in 0..3 {
            let weight = if pdf > 0.0 {
                model.built.brdf.eval(i, o)[c] * i.z.max(0.0) / pdf
            } else {
                0.0
            };
            assert!(
                close(packet[0].weight[c][k], weight),
                "{model}: {} {weight}",
                packet[0].weight[c][k]
            );
        }
    }
}

#[test]
fn packets_agree_with_scalars() {
    for model in all() {
        let mut rng = Rng::new(23);
        for _ in 0..100 {
            check_eval(&model, &mut rng);
            check_sample(&model, &mut rng);
        }
    }
}
