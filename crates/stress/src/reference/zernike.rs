//! The basis of Zernike functions [Koenderink1998].

use super::{Args, Vector};
use crate::real::Real;

fn factorial(k: u32) -> f64 {
    (1..=k).map(f64::from).product()
}

/// R_n^m(r) = sum over k of (-1)^k (n-k)! / (k! ((n+m)/2-k)! ((n-m)/2-k)!) r^(n-2k) [BornWolf1999, 9.2.1].
fn radial(n: u32, m: u32, r: &Real) -> Real {
    let mut sum = Real::new(0.0);
    for k in 0..=(n - m) / 2 {
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        let over = factorial(k) * factorial((n + m) / 2 - k) * factorial((n - m) / 2 - k);
        sum = sum + sign * factorial(n - k) / Real::new(over) * r.pow(f64::from(n - 2 * k));
    }
    sum
}

/// sqrt 2 sin(theta/2).
fn radius(w: &Vector) -> Real {
    Real::new(2.0).sqrt() * (w.sine().atan2(&w.z) * 0.5).sin()
}

/// cos(m dphi) for the azimuths of both directions; 1 where one has none.
fn turned(a: &Args<'_>, m: u32) -> Real {
    let cross = &a.wi.x * &a.wo.y - &a.wi.y * &a.wo.x;
    let dot = &a.wi.x * &a.wo.x + &a.wi.y * &a.wo.y;
    if cross.is_zero() && dot.is_zero() {
        return Real::new(1.0);
    }
    (cross.atan2(&dot) * f64::from(m)).cos()
}

/// Indices n >= l >= m of equal parity, by rising n, l, m.
fn indices() -> impl Iterator<Item = [u32; 3]> {
    (0..).flat_map(|n: u32| {
        (n % 2..=n)
            .step_by(2)
            .flat_map(move |l| (n % 2..=l).step_by(2).map(move |m| [n, l, m]))
    })
}

pub(super) fn koenderink(a: &Args<'_>) -> Real {
    let (ri, ro) = (radius(&a.wi), radius(&a.wo));
    let mut f = a.diffuse();
    let given = (1..)
        .map(|k| if k == 1 { "a".into() } else { format!("a{k}") })
        .take_while(|name: &String| a.values.is_given(name));
    // the constant is kd/pi
    for (name, [n, l, m]) in given.zip(indices().skip(1)) {
        if a.own(&name) == 0.0 {
            continue;
        }
        // of norm 1 over both hemispheres
        let turns = if m == 0 { 4.0 } else { 2.0 };
        let norm2 = f64::from((n + 1) * (l + 1)) / (turns * Real::pi().sqr());
        let scale = (norm2 * if n == l { 0.25 } else { 0.5 }).sqrt();
        let both = radial(n, m, &ri) * radial(l, m, &ro) + radial(l, m, &ri) * radial(n, m, &ro);
        f = f + a.own(&name) * scale * both * turned(a, m);
    }
    f
}
