//! CIEDE2000 [Sharma2005] near the hue wrap, for greys, and for colours far out of gamut.

use crate::case::Case;
use crate::real::Real;
use spectrum::ciede2000;

pub(super) fn cases() -> Vec<Case> {
    vec![Case::new(
        "colour/CIEDE2000",
        1e-9,
        "coordinates of 100 are known to 1e-14, differences are weighed down to 1e-4: a hundredth of what is seen",
        |effort, tally| {
            let hues = [0.0, 1e-9, 89.99, 179.0, 180.7, 275.0, 359.0, 360.0 - 1e-9];
            let chromas = [0.0, 1e-9, 1e-3, 1.0, 25.0, 150.0];
            let mut colours = Vec::new();
            for l in [0.0, 50.0, 100.0] {
                for hue in hues {
                    for c in chromas {
                        let (s, cos) = f64::to_radians(hue).sin_cos();
                        colours.push([l, c * cos, c * s]);
                    }
                }
            }
            let step = effort.pick(911, 13);
            let pairs = colours
                .iter()
                .flat_map(|a| colours.iter().map(move |b| (a, b)));
            for (a, b) in pairs.step_by(step) {
                let place = || format!("{a:?} and {b:?}");
                let value = ciede2000(*a, *b);
                tally.value(value, ciede2000(*b, *a), 1e-4, || {
                    format!("swapped, {}", place())
                });
                if let Some(exact) = reference(*a, *b) {
                    tally.value(value, exact.to_f64(), 1e-4, place);
                }
            }
        },
    )]
}

/// Equations 2 to 22 in degrees; `None` where the hues are opposite within 1e-9 degrees, where the way round is a
/// convention.
fn reference(lab1: [f64; 3], lab2: [f64; 3]) -> Option<Real> {
    let [l1, a1, b1] = lab1.map(Real::new);
    let [l2, a2, b2] = lab2.map(Real::new);
    let hypot = |a: &Real, b: &Real| (a.sqr() + b.sqr()).sqrt();
    let saturate = |c: &Real| {
        let c7 = c.pow(7.0);
        (&c7 / (&c7 + Real::new(25.0).pow(7.0))).sqrt()
    };
    let g = 0.5 * (1.0 - saturate(&((hypot(&a1, &b1) + hypot(&a2, &b2)) * 0.5)));
    let (a1, a2) = (a1 * (1.0 + &g), a2 * (1.0 + &g));
    let (c1, c2) = (hypot(&a1, &b1), hypot(&a2, &b2));
    let degree = Real::pi() / 180.0;
    let hue = |a: &Real, b: &Real| {
        if a.is_zero() && b.is_zero() {
            return Real::new(0.0);
        }
        let h = b.atan2(a) / &degree;
        if h < 0.0 { h + 360.0 } else { h }
    };
    let (h1, h2) = (hue(&a1, &b1), hue(&a2, &b2));
    let grey = (&c1 * &c2).is_zero();
    let (difference, sum) = (&h2 - &h1, &h1 + &h2);
    if !grey && ((difference.abs() - 180.0).abs()) < 1e-9 {
        return None;
    }
    let turn = if grey {
        Real::new(0.0)
    } else if difference > 180.0 {
        difference.clone() - 360.0
    } else if difference < -180.0 {
        difference.clone() + 360.0
    } else {
        difference.clone()
    };
    let h = if grey {
        sum
    } else if difference.abs() <= 180.0 {
        sum * 0.5
    } else if sum < 360.0 {
        (sum + 360.0) * 0.5
    } else {
        (sum - 360.0) * 0.5
    };
    let cos = |factor: f64, shift: f64| ((factor * &h + shift) * &degree).cos();
    let t = 1.0 - 0.17 * cos(1.0, -30.0) + 0.24 * cos(2.0, 0.0) + 0.32 * cos(3.0, 6.0)
        - 0.20 * cos(4.0, -63.0);
    let (dl, dc) = (l2.clone() - &l1, &c2 - &c1);
    let dh = 2.0 * (&c1 * &c2).sqrt() * (turn * 0.5 * &degree).sin();
    let (l, c) = ((l1 + l2) * 0.5, (c1 + c2) * 0.5);
    let l50 = (l - 50.0).sqr();
    let theta = 30.0 * (-((&h - 275.0) / 25.0).sqr()).exp();
    let rotation = -(2.0 * theta * &degree).sin() * 2.0 * saturate(&c);
    let l = dl / (1.0 + 0.015 * &l50 / (20.0 + &l50).sqrt());
    let h = dh / (1.0 + 0.015 * &c * t);
    let c = dc / (1.0 + 0.045 * c);
    Some((l.sqr() + c.sqr() + h.sqr() + rotation * c * h).sqrt())
}
