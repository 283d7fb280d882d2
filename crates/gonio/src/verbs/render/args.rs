//! `gonio render` as typed.

use crate::args::{parse_exr, with_ending};
use clap::Args;
use scene_io::scene::{InterpolationName, SamplerName};
use std::path::PathBuf;

/// Render a scene to EXR and PNG, with its own error estimate.
///
/// Ctrl-C finishes the tiles at hand and writes what there is (exit code 0, `interrupted` in JSON); a second one ends the
/// program at once (130).
#[derive(Debug, Default, Args)]
#[command(after_help = "Examples:
  gonio render                                              the embedded default: two materials measured on the fly
  gonio render --material brass.binary -o brass.exr         your file in the default scene
  gonio render scenes/benchmark/scene.ron --material FILE --spp 64 --threads 2 --json")]
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
    /// How directions are chosen on measured materials.
    #[arg(long, value_name = "NAME")]
    pub(crate) sampler: Option<SamplerName>,
    /// Interpolation of tables: see `gonio info FILE` for what a format offers.
    #[arg(long, value_name = "NAME")]
    pub(crate) interpolation: Option<InterpolationName>,
    /// Size in pixels, such as 320x240.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Error against run time as CSV, a row after each pass, whole after each.
    #[arg(long, value_name = "FILE.csv", value_parser = parse_csv)]
    pub(crate) rows: Option<PathBuf>,
    /// A map of the relative standard error of each pixel, logarithmic colours.
    #[arg(long, value_name = "FILE.png", value_parser = parse_png)]
    pub(crate) error_map: Option<PathBuf>,
    /// Say what the scene does not need and is left out.
    #[arg(long)]
    pub(crate) explain: bool,
}

impl Render {
    /// What `gonio` without a verb does.
    pub(crate) fn embedded_default() -> Self {
        Self {
            output: PathBuf::from("gonio.exr"),
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

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let sides = text
        .split_once('x')
        .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match sides {
        Some((w, h)) if (1..=16_384).contains(&w) && (1..=16_384).contains(&h) => Ok((w, h)),
        _ => Err("expected WIDTHxHEIGHT, each 1 to 16384, such as 640x480".into()),
    }
}
