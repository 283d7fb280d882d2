//! The concrete pairs of reflectance and sampler.

use crate::cache::{Cache, combine};
use crate::error::Error;
use crate::scene::SamplerName;
use crate::sealed::content_hash;
use brdf::{Brdf, DirectionSampler, LANES, Lanes3, Material, Paired};
use brdf_sampling::{
    Cosine, Dictionary, Hvt, Inversion, InversionOptions, Preset, Rejection, RejectionOptions,
    SharedTarget, Target, Uniform,
};
use brdf_table::GriddedN;
use glam::DVec3;
use pulp::{Simd, WithSimd};
use spectrum::LUMINANCE_SRGB;
use std::sync::Arc;
use std::time::Instant;

/// Which sampler a material got, and what it cost.
#[derive(Clone, Debug)]
pub struct SamplerReport {
    /// The sampler; never `auto`.
    pub name: SamplerName,
    /// Bytes of its tables.
    pub bytes: usize,
    /// Seconds it took to build.
    pub build_seconds: f64,
    /// Whether it keeps the evenness of low-discrepancy points.
    pub stratified: bool,
    /// What a user may want to know.
    pub notes: Vec<String>,
}

impl SamplerReport {
    pub(super) fn new(name: SamplerName, bytes: usize) -> Self {
        Self {
            name,
            bytes,
            build_seconds: 0.0,
            stratified: true,
            notes: Vec::new(),
        }
    }
}

type Pair = (Box<dyn Material<3>>, SamplerReport);

/// What is done with a sampler once its concrete type is known.
pub(crate) trait Visitor {
    /// What comes of it.
    type Out;
    /// `report` is complete but for the bytes of the tables.
    fn visit<S: DirectionSampler + 'static>(self, sampler: S, report: SamplerReport) -> Self::Out;
}

/// Makes a material of a reflectance and the sampler that comes.
struct Pairing<B>(B);

impl<B: Brdf<3> + 'static> Visitor for Pairing<B> {
    type Out = Pair;

    fn visit<S: DirectionSampler + 'static>(self, sampler: S, report: SamplerReport) -> Pair {
        let report = SamplerReport {
            bytes: sampler.bytes(),
            stratified: sampler.keeps_stratification(),
            ..report
        };
        let brdf = self.0;
        (Box::new(Paired { brdf, sampler }), report)
    }
}

/// Pairs `brdf` with the sampler `name` stands for; one instance of this function per kind of reflectance.
pub(super) fn pair<B: Brdf<3> + Clone + 'static>(
    brdf: B,
    name: SamplerName,
    kept: (impl Fn(&B) -> u64, &Cache),
) -> Result<Pair, Error> {
    let pairing = Pairing(brdf.clone());
    build(&brdf, name, kept, pairing)
}

/// Builds the sampler `name` stands for and hands it to `visitor`.
pub(super) fn build<B: Brdf<3> + Clone + 'static, V: Visitor>(
    brdf: &B,
    name: SamplerName,
    (key, cache): (impl Fn(&B) -> u64, &Cache),
    visitor: V,
) -> Result<V::Out, Error> {
    let start = Instant::now();
    let done = |name| {
        let mut report = SamplerReport::new(name, 0);
        report.build_seconds = start.elapsed().as_secs_f64();
        report
    };
    Ok(match name {
        SamplerName::Uniform => visitor.visit(Uniform, done(name)),
        SamplerName::Cosine => visitor.visit(Cosine, done(name)),
        SamplerName::Auto
        | SamplerName::Hvt
        | SamplerName::HvtTiny
        | SamplerName::HvtFine
        | SamplerName::HvtReference => {
            let (name, preset) = preset(name);
            let sampler = tabulate(brdf, |target| Hvt::new(target, preset.options()));
            visitor.visit(sampler, done(name))
        }
        SamplerName::Inversion => {
            let sampler = tabulate(brdf, |t| Inversion::new(t, InversionOptions::default()));
            visitor.visit(sampler, done(name))
        }
        SamplerName::Dictionary => {
            let sampler = tabulate(brdf, Dictionary::new);
            visitor.visit(sampler, done(name))
        }
        SamplerName::GgxSingle => {
            let sampler = tabulate(brdf, Dictionary::single);
            visitor.visit(sampler, done(name))
        }
        SamplerName::Rejection => {
            let (sampler, notes) = rejection(brdf.clone(), key(brdf), cache)?;
            let report = SamplerReport {
                notes,
                ..done(name)
            };
            visitor.visit(sampler, report)
        }
        SamplerName::Native => {
            return Err(Error::invalid(
                "expected a material that brings its own sampling (a model) for \"native\", found a table",
            )
            .in_field("sampler"));
        }
    })
}

/// The name a half-vector table goes by, and its size.
fn preset(name: SamplerName) -> (SamplerName, Preset) {
    match name {
        SamplerName::HvtTiny => (name, Preset::Tiny),
        SamplerName::HvtFine => (name, Preset::Fine),
        SamplerName::HvtReference => (name, Preset::Reference),
        _ => (SamplerName::Hvt, Preset::Default),
    }
}

fn rejection<B: Brdf<3> + 'static>(
    brdf: B,
    key: u64,
    cache: &Cache,
) -> Result<(Rejection, Vec<String>), Error> {
    let options = RejectionOptions::default();
    let symmetry = brdf.symmetry();
    let target: SharedTarget = Arc::new(move |wi, wo| luminance(&brdf, wi, wo));
    let n_phi = if symmetry.isotropic { 1 } else { options.n_phi };
    let sizes = [
        options.n_theta as u64,
        n_phi as u64,
        options.proposal as u64,
    ];
    let mut notes = Vec::new();
    let maxima = cache.rejection(
        combine(&[key, sizes[0], sizes[1], sizes[2]]),
        &mut notes,
        || {
            Rejection::new(Arc::clone(&target), symmetry, options)
                .cache()
                .clone()
        },
    );
    let sampler = Rejection::from_cache(target, maxima, options.max_tries)
        .map_err(|e| Error::invalid(e.to_string()).in_field("sampler"))?;
    Ok((sampler, notes))
}

/// Builds a sampler for the luminance of `brdf`.
fn tabulate<B: Brdf<3>, S>(brdf: &B, build: impl FnOnce(Target<'_>) -> S) -> S {
    let f = |wi, wo| luminance(brdf, wi, wo);
    let lanes = |wi: &Lanes3, wo: &Lanes3| brdf::arch().dispatch(LuminanceLanes(brdf, wi, wo));
    build(Target {
        f: &f,
        lanes: Some(&lanes),
        symmetry: brdf.symmetry(),
    })
}

/// [`luminance`] of a packet.
struct LuminanceLanes<'a, B>(&'a B, &'a Lanes3, &'a Lanes3);

impl<B: Brdf<3>> WithSimd for LuminanceLanes<'_, B> {
    type Output = [f32; LANES];

    #[inline(always)]
    fn with_simd<I: Simd>(self, _: I) -> [f32; LANES] {
        let f = self.0.eval_lanes(self.1, self.2);
        let weights = LUMINANCE_SRGB.map(|w| w as f32);
        let mut sum = [0.0; LANES];
        for c in 0..3 {
            for k in 0..LANES {
                sum[k] += weights[c] * f[c][k];
            }
        }
        sum
    }
}

pub(crate) fn luminance(brdf: &(impl Brdf<3> + ?Sized), wi: DVec3, wo: DVec3) -> f64 {
    let f = brdf.eval(wi, wo);
    f.iter().zip(LUMINANCE_SRGB).map(|(v, w)| v * w).sum()
}

/// Tells tables apart by all their values, the same on every machine.
pub(super) fn table_key(grid: &GriddedN<3>) -> u64 {
    let table = grid.table();
    let layout = format!(
        "{:?} {:?} {:?}",
        table.dims(),
        table.phi_domain(),
        grid.interpolation()
    );
    let mut key = content_hash(layout.as_bytes());
    let mut slab = Vec::new();
    let [_, n_d, n_p] = table.dims();
    for (k, cell) in table.cell_indices().enumerate() {
        for value in table.value(cell).unwrap_or_default() {
            slab.extend_from_slice(&value.to_bits().to_le_bytes());
        }
        if (k + 1) % (n_d * n_p) == 0 {
            key = combine(&[key, content_hash(&slab)]);
            slab.clear();
        }
    }
    key
}
