//! Relative variance, cost and size of the samplers on measured files: MERL, Cornell (through the grid that rendering
//! reads) and RGL.
//!
//! `cargo run --release -p brdf-sampling --example relvar -- [--methods=default,fine,cosine] [--colour] FILE ...`
//!
//! With `--averaged` samplers see the mean over the azimuth only. Nanoseconds are the best of 40 runs. With `--colour` the target is the one for all channels: then `albedo^2 - 1` is
//! the floor J* of the variance averaged over channels, and the sampler's own variance comes on top as a factor.
#![expect(clippy::print_stdout, reason = "a program")]
#![expect(clippy::disallowed_methods, reason = "reads the files it is told")]

use brdf::{Computed, DirectionSampler, Measured};
use brdf_formats::File;
use brdf_models::parse_model;
use brdf_sampling::{
    ColourTarget, Cosine, Dictionary, Hvt, HvtOptions, Inversion, InversionOptions, Preset,
    SHOWN_DEG, SamplerCost, SamplerReport, Target, sampler_cost, sampler_report,
};
use brdf_table::scattered::{DEFAULT_DIMS, Domain};
use brdf_table::{
    CellPolicy, Gridded, HalfDiffTable, Interpolation, RglTable, SampleCloud, ThinPlate, resample,
};
use glam::DVec3;
use std::error::Error;
use std::sync::Arc;
use std::time::Instant;

const SAMPLES: usize = 20_000;

/// A file, or a model if the text has a colon and no such file is there.
fn load(path: &str) -> Result<Arc<dyn Measured>, Box<dyn Error>> {
    if path.contains(':') && !std::path::Path::new(path).exists() {
        return Ok(Arc::new(Computed::new(parse_model(path)?.built.brdf)));
    }
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

fn main() -> Result<(), Box<dyn Error>> {
    let mut names = vec!["default".to_string()];
    let (mut files, mut colour, mut averaged) = (Vec::new(), false, false);
    for arg in std::env::args().skip(1) {
        match arg.strip_prefix("--methods=") {
            Some(list) => names = list.split(',').map(String::from).collect(),
            None if arg == "--colour" => colour = true,
            None if arg == "--averaged" => averaged = true,
            None => files.push(arg),
        }
    }
    let SamplerCost { sample_ns, pdf_ns } = sampler_cost(&Cosine, 40);
    println!("for comparison, cosine: {sample_ns:.1} ns sample, {pdf_ns:.1} ns pdf");
    let mut tables = Vec::new();
    for path in &files {
        tables.push((path.rsplit('/').next().unwrap_or(path), load(path)?));
    }
    for name in &names {
        let method = Method::parse(name)
            .ok_or("methods: a preset, AxBxC, cosine, inversion, ggx, dictionary")?;
        let (mut means, mut heaviest) = (Vec::new(), 0.0_f64);
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
            let target = Target {
                f: &f,
                lanes: None,
                symmetry: table.symmetry(),
            };
            let start = Instant::now();
            let turned = |wi: DVec3, wo: DVec3| mean_over_turns(&f, wi, wo);
            let sampler = method.build(if averaged {
                Target::new(&turned)
            } else {
                target
            });
            let build_ms = start.elapsed().as_secs_f64() * 1e3;
            let report = sampler_report(target, &*sampler, SAMPLES);
            print_row(stem, build_ms, sampler_cost(&*sampler, 40), &report);
            means.push(report.mean);
            heaviest = heaviest.max(report.max_weight);
        }
        means.sort_by(f64::total_cmp);
        if let (Some(median), Some(worst)) = (means.get(means.len() / 2), means.last()) {
            println!("median {median:.5}  worst {worst:.5}  largest weight {heaviest:.2}");
        }
    }
    Ok(())
}

/// The mean of `f` over both directions turned together by eighths of a turn: what is left of an anisotropic target for
/// a sampler without slices of azimuth.
fn mean_over_turns(f: &dyn Fn(DVec3, DVec3) -> f64, wi: DVec3, wo: DVec3) -> f64 {
    let turned = |k: u32| {
        let (s, c) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
        let turn = |w: DVec3| DVec3::new(c * w.x - s * w.y, s * w.x + c * w.y, w.z);
        f(turn(wi), turn(wo))
    };
    (0..8).map(turned).sum::<f64>() / 8.0
}

/// What follows the angles in a row.
const SUMMARY: &str = "mean | error | worst angle | max w | wasted | albedo";

fn print_row(stem: &str, build_ms: f64, cost: SamplerCost, report: &SamplerReport) {
    let shown: Vec<String> = report
        .shown
        .iter()
        .map(|(_, v)| format!("{:.5}", v.value))
        .collect();
    println!(
        "{stem:30} | {} | {build_ms:.0} | {:.0} | {:.0} | {} | {:.5} | {:.5} | {:.5} | {:.2} | {:.4} | {:.4}",
        report.bytes,
        cost.sample_ns,
        cost.pdf_ns,
        shown.join(" "),
        report.mean,
        report.std_error,
        report.worst,
        report.max_weight,
        report.wasted,
        report.albedo
    );
}
