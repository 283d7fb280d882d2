//! The command line as typed: verbs, flags, help. Nothing here does work.

use crate::verbs::converge::Converge;
use crate::verbs::fit::Fit;
use crate::verbs::merge::Merge;
use crate::verbs::render::Render;
use crate::verbs::samplers::Samplers;
use crate::verbs::stress::Stress;
use clap::{Args, Parser, Subcommand, ValueEnum};
use scene_io::material::MaterialOptions;
use scene_io::scene::{ColourChoice, FileScale, InterpolationName, MaterialSpec, Primaries, White};
use std::path::PathBuf;
use std::str::FromStr;

/// Check, see, convert and render measured reflectance.
#[derive(Debug, Parser)]
#[command(name = "gonio", version, arg_required_else_help = false)]
#[command(
    after_help = "Angles are degrees, wavelengths nm, reflectance f_r in 1/sr without the cosine.\n\
Exit codes: 0 fine, 1 bad input or failed work, 2 bad usage, 3 findings above the asked severity.\n\
Without a verb: the same as `gonio render`, the embedded default scene."
)]
pub(crate) struct Cli {
    /// Folders searched for material files (also the environment variable `GONIO_DATA`).
    #[arg(long, global = true, value_name = "DIR")]
    pub(crate) data: Vec<PathBuf>,
    /// Print one JSON object on stdout instead of text.
    #[arg(long, global = true)]
    pub(crate) json: bool,
    #[command(subcommand)]
    pub(crate) verb: Option<Verb>,
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Verb {
    Render(Render),
    Merge(Merge),
    Info(Info),
    Eval(Eval),
    Plot(Plot),
    Mix(Mix),
    Convert(Convert),
    Measure(Measure),
    Compare(Compare),
    Stress(Stress),
    Fit(Fit),
    Samplers(Samplers),
    Spectra(crate::verbs::spectra::Spectra),
    Converge(Converge),
}

/// What the numbers of a measured file mean, where the file is not to be believed.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct ColourArgs {
    /// Primaries of an RGB file: sRGB, Rec.2020, ACEScg, Trinitron (with their white) or xr,yr,xg,yg,xb,yb.
    #[arg(long, value_name = "NAME|XY")]
    pub(crate) primaries: Option<Primaries>,
    /// White of an RGB file: A, C, D50, D65, E, F2, F11, blackbody:KELVIN or x,y.
    #[arg(long, value_name = "NAME|XY")]
    pub(crate) white: Option<White>,
    /// Factor from the file's numbers to f_r in 1/sr, one or r,g,b.
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
    pub(crate) scale: Option<FileScale>,
}

impl ColourArgs {
    pub(crate) fn choice(self) -> ColourChoice {
        ColourChoice {
            primaries: self.primaries,
            white: self.white,
            scale: self.scale,
        }
    }
}

/// How a measured file is read.
#[derive(Clone, Copy, Debug, Default, Args)]
pub(crate) struct Reading {
    /// Interpolation of tables: see `gonio info FILE` for what a format offers.
    #[arg(long, value_name = "NAME")]
    pub(crate) interpolation: Option<InterpolationName>,
    #[command(flatten)]
    pub(crate) colour: ColourArgs,
}

impl Reading {
    pub(crate) fn options(self) -> MaterialOptions {
        MaterialOptions {
            interpolation: self.interpolation.unwrap_or(InterpolationName::Auto),
            colour: self.colour.choice(),
            ..MaterialOptions::default()
        }
    }

    /// A material that is a file is read so; others stay.
    pub(crate) fn apply(self, spec: &mut MaterialSpec) {
        if let MaterialSpec::File(file) = spec {
            file.interpolation = self.interpolation;
            file.colour = self.colour.choice();
        }
    }
}

/// A range of wavelengths, nm.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Range(pub(crate) [f64; 2]);

impl FromStr for Range {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let ends = text.split_once("..");
        let ends = ends.and_then(|(a, b)| Some([a.parse().ok()?, b.parse().ok()?]));
        match ends {
            Some([from, to]) if 100.0 <= from && from < to && to <= 10_000.0 => {
                Ok(Self([from, to]))
            }
            _ => Err("expected FROM..TO in nm, ascending, such as 410..690".into()),
        }
    }
}

/// Say what a file is: format, grid, channels, colour, validity.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gonio info garnet_red_RGB.astm
  gonio info garnet_red_RGB.astm --primaries sRGB --scale 2.8
  gonio info brass.binary --json")]
pub(crate) struct Info {
    /// A measured-reflectance file in any known format.
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) colour: ColourArgs,
}

/// Evaluate f_r at one pair of directions, or at many from a CSV file.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gonio eval brass.binary --theta-i 45 --theta-o 45 --phi-o 180
  gonio eval garnet_red_RGB.astm --batch directions.csv --json      (theta_i,phi_i,theta_o,phi_o a line)
  gonio eval ggx:alpha=0.1 --theta-i 45 --theta-o 45 --phi-o 180")]
pub(crate) struct Eval {
    /// A measured-reflectance file in any known format, or a model such as ggx:alpha=0.1.
    pub(crate) file: PathBuf,
    /// Polar angle toward the light, degrees.
    #[arg(long, value_name = "DEG", required_unless_present = "batch", allow_negative_numbers = true, value_parser = parse_theta)]
    pub(crate) theta_i: Option<f64>,
    /// Azimuth toward the light, degrees.
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true, value_parser = parse_finite)]
    pub(crate) phi_i: f64,
    /// Polar angle toward the viewer, degrees.
    #[arg(long, value_name = "DEG", required_unless_present = "batch", allow_negative_numbers = true, value_parser = parse_theta)]
    pub(crate) theta_o: Option<f64>,
    /// Azimuth toward the viewer, degrees.
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true, value_parser = parse_finite)]
    pub(crate) phi_o: f64,
    /// Directions from a file: theta_i,phi_i,theta_o,phi_o in degrees a line.
    #[arg(long, value_name = "FILE.csv", conflicts_with_all = ["theta_i", "theta_o"])]
    pub(crate) batch: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

/// The pictures `gonio plot` draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PlotKind {
    /// In-plane polar plot, one curve a channel (or luminance, for several files).
    Polar,
    /// Luminance over theta_h and theta_d at phi_d = 90 degrees.
    Slice,
    /// Directional albedo against theta.
    Albedo,
}

/// Draw polar plots, slices or albedo of one or several files or models.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gonio plot brass.binary --theta-i 45,75,85 -o brass.svg
  gonio plot garnet_red_RGB.astm krylon_blue_RGB.astm --theta-i 45 --log -o both.png
  gonio plot brass.binary --kind albedo -o albedo.svg
  gonio plot brass.binary ggx:alpha=0.05 --log -o brass-and-ggx.svg")]
pub(crate) struct Plot {
    /// Measured-reflectance files, or models such as ggx:alpha=0.1.
    #[arg(required = true)]
    pub(crate) files: Vec<PathBuf>,
    /// Output: .svg or .png.
    #[arg(short, long, value_name = "OUT", value_parser = parse_picture)]
    pub(crate) output: PathBuf,
    /// Which picture.
    #[arg(long, value_enum, default_value_t = PlotKind::Polar)]
    pub(crate) kind: PlotKind,
    /// Incident polar angles, degrees, comma separated.
    #[arg(long, value_name = "DEG", value_delimiter = ',', default_values_t = [45.0], value_parser = parse_theta)]
    pub(crate) theta_i: Vec<f64>,
    /// Logarithmic radius or colours.
    #[arg(long)]
    pub(crate) log: bool,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

/// Linear combination of materials, as a MERL file.
#[derive(Debug, Args)]
#[command(after_help = "Example:
  gonio mix brass.binary:0.3 blue-rubber.binary:0.7 -o mixed.binary")]
pub(crate) struct Mix {
    /// FILE:WEIGHT, at least two.
    #[arg(required = true, num_args = 2.., value_name = "FILE:WEIGHT")]
    pub(crate) parts: Vec<String>,
    /// Output file.
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

/// Convert between formats, and say what is lost.
#[derive(Debug, Args)]
#[command(after_help = "The output's format follows from its extension:
  .binary  MERL        .astm  Cornell ASTM E1392        .brdf  pbrt-v2 text
Examples:
  gonio convert garnet_red_RGB.astm garnet.binary
  gonio convert mine.binary scaled.binary --primaries Rec.2020 --scale 0.5
  gonio convert garnet_red.brdf garnet.astm")]
pub(crate) struct Convert {
    /// Input file, any readable format.
    pub(crate) input: PathBuf,
    /// Output file.
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) reading: Reading,
}

/// A virtual gonioreflectometer: measure a model onto the MERL or the Cornell grid.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gonio measure ggx:alpha=0.1 -o ggx.binary
  gonio measure lambert:albedo=0.5 --noise 0.05 --bracketed -o noisy.binary
  gonio measure cook-torrance --blind-spot 17 -o ct.astm
`gonio measure list` names the models and their parameters.")]
pub(crate) struct Measure {
    /// NAME or NAME:parameter=value,...; `list` prints what there is.
    pub(crate) model: String,
    /// Output: .binary (MERL grid) or .astm (Cornell grid).
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,
    /// Relative noise (standard deviation of the logarithm).
    #[arg(long, value_name = "SIGMA", default_value_t = 0.0, allow_negative_numbers = true, value_parser = parse_not_negative)]
    pub(crate) noise: f64,
    /// Read through a 10-bit camera with bracketed exposures.
    #[arg(long)]
    pub(crate) bracketed: bool,
    /// Detector blind spot around the incident direction, degrees (Cornell grid).
    #[arg(long, value_name = "DEG", default_value_t = 0.0, allow_negative_numbers = true, value_parser = parse_not_negative)]
    pub(crate) blind_spot: f64,
    /// Seed of the noise.
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub(crate) seed: u64,
}

/// Compare two EXR images of one size.
#[derive(Debug, Args)]
#[command(
    after_help = "rmse = sqrt(mean (a-b)^2); rel_mse = mean (a-b)^2/(b^2 + (0.01 mean b)^2); rel_rmse = sqrt(sum (a-b)^2/sum b^2).
Where both images carry their variance, per-pixel Z scores are summarised too.
Example:
  gonio compare a.exr b.exr --json"
)]
pub(crate) struct Compare {
    /// The image under test.
    pub(crate) a: PathBuf,
    /// The reference.
    pub(crate) b: PathBuf,
}

pub(crate) fn parse_exr(text: &str) -> Result<PathBuf, String> {
    with_ending(
        text,
        &["exr"],
        "an output ending in .exr (a PNG is written beside it)",
    )
}

fn parse_picture(text: &str) -> Result<PathBuf, String> {
    with_ending(text, &["svg", "png"], "an output ending in .svg or .png")
}

pub(crate) fn with_ending(text: &str, endings: &[&str], expected: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(text);
    let ending = path
        .extension()
        .and_then(|e| e.to_str())
        .unwrap_or_default();
    if endings.contains(&ending) {
        Ok(path)
    } else {
        Err(format!("expected {expected}, found the ending {ending:?}"))
    }
}

/// Degrees from the normal, 0 to 90.
fn parse_theta(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(deg) if (0.0..=90.0).contains(&deg) => Ok(deg),
        _ => Err("expected degrees from the normal, 0 to 90".into()),
    }
}

fn parse_finite(text: &str) -> Result<f64, String> {
    text.parse()
        .ok()
        .filter(|v: &f64| v.is_finite())
        .ok_or_else(|| "expected a finite number".into())
}

pub(crate) fn parse_not_negative(text: &str) -> Result<f64, String> {
    parse_finite(text)
        .ok()
        .filter(|v| *v >= 0.0)
        .ok_or_else(|| "expected a number, 0 or more".into())
}

pub(crate) fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let sides = text
        .split_once('x')
        .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    match sides {
        Some((w, h)) if (1..=16_384).contains(&w) && (1..=16_384).contains(&h) => Ok((w, h)),
        _ => Err("expected WIDTHxHEIGHT, each 1 to 16384, such as 640x480".into()),
    }
}
