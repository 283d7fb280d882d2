//! Models that know more than three wavelengths: in any channels, and at wavelengths that differ from path to path.

use brdf::{
    Brdf, HERO, LANES, Lanes3, ROTATIONS, RotatedTable, Rotation, Symmetry, TaggedBrdf, rotated,
};
use glam::DVec3;
use spectrum::Spectrum;
use std::sync::Arc;

use crate::fresnel::{Fresnel, Unpolarised32};
use crate::he::He;
use crate::index::Substance;
use crate::k_correlation::KCorrelation;
use crate::registry::{ParsedModel, Values, build_model, microfacet};

/// The channels of a render, as a model has to know them.
#[derive(Clone, Copy)]
#[expect(missing_debug_implementations, reason = "closures have none")]
pub struct Seeing<'a> {
    /// The mean wavelength of every channel, nm.
    pub lambda_nm: &'a [f64],
    /// What every channel sees of a reflectance by wavelength.
    pub project: &'a dyn Fn(&Spectrum) -> Vec<f64>,
    /// What one unit of each channel of linear sRGB is in every channel.
    pub uplift: [&'a [f64]; 3],
}

impl Seeing<'_> {
    /// A weight in every channel: one for all of them, or a linear sRGB colour.
    fn weight(&self, values: &Values, name: &str) -> Vec<f64> {
        match values.get(name) {
            [r, g, b] => (0..self.lambda_nm.len())
                .map(|c| r * self.uplift[0][c] + g * self.uplift[1][c] + b * self.uplift[2][c])
                .collect(),
            one => vec![one.first().copied().unwrap_or(f64::NAN); self.lambda_nm.len()],
        }
    }

    fn fitted<const N: usize>(values: Vec<f64>) -> [f64; N] {
        std::array::from_fn(|c| values.get(c).copied().unwrap_or(f64::NAN))
    }
}

/// A model with an index by wavelength, or with waves of the length of each channel.
#[derive(Clone)]
#[expect(missing_debug_implementations, reason = "trait objects have none")]
pub struct SpectralModel {
    values: Values,
    kind: Kind,
}

#[derive(Clone)]
enum Kind {
    /// Facets of a substance: their lobe at a reflectance of 1.
    Facets(Arc<dyn Brdf<1>>, &'static Substance),
    He(Option<&'static Substance>),
    KCorrelation,
}

impl ParsedModel<3> {
    /// The model by wavelength, if it says more there than in linear sRGB.
    #[must_use]
    pub fn spectral(&self) -> Option<SpectralModel> {
        let substance = self.values.choice("index").and_then(Substance::named);
        let waves = self.values.get("lambda").len() == 3;
        let kind = match (self.info.name, substance) {
            // an index told in RGB says nothing by wavelength
            ("he", None) if waves && self.grey(&["f0", "n", "k"]) => Kind::He(None),
            ("he", Some(substance)) => Kind::He(Some(substance)),
            ("k-correlation", _) if waves => Kind::KCorrelation,
            (_, Some(substance)) => Kind::Facets(self.bare_lobe()?, substance),
            _ => return None,
        };
        Some(SpectralModel {
            values: self.values.clone(),
            kind,
        })
    }

    fn grey(&self, names: &[&str]) -> bool {
        names.iter().all(|name| self.values.get(name).len() <= 1)
    }

    /// The lobe alone, of weight 1 and with facets that reflect everything.
    fn bare_lobe(&self) -> Option<Arc<dyn Brdf<1>>> {
        let kept = (self.values.iter()).filter(|(name, _)| !["index", "ks", "kd"].contains(name));
        let values: Vec<(&str, &[f64])> = kept
            .chain([("f0", &[1.0][..]), ("ks", &[1.0]), ("kd", &[0.0])])
            .collect();
        build_model::<1>(self.info, &values)
            .ok()
            .map(|m| m.built.brdf)
    }
}

impl SpectralModel {
    /// In the `N` channels of `seeing`.
    #[must_use]
    pub fn in_channels<const N: usize>(&self, seeing: &Seeing<'_>) -> Arc<dyn Brdf<N>> {
        let values = &self.values;
        let (ks, kd) = (seeing.weight(values, "ks"), seeing.weight(values, "kd"));
        let (specular, diffuse) = (Seeing::fitted(ks), Seeing::fitted(kd));
        let waves = values.get("lambda").len() == 3;
        let lambda_nm = if waves {
            Seeing::fitted(seeing.lambda_nm.to_vec())
        } else {
            values.channels("lambda")
        };
        let of = |s: &Substance| Fresnel::seen(&s.seen(seeing.lambda_nm, seeing.project));
        match &self.kind {
            Kind::Facets(lobe, substance) => Arc::new(Tinted {
                lobe: Arc::clone(lobe),
                fresnel: of(substance),
                specular,
                diffuse,
            }),
            Kind::He(substance) => Arc::new(He {
                sigma_um: values.scalar("sigma"),
                tau_um: values.scalar("tau"),
                lambda_nm,
                fresnel: substance.map_or_else(|| microfacet::fresnel(values), of),
                specular,
                diffuse,
                mirror: values.scalar("mirror"),
                mirror_width: values.scalar("width"),
            }),
            Kind::KCorrelation => Arc::new(KCorrelation {
                sigma_nm: values.scalar("sigma"),
                b_um: values.scalar("b"),
                slope: values.scalar("s"),
                lambda_nm,
                specular,
                diffuse,
            }),
        }
    }

    /// At wavelengths that differ from path to path: `seeing` has the channel `c * ROTATIONS + r` for wavelength c of
    /// rotation r. Channels are narrow: each has the index of its own wavelength.
    #[must_use]
    pub fn hero(&self, seeing: &Seeing<'_>) -> Arc<dyn TaggedBrdf<HERO, Rotation>> {
        if let Kind::Facets(lobe, substance) = &self.kind {
            let index: Vec<[f64; 2]> = seeing
                .lambda_nm
                .iter()
                .map(|nm| substance.at(*nm))
                .collect();
            return Arc::new(HeroTinted {
                lobe: Arc::clone(lobe),
                fresnel: std::array::from_fn(|r| {
                    std::array::from_fn(|c| {
                        let [n, k] = index
                            .get(c * ROTATIONS + r)
                            .copied()
                            .unwrap_or([f64::NAN; 2]);
                        Unpolarised32::new(n, k)
                    })
                }),
                specular: rotated(&seeing.weight(&self.values, "ks")),
                diffuse: rotated(&seeing.weight(&self.values, "kd")),
            });
        }
        Arc::new(HeroEach(
            (0..ROTATIONS)
                .map(|r| {
                    let pick = |v: &[f64]| -> Vec<f64> {
                        v.iter().skip(r).step_by(ROTATIONS).copied().collect()
                    };
                    let uplift = seeing.uplift.map(pick);
                    let project =
                        |s: &Spectrum| pick(seeing.lambda_nm).iter().map(|nm| s.at(*nm)).collect();
                    self.in_channels(&Seeing {
                        lambda_nm: &pick(seeing.lambda_nm),
                        project: &project,
                        uplift: std::array::from_fn(|c| &*uplift[c]),
                    })
                })
                .collect(),
        ))
    }
}

/// A grey lobe times the reflectance of its facets, over Lambert: f = kd/pi + ks F L.
struct Tinted<const N: usize> {
    lobe: Arc<dyn Brdf<1>>,
    fresnel: Fresnel<N>,
    specular: [f64; N],
    diffuse: [f64; N],
}

impl<const N: usize> Brdf<N> for Tinted<N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let Some(half) = crate::half::Half::new(wi, wo) else {
            return [0.0; N];
        };
        let [lobe] = self.lobe.eval(wi, wo);
        let f = self.fresnel.eval_at(half.cos_d(), half.sin2_d());
        std::array::from_fn(|c| {
            self.diffuse[c] * std::f64::consts::FRAC_1_PI + self.specular[c] * f[c] * lobe
        })
    }

    fn symmetry(&self) -> Symmetry {
        self.lobe.symmetry()
    }

    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        let at = Angles::new(wi, wo);
        let [lobe] = self.lobe.eval_lanes(wi, wo);
        let mut f = self.fresnel.eval_lanes(&at.cos_d, &at.sin2_d);
        for c in 0..N {
            let (ks, kd) = (self.specular[c] as f32, self.diffuse[c] as f32);
            for k in 0..LANES {
                f[c][k] = kd * at.diffuse[k] + ks * f[c][k] * lobe[k];
            }
        }
        f
    }
}

/// What a packet needs beside its lobe.
struct Angles {
    cos_d: [f32; LANES],
    sin2_d: [f32; LANES],
    /// 1/pi above the horizon.
    diffuse: [f32; LANES],
}

impl Angles {
    #[inline(always)]
    fn new(wi: &Lanes3, wo: &Lanes3) -> Self {
        let mut at = Self {
            cos_d: [0.0; LANES],
            sin2_d: [0.0; LANES],
            diffuse: crate::lanes::above(wi, wo).map(|a| a * std::f32::consts::FRAC_1_PI),
        };
        for k in 0..LANES {
            let (x, y, z) = (wi.x[k] + wo.x[k], wi.y[k] + wo.y[k], wi.z[k] + wo.z[k]);
            at.cos_d[k] = (0.5 * (x * x + y * y + z * z).sqrt()).min(1.0);
            let (x, y, z) = (wi.x[k] - wo.x[k], wi.y[k] - wo.y[k], wi.z[k] - wo.z[k]);
            at.sin2_d[k] = (0.25 * (x * x + y * y + z * z)).min(1.0);
        }
        at
    }
}

/// [`Tinted`] at the wavelengths of each path.
struct HeroTinted {
    lobe: Arc<dyn Brdf<1>>,
    fresnel: [[Unpolarised32; HERO]; ROTATIONS],
    specular: RotatedTable,
    diffuse: RotatedTable,
}

impl TaggedBrdf<HERO, Rotation> for HeroTinted {
    fn eval_tagged(
        &self,
        wi: &Lanes3,
        wo: &Lanes3,
        tags: &[Rotation; LANES],
    ) -> [[f32; LANES]; HERO] {
        let at = Angles::new(wi, wo);
        let [lobe] = self.lobe.eval_lanes(wi, wo);
        let mut out = [[0.0; LANES]; HERO];
        for k in 0..LANES {
            let r = tags[k].index();
            for c in 0..HERO {
                let f = self.fresnel[r][c].at(at.cos_d[k], at.sin2_d[k]);
                out[c][k] = self.diffuse[r][c] * at.diffuse[k] + self.specular[r][c] * f * lobe[k];
            }
        }
        out
    }
}

/// A model for every rotation, asked lane by lane.
struct HeroEach(Vec<Arc<dyn Brdf<HERO>>>);

impl TaggedBrdf<HERO, Rotation> for HeroEach {
    fn eval_tagged(
        &self,
        wi: &Lanes3,
        wo: &Lanes3,
        tags: &[Rotation; LANES],
    ) -> [[f32; LANES]; HERO] {
        let mut out = [[0.0; LANES]; HERO];
        for k in 0..LANES {
            let model = &self.0[tags[k].index()];
            let f = model.eval(wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
            (0..HERO).for_each(|c| out[c][k] = f[c] as f32);
        }
        out
    }
}

#[cfg(test)]
mod tests {
    use super::Seeing;
    use crate::index::Substance;
    use crate::{parse_model, parse_model_n};
    use brdf::{Brdf, HERO, LANES, Lanes3, ROTATIONS, Rotation, direction};
    use spectrum::{Basis, LinearUplift, RgbSpace, Spectrum};
    use std::sync::Arc;
    use testkit::assert_relative;

    struct Bands(Vec<f64>, [Vec<f64>; 3]);

    impl Bands {
        fn new(lambda_nm: Vec<f64>) -> Self {
            let uplift = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|rgb| {
                let s = LinearUplift::spectrum(rgb);
                lambda_nm.iter().map(|nm| s.at(*nm)).collect()
            });
            Self(lambda_nm, uplift)
        }

        fn ask<T>(&self, f: impl FnOnce(&Seeing<'_>) -> T) -> T {
            let project = |s: &Spectrum| self.0.iter().map(|nm| s.at(*nm)).collect();
            f(&Seeing {
                lambda_nm: &self.0,
                project: &project,
                uplift: std::array::from_fn(|c| &*self.1[c]),
            })
        }
    }

    fn bands() -> Bands {
        Bands::new((0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect())
    }

    fn pairs() -> [(glam::DVec3, glam::DVec3); 4] {
        [
            (0.1, 0.2, 3.0),
            (0.9, 0.8, 3.1),
            (1.5, 1.5, 2.9),
            (0.3, 1.2, 1.0),
        ]
        .map(|(i, o, phi)| (direction(i, 0.0), direction(o, phi)))
    }

    #[test]
    fn every_band_has_the_index_of_its_wavelength() {
        for text in [
            "ggx:alpha=0.3",
            "cook-torrance:m=0.4",
            "cook-torrance-smith:m=0.4",
            "he:sigma=0.3,tau=2,width=0.1",
        ] {
            let waves = if text.starts_with("he") {
                ",lambda=rgb"
            } else {
                ""
            };
            let model = parse_model(&format!("{text}{waves},index=au,ks=0.9,kd=0.1")).unwrap();
            let spectral: Arc<dyn Brdf<31>> =
                bands().ask(|seeing| model.spectral().unwrap().in_channels(seeing));
            for (c, nm) in bands().0.into_iter().enumerate() {
                let [n, k] = Substance::named("au").unwrap().at(nm);
                let waves = if text.starts_with("he") {
                    format!(",lambda={nm}")
                } else {
                    String::new()
                };
                let single = format!("{text}{waves},n={n},k={k},ks=0.9,kd=0.1");
                let single = parse_model_n::<1>(&single).unwrap().built.brdf;
                for (wi, wo) in pairs() {
                    // tables are by 5 nm, mixtures fitted: bands at even tens meet their own rows but for edges
                    let (found, exact) = (spectral.eval(wi, wo)[c], single.eval(wi, wo)[0]);
                    assert_relative(found, exact, 1e-3, &format!("{text} at {nm} nm"));
                }
            }
        }
    }

    #[test]
    fn lanes_follow_in_channels_and_in_rotations() {
        let model = parse_model("ggx:alpha=0.3,index=cu,ks=0.9/0.8/0.7,kd=0.1/0.2/0.3").unwrap();
        let model = model.spectral().unwrap();
        let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
        for k in 0..LANES {
            wi.set(k, direction(0.09 * k as f64, 0.4 * k as f64).as_vec3());
            wo.set(k, direction(0.5, 1.0).as_vec3());
        }
        let fixed: Arc<dyn Brdf<31>> = bands().ask(|seeing| model.in_channels(seeing));
        let lanes = fixed.eval_lanes(&wi, &wo);
        let n = HERO * ROTATIONS;
        let hero = Bands::new(
            (0..n)
                .map(|k| 400.0 + 300.0 * (k as f64 + 0.5) / n as f64)
                .collect(),
        );
        let tags: [Rotation; LANES] = std::array::from_fn(|k| Rotation::new(9 * k as u32));
        let tagged = hero
            .ask(|seeing| model.hero(seeing))
            .eval_tagged(&wi, &wo, &tags);
        for k in 0..LANES {
            let (i, o) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
            let exact = fixed.eval(i, o);
            for c in 0..31 {
                // f32 rounding of a lobe 0.3 wide
                assert!((f64::from(lanes[c][k]) - exact[c]).abs() < 2e-5 * exact[c].max(0.05));
            }
            let own = Bands::new(
                (0..HERO)
                    .map(|c| hero.0[c * ROTATIONS + tags[k].index()])
                    .collect(),
            );
            let each: Arc<dyn Brdf<HERO>> = own.ask(|seeing| model.in_channels(seeing));
            for (c, exact) in each.eval(i, o).into_iter().enumerate() {
                // between rows of the table the index is linear here, the reflectance (by 5 nm) there
                let found = f64::from(tagged[c][k]);
                assert!(
                    (found - exact).abs() < 4e-3 * exact.max(0.05),
                    "{found} {exact}"
                );
            }
        }
    }

    #[test]
    fn channels_of_colours_are_those_of_rgb() {
        let basis = Basis::Rgb(RgbSpace::srgb());
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let project = |s: &Spectrum| basis.project(s);
        let model = parse_model("ggx:alpha=0.3,index=cu,kd=0.1/0.2/0.3").unwrap();
        let seeing = Seeing {
            lambda_nm: &[611.4, 549.1, 464.2],
            project: &project,
            uplift: std::array::from_fn(|c| &unit[c][..]),
        };
        let spectral: Arc<dyn Brdf<3>> = model.spectral().unwrap().in_channels(&seeing);
        for (wi, wo) in pairs() {
            let (a, b) = (spectral.eval(wi, wo), model.built.brdf.eval(wi, wo));
            (0..3).for_each(|c| assert_relative(a[c], b[c], 1e-5, "six decimals of the table"));
        }
    }

    #[test]
    fn only_what_depends_on_wavelength_is_spectral() {
        for (text, expected) in [
            ("ggx:alpha=0.3", false),
            ("ggx:n=1.5", false),
            ("ggx:index=water", true),
            ("he:sigma=0.1", false),
            ("he:lambda=rgb", true),
            ("he:lambda=rgb,f0=0.1/0.2/0.3", false),
            ("k-correlation:lambda=rgb", true),
            ("lambert", false),
        ] {
            let model = parse_model(text).unwrap();
            assert_eq!(model.spectral().is_some(), expected, "{text}");
        }
    }
}
