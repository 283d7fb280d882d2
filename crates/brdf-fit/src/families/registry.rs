//! Models of the registry that are linear in their weights, one lobe or the sum of several of the same kind.

use super::{
    EXPONENT_RANGE, EXPONENTS, REFLECTANCE_RANGE, REFLECTANCES, ROUGHNESSES, build, channels,
    excess, lambert, numbered, over, times,
};
use crate::family::{Channels, Family, Lobes, Part, Scale, ShapeParameter, Weight};
use glam::DVec3;

/// What is searched for in a model.
#[derive(Clone, Copy, Debug)]
struct Search {
    name: &'static str,
    range: (f64, f64),
    scale: Scale,
    starts: &'static [f64],
}

const fn log(name: &'static str, range: (f64, f64), starts: &'static [f64]) -> Search {
    Search {
        name,
        range,
        scale: Scale::Log,
        starts,
    }
}

/// The range of the registry.
const fn roughness(name: &'static str) -> Search {
    log(name, (1e-4, 1.0), ROUGHNESSES)
}

const EXPONENT: Search = log("n", EXPONENT_RANGE, EXPONENTS);
const F0: Search = Search {
    name: "f0",
    range: REFLECTANCE_RANGE,
    scale: Scale::Logit,
    starts: REFLECTANCES,
};

/// A model of the registry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) name: &'static str,
    search: &'static [Search],
    /// The weight of the lobe.
    weight: &'static str,
    /// Text of what is not searched for.
    fixed: &'static str,
}

impl Entry {
    /// Whether there is a lobe beside the diffuse one, to have several of.
    pub(super) const fn has_lobe(&self) -> bool {
        !self.search.is_empty()
    }

    const fn weighted(self, weight: &'static str) -> Self {
        Self { weight, ..self }
    }

    const fn fixed(self, fixed: &'static str) -> Self {
        Self { fixed, ..self }
    }
}

const fn entry(name: &'static str, search: &'static [Search]) -> Entry {
    Entry {
        name,
        search,
        weight: "ks",
        fixed: "",
    }
}

/// All have `kd`, and a weight of the lobe unless nothing is searched for.
pub(super) const ENTRIES: &[Entry] = &[
    entry("lambert", &[]),
    entry("phong", &[EXPONENT]),
    entry("lewis", &[EXPONENT]),
    entry("blinn-phong", &[EXPONENT]),
    entry("ward", &[roughness("alpha")]),
    entry("ward-cheap", &[roughness("alpha")]),
    entry("ward-duer", &[roughness("alpha")]),
    entry("ward-gmd", &[roughness("alpha")]),
    entry("cook-torrance", &[roughness("m"), F0]),
    entry("cook-torrance-smith", &[roughness("m"), F0]),
    entry("ggx", &[roughness("alpha"), F0]),
    // the published model ties the lobe's weight to its Fresnel term; this is the form with a weight of its own
    entry("ashikhmin-lobe", &[EXPONENT, F0]),
    // the mirror reflection is narrower than any cell: what is fitted is the directional diffuse part
    entry(
        "he",
        &[
            log("sigma", (1e-3, 20.0), &[0.05, 0.25, 1.0]),
            log("tau", (0.05, 1e3), &[1.0, 6.0, 40.0]),
            F0,
        ],
    )
    .fixed(",mirror=0"),
    entry(
        "abc",
        &[
            log("b", (1.0, 1e8), &[10.0, 1e3, 1e5]),
            log("c", (0.01, 10.0), &[0.7, 2.0]),
            log("n", (1.01, 1e3), &[1.4, 10.0]),
        ],
    )
    .weighted("a"),
    entry(
        "abg",
        &[
            log("b", (1e-12, 1e3), &[1e-6, 1e-4, 1e-2, 0.3]),
            log("g", (0.1, 10.0), &[1.5, 3.0]),
        ],
    )
    .weighted("a"),
    entry(
        "harvey-shack",
        &[
            log("l", (1e-5, 10.0), &[1e-3, 1e-2, 0.1, 0.5]),
            Search {
                name: "s",
                range: (-10.0, -0.01),
                scale: Scale::Linear,
                starts: &[-1.5, -4.0],
            },
        ],
    )
    .weighted("b0"),
    // sigma is a factor of the whole lobe, as is its weight: it stays what it is by default
    entry(
        "k-correlation",
        &[
            log("b", (0.01, 1e5), &[0.5, 5.0, 50.0, 500.0]),
            log("s", (2.001, 10.0), &[2.5, 5.0]),
        ],
    ),
];

/// kd/pi + sum over lobes of ks times the lobe of unit weight.
pub(super) struct Registered {
    entry: &'static Entry,
    lobes: usize,
    shape: Vec<ShapeParameter>,
    weights: Vec<Weight>,
}

impl Registered {
    pub(super) fn new(entry: &'static Entry, lobes: usize) -> Self {
        let lobes = if entry.has_lobe() { lobes } else { 0 };
        let shape = (0..lobes).flat_map(|lobe| {
            entry.search.iter().map(move |s| ShapeParameter {
                name: numbered(s.name, lobe),
                range: s.range,
                scale: s.scale,
                starts: s.starts.into(),
            })
        });
        let weight = |name: String| Weight {
            name,
            signed: false,
        };
        let weights = std::iter::once(weight("kd".into()))
            .chain((0..lobes).map(|lobe| weight(numbered(entry.weight, lobe))));
        Self {
            shape: shape.collect(),
            weights: weights.collect(),
            entry,
            lobes,
        }
    }

    /// `name:alpha=0.1,f0=0.04` of one lobe.
    fn text(&self, shape: &[f64], lobe: usize) -> String {
        let n = self.entry.search.len();
        let values = self.entry.search.iter().zip(&shape[lobe * n..]);
        let shape: Vec<String> = values.map(|(s, v)| format!("{}={v}", s.name)).collect();
        format!(
            "{}:{}{}",
            self.entry.name,
            shape.join(","),
            self.entry.fixed
        )
    }

    /// The lobe as the channels of one model, with these weights.
    fn weighted(&self, shape: &[f64], lobe: usize, weight: &str, kd: &str) -> String {
        format!(
            "{},{}={weight},kd={kd}",
            self.text(shape, lobe),
            self.entry.weight
        )
    }
}

impl Family for Registered {
    fn name(&self) -> &str {
        self.entry.name
    }

    fn shape(&self) -> &[ShapeParameter] {
        &self.shape
    }

    fn weights(&self) -> &[Weight] {
        &self.weights
    }

    fn lobes(&self, shape: &[f64]) -> Box<dyn Lobes> {
        let only = |lobe| {
            build::<1>(&format!("{},ks=1,kd=0", self.text(shape, lobe)))
                .built
                .brdf
        };
        match self.lobes {
            0 => Box::new(Channels(build::<1>("lambert:kd=1").built.brdf)),
            1 => {
                let both = self.weighted(shape, 0, "0/1", "1/0");
                Box::new(Channels(build::<2>(&both).built.brdf))
            }
            _ => Box::new(Sum((0..self.lobes)
                .map(|lobe| Channels(only(lobe)))
                .collect())),
        }
    }

    fn parts(&self, shape: &[f64], weights: &[Vec<f64>]) -> Vec<Part> {
        let apart =
            self.lobes == 0 || weights.iter().any(|w| w[0] > 1.0) || self.excess(weights, 0) > 1.0;
        if apart {
            let lobes = (0..self.lobes).map(|lobe| self.part(shape, weights, lobe, false));
            return std::iter::once(lambert(weights, 0)).chain(lobes).collect();
        }
        (0..self.lobes)
            .map(|lobe| self.part(shape, weights, lobe, lobe == 0))
            .collect()
    }
}

impl Registered {
    fn part(&self, shape: &[f64], weights: &[Vec<f64>], lobe: usize, with_diffuse: bool) -> Part {
        let kd = if with_diffuse {
            channels(weights, 0)
        } else {
            "0".into()
        };
        let factor = self.excess(weights, lobe);
        let ks = channels(&over(weights, factor), 1 + lobe);
        let text = self.weighted(shape, lobe, &ks, &kd);
        times(factor, text, weights.len())
    }

    fn excess(&self, weights: &[Vec<f64>], lobe: usize) -> f64 {
        let name = (self.entry.name, self.entry.weight);
        excess(weights, 1 + lobe..2 + lobe, name)
    }
}

/// A Lambert lobe of albedo 1, then others.
pub(super) struct Sum(pub(super) Vec<Channels<1>>);

impl Lobes for Sum {
    fn eval(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) {
        out[0] = std::f64::consts::FRAC_1_PI;
        for (lobe, out) in self.0.iter().zip(out[1..].chunks_exact_mut(1)) {
            lobe.eval(wi, wo, out);
        }
    }
}
