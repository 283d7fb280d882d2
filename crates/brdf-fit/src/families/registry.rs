//! Models of the registry that are linear in their weights, one lobe or the sum of several of the same kind.

use super::{ROUGHNESSES, build, channels, exponent, lambert, numbered, reflectance, whole};
use crate::family::{Channels, Family, Lobes, Part, Scale, ShapeParameter, Weight};
use glam::DVec3;

/// What is searched for in a model.
#[derive(Clone, Copy, Debug)]
enum Search {
    /// A roughness of this name.
    Roughness(&'static str),
    /// The exponent `n`.
    Exponent,
    /// The reflectance `f0`.
    F0,
}

/// A model of the registry.
#[derive(Clone, Copy, Debug)]
pub(super) struct Entry {
    pub(super) name: &'static str,
    search: &'static [Search],
}

impl Entry {
    /// Whether there is a lobe beside the diffuse one, to have several of.
    pub(super) const fn has_lobe(&self) -> bool {
        !self.search.is_empty()
    }
}

const fn entry(name: &'static str, search: &'static [Search]) -> Entry {
    Entry { name, search }
}

/// All have `kd`, and `ks` unless nothing is searched for.
pub(super) const ENTRIES: &[Entry] = &[
    entry("lambert", &[]),
    entry("phong", &[Search::Exponent]),
    entry("lewis", &[Search::Exponent]),
    entry("blinn-phong", &[Search::Exponent]),
    entry("ward", &[Search::Roughness("alpha")]),
    entry("ward-cheap", &[Search::Roughness("alpha")]),
    entry("ward-duer", &[Search::Roughness("alpha")]),
    entry("ward-gmd", &[Search::Roughness("alpha")]),
    entry("cook-torrance", &[Search::Roughness("m"), Search::F0]),
    entry("ggx", &[Search::Roughness("alpha"), Search::F0]),
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
            entry.search.iter().map(move |s| match s {
                Search::Roughness(name) => roughness(name, lobe),
                Search::Exponent => exponent(lobe),
                Search::F0 => reflectance("f0", lobe),
            })
        });
        let weight = |name: String| Weight {
            name,
            signed: false,
        };
        let weights = std::iter::once(weight("kd".into()))
            .chain((0..lobes).map(|lobe| weight(numbered("ks", lobe))));
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
        let shape: Vec<String> = values
            .map(|(s, v)| match s {
                Search::Roughness(name) => format!("{name}={v}"),
                Search::Exponent => format!("n={v}"),
                Search::F0 => format!("f0={v}"),
            })
            .collect();
        format!("{}:{}", self.entry.name, shape.join(","))
    }
}

fn roughness(name: &str, lobe: usize) -> ShapeParameter {
    ShapeParameter {
        name: numbered(name, lobe),
        range: (1e-4, 1.0),
        scale: Scale::Log,
        starts: ROUGHNESSES.into(),
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
                let both = format!("{},ks=0/1,kd=1/0", self.text(shape, 0));
                Box::new(Channels(build::<2>(&both).built.brdf))
            }
            _ => Box::new(Sum((0..self.lobes)
                .map(|lobe| Channels(only(lobe)))
                .collect())),
        }
    }

    fn parts(&self, shape: &[f64], weights: &[Vec<f64>]) -> Vec<Part> {
        let diffuse_fits = weights.iter().all(|w| w[0] <= 1.0);
        if self.lobes == 0 || !diffuse_fits {
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
        let text = format!(
            "{},ks={},kd={kd}",
            self.text(shape, lobe),
            channels(weights, 1 + lobe)
        );
        whole(text, weights.len())
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
