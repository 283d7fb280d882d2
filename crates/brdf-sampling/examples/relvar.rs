//! Relative variance, cost and size of the samplers on measured files: MERL, Cornell (through the grid that rendering
//! reads) and RGL.
//!
//! `cargo run --release -p brdf-sampling --example relvar -- [--methods=default,fine,cosine] [--colour] FILE ...`
//!
//! Nanoseconds are the best of 40 runs. With `--colour` the target is the one for all channels: then `albedo^2 - 1` is
//! the floor J* of the variance averaged over channels, and the sampler's own variance comes on top as a factor.
#![expect(clippy::print_stdout, reason = "a program")]
#![expect(clippy::disallowed_methods, reason = "reads the files it is told")]

use brdf::{DirectionSampler, Measured, direction};
use brdf_formats::File;
use brdf_sampling::{
    ColourTarget, Cosine, Dictionary, Hvt, HvtOptions, Inversion, InversionOptions, Preset, Target,
    relative_variance,
};
use brdf_table::scattered::{DEFAULT_DIMS, Domain};
use brdf_table::{
    CellPolicy, Gridded, HalfDiffTable, Interpolation, RglTable, SampleCloud, ThinPlate, resample,
};
use glam::{DVec2, DVec3};
use std::error::Error;
use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

const SHOWN_DEG: [f64; 7] = [0.0, 15.0, 30.0, 45.0, 60.0, 75.0, 85.0];
const SAMPLES: usize = 20_000;

/// 24 viewers between 1 and 86 degrees, on no grid.
fn off_grid(k: usize) -> f64 {
    1.37 + 3.61 * k as f64
}

fn load(path: &str) -> Result<Arc<dyn Measured>, Box<dyn Error>> {
    let linear = |table: HalfDiffTable| Gridded {
        table: Arc::new(table),
        interpolation: Interpolation::Linear,
    };
    let cloud = match brdf_formats::read(std::fs::read(path)?)? {
        File::Merl(file) => {
            let (table, _) = HalfDiffTable::from_merl(&file, CellPolicy::AnyNegative)?;
            return Ok(Arc::new(linear(table)));
        }
        File::Rgl(file) => return Ok(Arc::new(RglTable::new(&file)?)),
        File::Astm(file) => SampleCloud::from_astm(&file)?,
        File::PbrtText(file) => SampleCloud::from_pbrt_text(&file)?,
        _ => return Err("no table is made of this format here".into()),
    };
    let resampled = resample(&ThinPlate::new(&cloud)?, &Domain::new(&cloud), DEFAULT_DIMS);
    Ok(Arc::new(linear(resampled.table)))
}

/// The native channels of a table, up to as many as spectral files have.
fn channels(table: &dyn Measured, wi: DVec3, wo: DVec3) -> [f64; 80] {
    let mut out = [0.0; 80];
    table.eval_native(wi, wo, &mut out[..table.basis().len()]);
    out
}

enum Method {
    Cosine,
    Inversion,
    Single,
    Dictionary,
    Hvt(HvtOptions),
}

impl Method {
    fn parse(name: &str) -> Option<Self> {
        Some(match name {
            "cosine" => Self::Cosine,
            "inversion" => Self::Inversion,
            "ggx" => Self::Single,
            "dictionary" => Self::Dictionary,
            _ => Self::Hvt(options(name)?),
        })
    }

    fn build(&self, target: Target<'_>) -> Box<dyn DirectionSampler> {
        match self {
            Self::Cosine => Box::new(Cosine),
            Self::Inversion => Box::new(Inversion::new(target, InversionOptions::default())),
            Self::Single => Box::new(Dictionary::single(target)),
            Self::Dictionary => Box::new(Dictionary::new(target)),
            Self::Hvt(options) => Box::new(Hvt::new(target, *options)),
        }
    }
}

fn options(name: &str) -> Option<HvtOptions> {
    let named = |p: &&Preset| format!("{p:?}").eq_ignore_ascii_case(name);
    if let Some(p) = Preset::ALL.iter().find(named) {
        return Some(p.options());
    }
    let n: Vec<usize> = name.split('x').map_while(|s| s.parse().ok()).collect();
    let mut o = Preset::Default.options();
    [o.n_theta, o.n_a, o.n_b] = *n.first_chunk::<3>()?;
    Some(o)
}

struct Row {
    bytes: usize,
    shown: Vec<f64>,
    mean: f64,
    worst: f64,
    max_weight: f64,
    wasted: f64,
    albedo: f64,
    build_ms: f64,
    sample_ns: f64,
    pdf_ns: f64,
}

fn measure(target: Target<'_>, build: &dyn Fn() -> Box<dyn DirectionSampler>) -> Row {
    let start = Instant::now();
    let sampler = build();
    let build_ms = start.elapsed().as_secs_f64() * 1e3;
    let at = |deg: f64| relative_variance(target, &*sampler, deg, SAMPLES);
    let shown = SHOWN_DEG.iter().map(|&d| at(d).value).collect();
    let all: Vec<_> = (0..24).map(|k| at(off_grid(k))).collect();
    let (sample_ns, pdf_ns) = cost(&*sampler);
    Row {
        bytes: sampler.bytes(),
        shown,
        mean: all.iter().map(|v| v.value).sum::<f64>() / 24.0,
        worst: all.iter().fold(0.0, |m, v| v.value.max(m)),
        max_weight: all.iter().fold(0.0, |m, v| v.max_weight.max(m)),
        wasted: all.iter().fold(0.0, |m, v| v.wasted.max(m)),
        albedo: all.iter().map(|v| v.albedo).sum::<f64>() / 24.0,
        build_ms,
        sample_ns,
        pdf_ns,
    }
}

/// Nanoseconds of sample and pdf.
fn cost(sampler: &dyn DirectionSampler) -> (f64, f64) {
    let mut rng = sampling::Rng::new(5);
    let inputs: Vec<(DVec3, DVec2)> = (0..4_000)
        .map(|_| {
            (
                direction(1.5 * rng.uniform(), 6.0 * rng.uniform()),
                rng.uniform2(),
            )
        })
        .collect();
    let best = |f: &dyn Fn()| {
        let mut best = f64::INFINITY;
        for _ in 0..40 {
            let start = Instant::now();
            f();
            best = best.min(start.elapsed().as_secs_f64() * 1e9 / inputs.len() as f64);
        }
        best
    };
    let sample_ns = best(&|| {
        for (wo, u) in &inputs {
            black_box(sampler.sample(*wo, *u));
        }
    });
    let wi: Vec<DVec3> = inputs
        .iter()
        .filter_map(|(wo, u)| sampler.sample(*wo, *u).map(|s| s.wi))
        .collect();
    let pdf_ns = best(&|| {
        for ((wo, _), wi) in inputs.iter().zip(&wi) {
            black_box(sampler.pdf(*wi, *wo));
        }
    });
    (sample_ns, pdf_ns)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut names = vec!["default".to_string()];
    let (mut files, mut colour) = (Vec::new(), false);
    for arg in std::env::args().skip(1) {
        match arg.strip_prefix("--methods=") {
            Some(list) => names = list.split(',').map(String::from).collect(),
            None if arg == "--colour" => colour = true,
            None => files.push(arg),
        }
    }
    let (sample_ns, pdf_ns) = cost(&Cosine);
    println!("for comparison, cosine: {sample_ns:.1} ns sample, {pdf_ns:.1} ns pdf");
    let mut tables = Vec::new();
    for path in &files {
        tables.push((path.rsplit('/').next().unwrap_or(path), load(path)?));
    }
    for name in &names {
        let method = Method::parse(name)
            .ok_or("methods: a preset, AxBxC, cosine, inversion, ggx, dictionary")?;
        let mut means = Vec::new();
        println!(
            "## {name}\nmaterial | bytes | build ms | ns sample | ns pdf | {SHOWN_DEG:?} | {SUMMARY}"
        );
        for (stem, table) in &tables {
            let weights = table.basis().luminance_weights();
            let luminance = |wi: DVec3, wo: DVec3| {
                let values = channels(&**table, wi, wo);
                values.iter().zip(&weights).map(|(v, w)| v * w).sum()
            };
            let all = |wi: DVec3, wo: DVec3, out: &mut [f64]| {
                out.copy_from_slice(&channels(&**table, wi, wo)[..out.len()]);
            };
            let star = colour.then(|| ColourTarget::new(all, weights.len()));
            let f = |wi: DVec3, wo: DVec3| match &star {
                Some(star) => star.eval(wi, wo),
                None => luminance(wi, wo),
            };
            let target = Target::new(&f);
            let row = measure(target, &|| method.build(target));
            print_row(stem, &row);
            means.push(row.mean);
        }
        means.sort_by(f64::total_cmp);
        if let (Some(median), Some(worst)) = (means.get(means.len() / 2), means.last()) {
            println!("median {median:.5}  worst {worst:.5}");
        }
    }
    Ok(())
}

/// What follows the angles in a row.
const SUMMARY: &str = "mean | worst angle | max w | wasted | albedo";

fn print_row(stem: &str, row: &Row) {
    let shown: Vec<String> = row.shown.iter().map(|v| format!("{v:.5}")).collect();
    println!(
        "{stem:30} | {} | {:.0} | {:.0} | {:.0} | {} | {:.5} | {:.5} | {:.2} | {:.4} | {:.4}",
        row.bytes,
        row.build_ms,
        row.sample_ns,
        row.pdf_ns,
        shown.join(" "),
        row.mean,
        row.worst,
        row.max_weight,
        row.wasted,
        row.albedo
    );
}
