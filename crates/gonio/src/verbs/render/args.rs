//! `gonio render` as typed.

use super::strategy::LightStrategy;
use crate::args::{Range, Reading, parse_exr, parse_size, with_ending};
use clap::Args;
use scene_io::scene::{GamutName, SamplerName, SpectrumName};
use std::path::PathBuf;
use tracer::Shard;

/// Render a scene to EXR and PNG, with its own error estimate.
///
/// Ctrl-C finishes the tiles at hand and writes what there is (exit code 0, `interrupted` in JSON); a second one ends the
/// program at once (130).
#[derive(Debug, Default, Args)]
#[command(after_help = "Examples:
  gonio render                                              the embedded default: two materials measured on the fly
  gonio render --material brass.binary -o brass.exr         your file in the default scene
  gonio render scenes/benchmark/scene.ron --material FILE --spp 64 --threads 2 --json
  gonio render --target-error 1% -o sure.exr                as many samples as 1 % relative RMSE takes
  gonio render --checkpoint part1 --shard 1/2               one of two parts, for `gonio merge`")]
pub(crate) struct Render {
    /// Scene in RON; without it the embedded default scene.
    pub(crate) scene: Option<PathBuf>,
    /// Output; a tone-mapped PNG is written beside it.
    #[arg(short, long, value_name = "OUT.exr", default_value = "gonio.exr", value_parser = parse_exr)]
    pub(crate) output: PathBuf,
    /// Replaces the scene's main material by any readable file.
    #[arg(long, value_name = "FILE")]
    pub(crate) material: Option<PathBuf>,
    /// Samples a pixel.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 24))]
    pub(crate) spp: Option<u32>,
    /// Seed: same seed, same bits, whatever the threads.
    #[arg(long, value_name = "S")]
    pub(crate) seed: Option<u64>,
    /// Worker threads; all cores by default.
    #[arg(long, value_name = "T", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// What the channels are: rgb, xyz, 8, 16, 45, native or hero.
    #[arg(long, value_name = "NAME")]
    pub(crate) spectrum: Option<SpectrumName>,
    /// The range that 8, 16 and 45 bins divide, nm, such as 410..690.
    #[arg(long, value_name = "FROM..TO")]
    pub(crate) range: Option<Range>,
    /// How the PNG shows colours out of gamut: clip or desaturate.
    #[arg(long, value_name = "NAME")]
    pub(crate) gamut: Option<GamutName>,
    #[command(flatten)]
    pub(crate) reading: Reading,
    /// How directions are chosen on measured materials.
    #[arg(long, value_name = "NAME")]
    pub(crate) sampler: Option<SamplerName>,
    /// Size in pixels, such as 320x240.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Error against run time as CSV, a row after each pass, whole after each.
    #[arg(long, value_name = "FILE.csv", value_parser = parse_csv)]
    pub(crate) rows: Option<PathBuf>,
    /// A map of the relative standard error of each pixel, logarithmic colours.
    #[arg(long, value_name = "FILE.png", value_parser = parse_png)]
    pub(crate) error_map: Option<PathBuf>,
    /// As many samples as it takes to stay below this relative RMSE, such as 1%: a pilot of another seed counts them, the
    /// picture is that of `--spp` with this number. `--spp` sets the most.
    #[arg(long, value_name = "ERROR", value_parser = parse_share, conflicts_with_all = ["time", "checkpoint", "shard"])]
    pub(crate) target_error: Option<f64>,
    /// Probability with which the target is met.
    #[arg(long, value_name = "P", value_parser = parse_share, default_value = "95%", requires = "target_error")]
    pub(crate) confidence: f64,
    /// As many samples as fit into this time, such as 60s or 5m.
    #[arg(long, value_name = "TIME", value_parser = parse_time, conflicts_with_all = ["spp", "checkpoint", "shard"])]
    pub(crate) time: Option<f64>,
    /// How light is found: by lights and material, with or without resampling; auto tries both on a pilot.
    #[arg(
        long,
        value_enum,
        default_value_t,
        value_name = "NAME",
        hide_possible_values = false
    )]
    pub(crate) light_strategy: LightStrategy,
    /// Keeps the samples in FILE as it goes, and goes on from it if it exists: to the same bits.
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// Seconds between checkpoints.
    #[arg(long, value_name = "S", default_value = "30", value_parser = parse_seconds, requires = "checkpoint")]
    pub(crate) checkpoint_every: f64,
    /// Render only part K of N, into the checkpoint; `gonio merge` puts parts together.
    #[arg(long, value_name = "K/N", value_parser = parse_shard, requires = "checkpoint", conflicts_with_all = ["rows", "error_map"])]
    pub(crate) shard: Option<Shard>,
    /// Say what the scene does not need and is left out.
    #[arg(long)]
    pub(crate) explain: bool,
}

impl Render {
    /// What `gonio` without a verb does.
    pub(crate) fn embedded_default() -> Self {
        Self {
            output: PathBuf::from("gonio.exr"),
            checkpoint_every: 30.0,
            confidence: 0.95,
            ..Self::default()
        }
    }
}

fn parse_csv(text: &str) -> Result<PathBuf, String> {
    with_ending(text, &["csv"], "an output ending in .csv")
}

fn parse_png(text: &str) -> Result<PathBuf, String> {
    with_ending(text, &["png"], "an output ending in .png")
}

/// A share of one: 1% or 0.01.
fn parse_share(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>() {
        Ok(share) if share > 0.0 && share * unit < 1.0 => Ok(share * unit),
        _ => Err("expected a share between 0 and 1, such as 1% or 0.01".into()),
    }
}

fn parse_seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds <= 1e9 => Ok(seconds),
        _ => Err("expected seconds, more than 0".into()),
    }
}

/// 60, 60s, 5m, 2h.
fn parse_time(text: &str) -> Result<f64, String> {
    let wrong = || "expected a time such as 60s, 5m or 2h".to_owned();
    let (number, unit) = match text.char_indices().last() {
        Some((at, 's')) => (&text[..at], 1.0),
        Some((at, 'm')) => (&text[..at], 60.0),
        Some((at, 'h')) => (&text[..at], 3600.0),
        _ => (text, 1.0),
    };
    Ok(unit * parse_seconds(number).map_err(|_| wrong())?)
}

fn parse_shard(text: &str) -> Result<Shard, String> {
    let numbers = text
        .split_once('/')
        .and_then(|(k, n)| Some((k.parse::<u32>().ok()?, n.parse::<u32>().ok()?)));
    match numbers {
        Some((k, count)) if 1 <= k && k <= count => Ok(Shard {
            index: k - 1,
            count,
        }),
        _ => Err("expected K/N with K from 1 to N, such as 2/3".into()),
    }
}
