//! Refractive indices of substances by wavelength, and what they are in the channels of a render.

use crate::fresnel::{Fresnel, Mix, neighbours};
use crate::generated::substances::TABLE;
use glam::{DMat3, DVec3};
use spectrum::{Outside, Spectrum};

/// A substance whose complex index n + ik was measured [Polyanskiy2024].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Substance {
    /// What is typed: a chemical symbol, or a name.
    pub name: &'static str,
    /// One line.
    pub title: &'static str,
    /// Key of who measured it in docs/references.bib.
    pub citation: &'static str,
    /// Wavelength in nm, n, k; ascending.
    pub(crate) rows: &'static [[f64; 3]],
    /// In linear sRGB under D65.
    pub(crate) srgb: [Seen; 3],
}

/// One channel: an index, and what the channel makes of those of its neighbours and its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seen {
    /// Refractive index.
    pub n: f64,
    /// Extinction coefficient.
    pub k: f64,
    /// See [`Mix`].
    pub mix: Mix,
}

/// Every substance known by name.
pub const SUBSTANCES: &[Substance] = &TABLE;

/// Their names.
pub(crate) const SUBSTANCE_NAMES: [&str; TABLE.len()] = {
    let mut names = [""; TABLE.len()];
    let mut k = 0;
    while k < names.len() {
        names[k] = TABLE[k].name;
        k += 1;
    }
    names
};

/// Where light is seen, nm.
const VISIBLE_NM: [f64; 2] = [360.0, 830.0];
/// Wavelengths of a reflectance are so far apart, nm: the tables' own are 10 to 70.
const STEP_NM: f64 = 5.0;
/// Angles of incidence at which mixtures are fitted, every 2.5 degrees short of grazing, where every loss is 0.
const ANGLES: usize = 36;

impl Substance {
    /// The one called `name`.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        SUBSTANCES.iter().find(|s| s.name == name)
    }

    /// n and k at a wavelength in nm: linear between the rows of the table, held beyond its ends.
    #[must_use]
    pub fn at(&self, lambda_nm: f64) -> [f64; 2] {
        at(self.rows, lambda_nm)
    }

    /// Unpolarised reflectance by wavelength at the cosine `c` of the angle of incidence.
    #[must_use]
    pub fn reflectance(&self, c: f64) -> Spectrum {
        reflectance(self.rows, c)
    }

    /// As the channels of a render see it: channel c at the wavelength `lambda_nm[c]`, mixed with its neighbours so
    /// that at every angle it reflects what `project` says of the reflectance by wavelength.
    #[must_use]
    pub fn seen(&self, lambda_nm: &[f64], project: &dyn Fn(&Spectrum) -> Vec<f64>) -> Vec<Seen> {
        seen(self.rows, lambda_nm, project)
    }

    /// In linear sRGB, or NaN in other than three channels.
    pub(crate) fn in_srgb<const N: usize>(&self) -> Fresnel<N> {
        Fresnel::seen(&self.srgb)
    }

    /// Index and shares in linear sRGB under D65.
    #[must_use]
    pub const fn srgb(&self) -> &[Seen; 3] {
        &self.srgb
    }
}

impl<const N: usize> Fresnel<N> {
    /// Of channels as [`Substance::seen`] gives them; NaN where there are fewer than `N`.
    #[must_use]
    pub fn seen(channels: &[Seen]) -> Self {
        let of = |f: fn(&Seen) -> f64| std::array::from_fn(|c| channels.get(c).map_or(f64::NAN, f));
        let mix = std::array::from_fn(|c| channels.get(c).map_or([f64::NAN; 3], |s| s.mix));
        Self::mixed(of(|s| s.n), of(|s| s.k), mix)
    }
}

fn at(rows: &[[f64; 3]], lambda_nm: f64) -> [f64; 2] {
    let above = rows.partition_point(|r| r[0] <= lambda_nm);
    let (low, high) = (
        rows[above.saturating_sub(1)],
        rows[above.min(rows.len() - 1)],
    );
    let gap = high[0] - low[0];
    let t = if gap > 0.0 {
        (lambda_nm - low[0]) / gap
    } else {
        0.0
    };
    [1, 2].map(|j| low[j] + t * (high[j] - low[j]))
}

fn reflectance(rows: &[[f64; 3]], c: f64) -> Spectrum {
    let count = ((VISIBLE_NM[1] - VISIBLE_NM[0]) / STEP_NM) as usize + 1;
    let value = |k: usize| {
        let nm = VISIBLE_NM[0] + STEP_NM * k as f64;
        let [n, k] = at(rows, nm);
        (nm, Fresnel::from_index([n], [k]).eval(c)[0])
    };
    let (nm, values) = (0..count).map(value).unzip();
    Spectrum::new(nm, values, Outside::Hold).unwrap_or_else(|_| Spectrum::constant(1.0))
}

/// [`Substance::seen`] of a table of wavelength in nm (ascending, at least one), n and k: for who writes tables.
#[must_use]
pub fn seen(
    rows: &[[f64; 3]],
    lambda_nm: &[f64],
    project: &dyn Fn(&Spectrum) -> Vec<f64>,
) -> Vec<Seen> {
    let own: Vec<[f64; 2]> = lambda_nm.iter().map(|nm| at(rows, *nm)).collect();
    let count = own.len();
    let mut equations = vec![Equations::new(); count];
    for j in 0..ANGLES {
        let c = (j as f64 * std::f64::consts::FRAC_PI_2 / ANGLES as f64).cos();
        let losses: Vec<f64> = (own.iter())
            .map(|[n, k]| 1.0 - Fresnel::from_index([*n], [*k]).eval(c)[0])
            .collect();
        let target = project(&reflectance(rows, c));
        for (i, equations) in equations.iter_mut().enumerate() {
            let [a, b, d] = neighbours(i, count).map(|i| losses[i]);
            equations.add(DVec3::new(a, b, d), 1.0 - target[i]);
        }
    }
    let mixes = equations.iter().map(Equations::solve);
    (own.iter().zip(mixes))
        .map(|([n, k], mix)| Seen { n: *n, k: *k, mix })
        .collect()
}

/// Normal equations of three shares.
#[derive(Clone)]
struct Equations {
    matrix: DMat3,
    right: DVec3,
}

/// Pull toward the channel's own index, relative to the size of the equations: neighbours of a dielectric are nearly
/// equal, and only their sum is determined.
const RIDGE: f64 = 1e-9;

impl Equations {
    const fn new() -> Self {
        Self {
            matrix: DMat3::ZERO,
            right: DVec3::ZERO,
        }
    }

    fn add(&mut self, row: DVec3, target: f64) {
        self.matrix += DMat3::from_cols(row * row.x, row * row.y, row * row.z);
        self.right += row * target;
    }

    /// By Cholesky's factors, which bear what the ridge leaves of the condition.
    fn solve(&self) -> Mix {
        let ridge = RIDGE * (self.matrix.x_axis.x + self.matrix.y_axis.y + self.matrix.z_axis.z);
        let m = (self.matrix + DMat3::from_diagonal(DVec3::splat(ridge))).to_cols_array_2d();
        let mut x = (self.right + DVec3::Y * ridge).to_array();
        let mut l = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..=i {
                let sum: f64 = m[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
                l[i][j] = if i == j {
                    sum.max(0.0).sqrt()
                } else {
                    sum / l[j][j]
                };
            }
            x[i] = (x[i] - (0..i).map(|k| l[i][k] * x[k]).sum::<f64>()) / l[i][i];
        }
        for i in (0..3).rev() {
            x[i] = (x[i] - (i + 1..3).map(|k| l[k][i] * x[k]).sum::<f64>()) / l[i][i];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use super::{SUBSTANCES, Substance};
    use crate::fresnel::Fresnel;
    use spectrum::{Basis, Bins, Spectrum};
    use testkit::assert_close;

    fn normal(name: &str, nm: f64) -> f64 {
        let [n, k] = Substance::named(name).unwrap().at(nm);
        Fresnel::from_index([n], [k]).eval(1.0)[0]
    }

    #[test]
    fn tables_ascend_and_cover_what_is_seen() {
        for s in SUBSTANCES {
            assert!(s.rows.windows(2).all(|w| w[0][0] < w[1][0]), "{}", s.name);
            let (first, last) = (s.rows[0][0], s.rows[s.rows.len() - 1][0]);
            assert!(
                first <= 360.0 && last >= 830.0,
                "{}: {first} {last}",
                s.name
            );
            let row = s.rows[3];
            for (nm, expected) in [
                (row[0], [row[1], row[2]]),
                (100.0, s.at(first)),
                (9e9, s.at(last)),
            ] {
                let found = s.at(nm);
                (0..2).for_each(|j| assert_close(found[j], expected[j], 0.0, s.name));
            }
        }
    }

    #[test]
    fn glass_and_diamond_reflect_what_their_makers_say() {
        // n at 587.6 nm: 1.51680 [Schott2017], 1.458 [Malitson1965], 2.417 [Peter1923]; linear by 10 nm errs by 1e-5
        for (name, n) in [("bk7", 1.5168), ("silica", 1.4585), ("diamond", 2.4175)] {
            assert_close(Substance::named(name).unwrap().at(587.6)[0], n, 3e-4, name);
        }
        assert_close(normal("bk7", 587.6), 0.0422, 1e-4, "bk7");
    }

    #[test]
    fn copper_reflects_as_others_measured() {
        // n and k of [Hagemann1975] at 4 wavelengths: other samples, other method. What they differ by, at most 0.0171 at
        // 476.9 nm and 0.0080 at the others, is not our interpolation: their n of 1.152 is below every row around it here,
        // 1.25 and 1.22, at the same k
        for (nm, n, k, apart) in [
            (476.9, 1.152, 2.50, 0.0172),
            (563.6, 0.826, 2.60, 0.0085),
            (619.9, 0.272, 3.24, 0.0085),
            (652.5, 0.214, 3.67, 0.0085),
        ] {
            let theirs = Fresnel::from_index([n], [k]).eval(1.0)[0];
            assert_close(normal("cu", nm), theirs, apart, &format!("{nm} nm"));
        }
    }

    #[test]
    fn metals_have_their_published_colours() {
        // [PhysicallyBased] for copper and iron, from the same measurements under D65; three digits
        for (name, expected) in [("cu", [0.932, 0.623, 0.522]), ("fe", [0.531, 0.512, 0.496])] {
            let rgb: [f64; 3] = Substance::named(name).unwrap().in_srgb().eval(1.0);
            for c in 0..3 {
                assert_close(rgb[c], expected[c], 2e-3, name);
            }
        }
        // and near those of other measurements [AkenineMoller2018, table 9.2]
        for (name, expected) in [
            ("al", [0.913, 0.922, 0.924]),
            ("cr", [0.549, 0.556, 0.554]),
            ("cu", [0.955, 0.638, 0.538]),
            ("ag", [0.972, 0.960, 0.915]),
            ("ni", [0.660, 0.609, 0.526]),
            ("au", [1.022, 0.782, 0.344]),
        ] {
            let rgb: [f64; 3] = Substance::named(name).unwrap().in_srgb().eval(1.0);
            for c in 0..3 {
                assert_close(rgb[c], expected[c], 0.065, name);
            }
        }
    }

    /// Largest error of the mixtures at angles other than those they were fitted at.
    fn worst(substance: &Substance, basis: &Basis, lambda_nm: &[f64]) -> f64 {
        let project = |s: &Spectrum| basis.project(s);
        let seen = substance.seen(lambda_nm, &project);
        let mut worst: f64 = 0.0;
        for k in 0..45 {
            let c = f64::from(2 * k + 1).to_radians().cos();
            let exact = project(&substance.reflectance(c));
            for (i, exact) in exact.iter().enumerate() {
                let taps = super::neighbours(i, seen.len());
                let loss = |j: usize| {
                    1.0 - Fresnel::from_index([seen[taps[j]].n], [seen[taps[j]].k]).eval(c)[0]
                };
                let f = 1.0 - (0..3).map(|j| seen[i].mix[j] * loss(j)).sum::<f64>();
                worst = worst.max((f - exact).abs());
            }
        }
        worst
    }

    #[test]
    fn mixtures_reflect_what_the_channels_see_at_every_angle() {
        for s in SUBSTANCES {
            let bins = |n: usize| Basis::Bins(Bins::uniform(n, [410.0, 690.0]).unwrap());
            let centres = |b: &Basis| match b {
                Basis::Bins(bins) => bins.centres_nm().collect::<Vec<_>>(),
                _ => unreachable!(),
            };
            for (n, limit) in [(8, 2e-4), (16, 1e-4), (45, 3e-5)] {
                let basis = bins(n);
                let error = worst(s, &basis, &centres(&basis));
                println!("{} in {n}: {error:.1e}", s.name);
                assert!(error < limit, "{} in {n}: {error}", s.name);
            }
        }
    }

    #[test]
    fn colours_reflect_what_the_eye_sees_at_every_angle() {
        for s in SUBSTANCES {
            let basis = Basis::Rgb(spectrum::RgbSpace::srgb());
            let fresnel: Fresnel<3> = s.in_srgb();
            for degrees in [0.0, 33.0, 61.0, 77.0, 85.0] {
                let c = f64::to_radians(degrees).cos();
                let exact = basis.project(&s.reflectance(c));
                for (found, exact) in fresnel.eval(c).iter().zip(&exact) {
                    // gold's red and green see an edge, and err most
                    assert_close(*found, *exact, 1e-3, &format!("{} at {degrees}", s.name));
                }
            }
        }
    }
}
