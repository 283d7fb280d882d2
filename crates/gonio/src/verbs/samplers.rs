//! `gonio samplers FILE|MODEL`: how noisy, how fast and how right every sampler is on one material.

use super::Context;
use super::converge::parse_seconds;
use crate::args::Reading;
use anyhow::Result;
use clap::Args;
use scene_io::material::Surface;
use scene_io::scene::{MaterialSpec, SamplerName};
use scene_io::survey::{Survey, SurveyOptions};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::{self, Write};
use std::path::PathBuf;

/// Compare all samplers on one material: bytes, costs, variance, weights, waste, and whether they are right.
///
/// Relative variances are Var[f cos / pdf] / albedo^2 of luminance for a fixed viewer; the mean is over 24 viewers from
/// 1.4 to 84.4 degrees that lie on no grid. The colour floor is the least such variance, mean over channels, that any one
/// density can have. A sampler is right if chi-square tests of its samples against its density agree at five viewers.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gonio samplers brass.binary
  gonio samplers ggx:alpha=0.1 --methods native,hvt,cosine --json")]
pub(crate) struct Samplers {
    /// A measured-reflectance file in any known format, or a model such as ggx:alpha=0.1.
    #[arg(value_name = "FILE|MODEL")]
    pub(crate) material: PathBuf,
    /// Which samplers, comma separated; all that go with the material by default.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) methods: Vec<SamplerName>,
    /// Seconds of drawing samples for each, about: slow ones get fewer samples.
    #[arg(long, value_name = "S", default_value_t = 4.0, allow_negative_numbers = true, value_parser = parse_seconds)]
    pub(crate) seconds: f64,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

#[derive(Serialize)]
struct Report {
    material: String,
    colour_floor: f64,
    methods: Vec<Method>,
}

#[derive(Serialize)]
struct Method {
    name: &'static str,
    bytes: usize,
    build_ms: f64,
    sample_ns: f64,
    pdf_ns: f64,
    packet_sample_ns: Option<f64>,
    packet_pdf_ns: Option<f64>,
    /// By angle in degrees.
    rel_var: BTreeMap<String, f64>,
    rel_var_error: BTreeMap<String, f64>,
    rel_var_mean: f64,
    rel_var_mean_error: f64,
    rel_var_worst: f64,
    max_weight_ratio: f64,
    wasted: f64,
    tries_per_sample: f64,
    samples: usize,
    keeps_stratification: bool,
    chi_square_ok: Option<bool>,
    chi_square_p: Option<f64>,
    chi_square_level: Option<f64>,
    chi_square_samples: Option<usize>,
    chi_square_fault: Option<String>,
    notes: Vec<String>,
}

pub(crate) fn run(context: &Context, args: &Samplers) -> Result<()> {
    let mut spec = MaterialSpec::from_argument(&args.material.to_string_lossy());
    args.reading.apply(&mut spec);
    let (surface, path) = Surface::of_spec(&spec, &context.places)?;
    let names = if args.methods.is_empty() {
        surface.samplers()
    } else {
        args.methods.clone()
    };
    let options = SurveyOptions {
        seconds: args.seconds,
        methods: names.len(),
    };
    let cache = &context.places.cache;
    let methods = names
        .iter()
        .map(|name| surface.survey(*name, options, cache));
    let report = Report {
        material: path
            .unwrap_or_else(|| args.material.clone())
            .display()
            .to_string(),
        methods: methods
            .map(|s| s.map(Method::of))
            .collect::<Result<_, _>>()?,
        colour_floor: surface.colour_floor(cache)?,
    };
    context.report(&report, |out| report.print(out))
}

impl Method {
    fn of(s: Survey) -> Self {
        let by_angle = |of: &dyn Fn(&brdf_sampling::RelativeVariance) -> f64| {
            (s.report.shown.iter())
                .map(|(deg, v)| (format!("{deg:02}"), of(v)))
                .collect()
        };
        let verdict = s.verdict.as_ref();
        Self {
            name: s.name.name(),
            bytes: s.report.bytes,
            build_ms: 1e3 * s.build_seconds,
            sample_ns: s.cost.sample_ns,
            pdf_ns: s.cost.pdf_ns,
            packet_sample_ns: s.packets.map(|p| p.sample_ns),
            packet_pdf_ns: s.packets.map(|p| p.pdf_ns),
            rel_var: by_angle(&|v| v.value),
            rel_var_error: by_angle(&|v| v.std_error),
            rel_var_mean: s.report.mean,
            rel_var_mean_error: s.report.std_error,
            rel_var_worst: s.report.worst,
            max_weight_ratio: s.report.max_weight,
            wasted: s.report.wasted,
            tries_per_sample: s.report.tries_per_sample,
            samples: s.samples,
            keeps_stratification: s.keeps_stratification,
            chi_square_ok: verdict.map(|v| v.ok),
            chi_square_p: verdict.map(|v| v.p_value),
            chi_square_level: verdict.map(|v| v.level),
            chi_square_samples: verdict.map(|v| v.samples),
            chi_square_fault: verdict.and_then(|v| v.fault.clone()),
            notes: s.notes,
        }
    }

    fn print(&self, out: &mut String) -> fmt::Result {
        let verdict = match self.chi_square_ok {
            Some(true) => "ok",
            Some(false) => "WRONG",
            None => "untested",
        };
        let ns = |v: Option<f64>| v.map_or("-".into(), |v| format!("{v:.0}"));
        writeln!(
            out,
            "{:14} {:>8} {:>8.0} {:>9.0} {:>6.0} {:>5} {:>5}  {:>9.2e} ± {:<8.0e} {:>8.1e} {:>8.2} {:>8.1} {:>7.4} {:>9}",
            self.name,
            self.bytes,
            self.build_ms,
            self.sample_ns,
            self.pdf_ns,
            ns(self.packet_sample_ns),
            ns(self.packet_pdf_ns),
            self.rel_var_mean,
            self.rel_var_mean_error,
            self.rel_var_worst,
            self.max_weight_ratio,
            self.tries_per_sample,
            self.wasted,
            verdict
        )
    }
}

impl Report {
    fn print(&self, out: &mut String) -> fmt::Result {
        writeln!(out, "{}\n", self.material)?;
        writeln!(
            out,
            "{:14} {:>8} {:>8} {:>9} {:>6} {:>5} {:>5}  {:>20} {:>8} {:>8} {:>8} {:>7} {:>9}",
            "sampler",
            "bytes",
            "build ms",
            "ns sample",
            "ns pdf",
            "pkt s",
            "pkt p",
            "rel. variance, mean",
            "worst",
            "max/mean",
            "tries",
            "wasted",
            "chi-sq."
        )?;
        self.methods.iter().try_for_each(|m| m.print(out))?;
        write!(out, "\nrelative variance at degrees")?;
        let angles = self.methods.iter().flat_map(|m| m.rel_var.keys()).take(7);
        angles
            .into_iter()
            .try_for_each(|deg| write!(out, "{deg:>10}"))?;
        writeln!(out)?;
        for m in &self.methods {
            write!(out, "{:28}", m.name)?;
            m.rel_var
                .values()
                .try_for_each(|v| write!(out, "{v:>10.2e}"))?;
            writeln!(out)?;
        }
        writeln!(
            out,
            "\ncolour floor J* (mean over channels and viewers): {:.2e}",
            self.colour_floor
        )?;
        for m in &self.methods {
            for note in m.notes.iter().chain(&m.chi_square_fault) {
                writeln!(out, "{}: {note}", m.name)?;
            }
        }
        Ok(())
    }
}
