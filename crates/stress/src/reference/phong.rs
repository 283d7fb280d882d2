//! Powers of cosines: [Phong1975], [Lewis1994], [Blinn1977], [Lafortune1997], [AshikhminShirley2000].

use super::{Args, Vector};
use crate::real::Real;

fn weights(a: &Args<'_>) -> Real {
    a.share(
        |c| Real::new(a.in_channel("ks", c)),
        |c| Real::new(a.in_channel("kd", c)),
    )
}

/// (r.w)_+^n of two vectors brought to unit length.
fn power(r: &Vector, w: &Vector, n: f64) -> Real {
    let cos = r.dot(w) / (r.length() * w.length());
    if cos.is_positive() {
        cos.pow(n)
    } else {
        Real::new(0.0)
    }
}

/// wo mirrored at the normal.
fn mirrored(a: &Args<'_>) -> Vector {
    Vector {
        x: -&a.wo.x,
        y: -&a.wo.y,
        z: a.wo.z.clone(),
    }
}

pub(super) fn classic(a: &Args<'_>) -> Real {
    a.diffuse() + a.own("ks") * power(&mirrored(a), &a.wi, a.scalar("n")) / &a.wi.z
}

pub(super) fn lewis(a: &Args<'_>) -> Real {
    let n = a.scalar("n");
    let scale = (Real::new(n) + 2.0) / (2.0 * Real::pi());
    a.diffuse() + a.own("ks") * scale * power(&mirrored(a), &a.wi, n)
}

/// (n+1)/(2 pi) cos^n about the unit vector along `axis`.
fn power_pdf(axis: &Vector, w: &Vector, n: f64) -> Real {
    (Real::new(n) + 1.0) / (2.0 * Real::pi()) * power(axis, w, n)
}

pub(super) fn mirror_pdf(a: &Args<'_>) -> Real {
    a.mixture(&weights(a), power_pdf(&mirrored(a), &a.wi, a.scalar("n")))
}

pub(super) fn blinn(a: &Args<'_>) -> Real {
    let n = Real::new(a.scalar("n"));
    let half = (&n * -0.5) * Real::new(2.0).ln();
    let scale = (&n + 2.0) * (&n + 4.0) / (8.0 * Real::pi() * (half.exp() + &n));
    a.diffuse() + a.own("ks") * scale * a.hz().pow(a.scalar("n"))
}

pub(super) fn blinn_pdf(a: &Args<'_>) -> Real {
    let n = a.scalar("n");
    let d = (Real::new(n) + 1.0) / (2.0 * Real::pi()) * a.hz().pow(n);
    a.mixture(&weights(a), d / (4.0 * a.cos_d()))
}

/// Names of the parameters of each lobe that is given: those of further lobes end in their number.
fn lobes(a: &Args<'_>) -> impl Iterator<Item = [String; 5]> {
    let named = |k: usize| {
        ["ks", "n", "cx", "cy", "cz"].map(|name| match k {
            1 => name.to_owned(),
            _ => format!("{name}{k}"),
        })
    };
    (1..)
        .map(named)
        .take_while(|[ks, ..]| a.values.is_given(ks))
}

pub(super) fn lafortune(a: &Args<'_>) -> Real {
    let mut f = a.diffuse();
    for [ks, n, cx, cy, cz] in &lobes(a).collect::<Vec<_>>() {
        let d = a.scalar(cx) * &a.wi.x * &a.wo.x
            + a.scalar(cy) * &a.wi.y * &a.wo.y
            + a.scalar(cz) * &a.wi.z * &a.wo.z;
        if d.is_positive() {
            let n = a.scalar(n);
            f = f + a.own(ks) * (Real::new(n) + 2.0) / (2.0 * Real::pi()) * d.pow(n);
        }
    }
    f
}

pub(super) fn lafortune_pdf(a: &Args<'_>) -> Real {
    let sum = |name: &str| (0..3).map(|c| a.in_channel(name, c)).sum::<f64>();
    let diffuse = Real::new(sum("kd"));
    let (mut total, mut pdf) = (diffuse.clone(), &diffuse * &a.wi.z / Real::pi());
    for [ks, n, cx, cy, cz] in &lobes(a).collect::<Vec<_>>() {
        let axis = Vector {
            x: a.scalar(cx) * &a.wo.x,
            y: a.scalar(cy) * &a.wo.y,
            z: a.scalar(cz) * &a.wo.z,
        };
        let (n, length) = (a.scalar(n), axis.length());
        if sum(ks) > 0.0 && length.is_positive() {
            let energy = sum(ks) * (Real::new(n) + 2.0) / (Real::new(n) + 1.0) * length.pow(n);
            pdf = pdf + &energy * power_pdf(&axis, &a.wi, n);
            total = total + energy;
        }
    }
    if total.is_positive() {
        pdf / total
    } else {
        &a.wi.z / Real::pi()
    }
}

/// sqrt((nx+1)(ny+1)) / (2 pi) hz^(nx cos^2 p + ny sin^2 p).
fn ashikhmin_half(a: &Args<'_>) -> Real {
    let (nx, ny) = (Real::new(a.scalar("nx")), Real::new(a.scalar("ny")));
    let (x2, y2) = (a.half.x.sqr(), a.half.y.sqr());
    let across = &x2 + &y2;
    let power = if across.is_zero() {
        Real::new(1.0)
    } else {
        let n = (&nx * x2 + &ny * y2) / across;
        (n * a.hz().ln()).exp()
    };
    ((&nx + 1.0) * (&ny + 1.0)).sqrt() / (2.0 * Real::pi()) * power
}

/// From m = 1 - c, which |wi - wo| knows where directions are of unit length to 1e-16 only.
fn schlick(f0: f64, m: &Real) -> Real {
    f0 + (1.0 - Real::new(f0)) * m.pow(5.0)
}

/// The lobe of facets that reflect `f0`.
fn ashikhmin_facets(a: &Args<'_>, f0: f64) -> Real {
    let m = a.sin2_d() / (1.0 + a.cos_d());
    ashikhmin_half(a) / 4.0 * schlick(f0, &m) / (a.cos_d() * a.wi.z.max(&a.wo.z))
}

pub(super) fn ashikhmin_lobe(a: &Args<'_>) -> Real {
    a.diffuse() + a.own("ks") * ashikhmin_facets(a, a.own("f0"))
}

pub(super) fn ashikhmin_lobe_pdf(a: &Args<'_>) -> Real {
    let m = 1.0 - a.wo.z.min(&Real::new(1.0));
    let share = a.share(
        |c| a.in_channel("ks", c) * schlick(a.in_channel("f0", c), &m),
        |c| Real::new(a.in_channel("kd", c)),
    );
    a.mixture(&share, ashikhmin_half(a) / (4.0 * a.cos_d()))
}

pub(super) fn ashikhmin(a: &Args<'_>) -> Real {
    let (ks, kd) = (a.own("ks"), a.own("kd"));
    let lobe = ashikhmin_facets(a, ks);
    let base = |w: &Vector| 1.0 - (1.0 - &w.z * 0.5).pow(5.0);
    let under = 28.0 * Real::new(kd) * (1.0 - Real::new(ks)) / (23.0 * Real::pi());
    lobe + under * base(&a.wi) * base(&a.wo)
}

pub(super) fn ashikhmin_pdf(a: &Args<'_>) -> Real {
    let m = 1.0 - a.wo.z.min(&Real::new(1.0));
    let share = a.share(
        |c| schlick(a.in_channel("ks", c), &m),
        |c| a.in_channel("kd", c) * (1.0 - Real::new(a.in_channel("ks", c))),
    );
    a.mixture(&share, ashikhmin_half(a) / (4.0 * a.cos_d()))
}
