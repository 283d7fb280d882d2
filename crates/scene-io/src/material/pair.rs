//! The concrete pairs of reflectance and sampler.

use crate::cache::{Cache, combine};
use crate::error::Error;
use crate::scene::SamplerName;
use crate::sealed::content_hash;
use brdf::{Brdf, DirectionSampler, Material, Paired};
use brdf_sampling::{
    Cosine, Hvt, Inversion, InversionOptions, Preset, Rejection, RejectionOptions, SharedTarget,
    Target, Uniform,
};
use brdf_table::GriddedN;
use glam::DVec3;
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

/// Pairs `brdf` with the sampler `name` stands for; one instance of this function per kind of reflectance.
pub(super) fn pair<B: Brdf<3> + Clone + 'static>(
    brdf: B,
    name: SamplerName,
    (key, cache): (impl Fn(&B) -> u64, &Cache),
) -> Result<Pair, Error> {
    let start = Instant::now();
    let (material, mut report) = match name {
        SamplerName::Uniform => with(brdf, Uniform, name),
        SamplerName::Cosine => with(brdf, Cosine, name),
        SamplerName::Auto | SamplerName::Hvt => {
            let sampler = tabulate(&brdf, |target| Hvt::new(target, Preset::Default.options()));
            with(brdf, sampler, SamplerName::Hvt)
        }
        SamplerName::Inversion => {
            let sampler = tabulate(&brdf, |t| Inversion::new(t, InversionOptions::default()));
            with(brdf, sampler, name)
        }
        SamplerName::Rejection => {
            let key = key(&brdf);
            rejection(brdf, key, cache)?
        }
        SamplerName::Native => {
            return Err(Error::invalid(
                "expected a material that brings its own sampling (a model) for \"native\", found a table",
            )
            .in_field("sampler"));
        }
    };
    report.build_seconds = start.elapsed().as_secs_f64();
    Ok((material, report))
}

fn with<B: Brdf<3> + 'static, S: DirectionSampler + 'static>(
    brdf: B,
    sampler: S,
    name: SamplerName,
) -> Pair {
    let mut report = SamplerReport::new(name, sampler.bytes());
    report.stratified = sampler.keeps_stratification();
    (Box::new(Paired { brdf, sampler }), report)
}

fn rejection<B: Brdf<3> + Clone + 'static>(
    brdf: B,
    key: u64,
    cache: &Cache,
) -> Result<Pair, Error> {
    let options = RejectionOptions::default();
    let symmetry = brdf.symmetry();
    let target: SharedTarget = {
        let brdf = brdf.clone();
        Arc::new(move |wi, wo| luminance(&brdf, wi, wo))
    };
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
    let (material, mut report) = with(brdf, sampler, SamplerName::Rejection);
    report.notes = notes;
    Ok((material, report))
}

/// Builds a sampler for the luminance of `brdf`.
fn tabulate<S>(brdf: &impl Brdf<3>, build: impl FnOnce(Target<'_>) -> S) -> S {
    let f = |wi, wo| luminance(brdf, wi, wo);
    build(Target {
        f: &f,
        symmetry: brdf.symmetry(),
    })
}

fn luminance(brdf: &impl Brdf<3>, wi: DVec3, wo: DVec3) -> f64 {
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
