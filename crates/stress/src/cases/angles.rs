//! Half and difference angles [Rusinkiewicz1998].

use crate::case::Case;
use crate::grid::pairs;
use crate::real::Real;
use crate::reference::Vector;
use brdf::HalfDiff;

pub(super) fn cases() -> Vec<Case> {
    vec![Case::new(
        "angles/half and difference",
        1e-14,
        "a few roundings of f64; phi_d is weighed by sin theta_d, without which no direction knows it",
        |effort, tally| {
            for (named, wo) in pairs(effort.pick(23, 2)) {
                let got = HalfDiff::new(named.w, wo);
                let [h, d, p] = reference(&Vector::new(named.w), &Vector::new(wo));
                let place = |what: &str| format!("{what}, {}, wi {}, wo {wo}", named.what, named.w);
                tally.value(got.theta_h, h.to_f64(), 1e-30, || place("theta_h"));
                tally.value(got.theta_d, d.to_f64(), 1e-30, || place("theta_d"));
                let turn = (Real::new(got.phi_d) - p).to_f64();
                let turn = (turn + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU);
                let arc = (turn - std::f64::consts::PI).abs() * d.sin().to_f64();
                tally.error(arc, || place("phi_d"));
            }
        },
    )]
}

/// theta_h, theta_d, phi_d by rotating wi into the frame of the half vector.
fn reference(wi: &Vector, wo: &Vector) -> [Real; 3] {
    let (h, d) = (wi.plus(wo), wi.minus(wo));
    let across = (h.x.sqr() + h.y.sqr()).sqrt();
    let (cos_phi, sin_phi) = if across.is_zero() {
        (Real::new(1.0), Real::new(0.0))
    } else {
        (&h.x / &across, &h.y / &across)
    };
    let len = h.length();
    let (s, c) = (&across / &len, &h.z / &len);
    let x = &wi.x * &cos_phi + &wi.y * &sin_phi;
    let y = &wi.y * &cos_phi - &wi.x * &sin_phi;
    let x = x * &c - &wi.z * &s;
    [across.atan2(&h.z), d.length().atan2(&len), y.atan2(&x)]
}
