//! `gonio spectra SCENE`: one scene in every mode, its colours against the finest answer.

use super::Context;
use crate::args::{ColourArgs, Range, parse_size};
use crate::output::{Usage, say};
use crate::pictures::Gamut;
use anyhow::Result;
use clap::Args;
use scene_io::image::write_png;
use scene_io::scene::{MaterialSpec, SpectrumName};
use scene_io::spectral::{Study, finest, study, write_sheet};
use scene_io::{Overrides, SceneFile};
use serde::Serialize;
use std::fmt::{self, Write};
use std::path::{Path, PathBuf};

/// Render a scene in every spectral mode and compare colours with the finest answer.
///
/// All modes take the same samples, so that most of their noise is common; what is left is estimated and taken off.
/// Colours are compared where the main material is seen, by CIEDE2000 under the white of the scene's lights, as bright
/// as the PNGs show them.
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  gonio spectra scenes/thesis/base.ron --material garnet_red.brdf --spp 256 -o spectra
  gonio spectra SCENE --modes rgb,8,hero --size 320x240 -o spectra --json")]
pub(crate) struct Spectra {
    /// Scene in RON.
    pub(crate) scene: PathBuf,
    /// Replaces the scene's main material by any readable file.
    #[arg(long, value_name = "FILE")]
    pub(crate) material: Option<PathBuf>,
    /// Which modes, comma separated: rgb, xyz, 8, 16, 45, native, hero.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', default_values_t = SpectrumName::ALL.iter().copied())]
    pub(crate) modes: Vec<SpectrumName>,
    /// What they are compared with: by default native where a material has bands, else hero.
    #[arg(long, value_name = "NAME")]
    pub(crate) reference: Option<SpectrumName>,
    #[command(flatten)]
    pub(crate) colour: ColourArgs,
    /// The range that 8, 16 and 45 bins divide, nm, such as 410..690.
    #[arg(long, value_name = "FROM..TO")]
    pub(crate) range: Option<Range>,
    /// Samples a pixel.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(8..=1 << 24))]
    pub(crate) spp: Option<u32>,
    /// Size in pixels, such as 320x240.
    #[arg(long, value_name = "WxH", value_parser = parse_size)]
    pub(crate) size: Option<(u32, u32)>,
    /// Seed.
    #[arg(long, value_name = "S")]
    pub(crate) seed: Option<u64>,
    /// Folder for pictures, contact sheet and table; made if it does not exist.
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: PathBuf,
}

#[derive(Serialize)]
struct Report {
    written: Vec<PathBuf>,
    scene: String,
    reference: &'static str,
    modes: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    name: &'static str,
    seconds: f64,
    build_seconds: f64,
    rel_rmse: f64,
    rel_rmse_ci: [f64; 2],
    delta_e_mean: f64,
    delta_e_p95: f64,
    /// Standard error of the mean.
    delta_e_error: f64,
    /// With the noise left in.
    delta_e_raw: f64,
    pixels: usize,
    gamut: Gamut,
}

pub(crate) fn run(context: &Context, args: &Spectra) -> Result<()> {
    if args.modes.is_empty() {
        return Err(Usage("--modes: expected at least one, found none".into()).into());
    }
    let file = SceneFile::load(&args.scene)?;
    scene_io::write::folder(&args.output)?;
    let material = args.material.as_ref();
    let overrides = Overrides {
        material: material.map(|m| MaterialSpec::from_argument(&m.to_string_lossy())),
        colour: args.colour.choice(),
        range_nm: args.range.map(|r| r.0),
        spp: args.spp,
        seed: args.seed,
        size: args.size,
        ..Overrides::default()
    };
    let reference = match args.reference {
        Some(name) => name,
        None => finest(&file, &overrides, &context.places)?,
    };
    say(format_args!(
        "rendering {} modes, compared with {reference}",
        args.modes.len()
    ));
    let modes = (&args.modes[..], reference);
    let found = study(&file, &overrides, &context.places, modes, &())?;
    let report = write(&args.output, &args.scene, &found)?;
    context.report(&report, |out| print(&report, out))
}

fn write(folder: &Path, scene: &Path, found: &Study) -> Result<Report> {
    let mut written = Vec::new();
    let mut modes = Vec::new();
    for mode in &found.modes {
        let path = folder.join(format!("{}.exr", mode.name));
        scene_io::image::write_exr(&path, &mode.picture)?;
        written.push(path);
        let path = folder.join(format!("{}.png", mode.name));
        let gamut = write_png(&path, &mode.picture, found.tone)?;
        written.push(path);
        let d = &mode.difference;
        modes.push(Row {
            name: mode.name.name(),
            seconds: mode.seconds,
            build_seconds: mode.build_seconds,
            rel_rmse: mode.rel_rmse,
            rel_rmse_ci: mode.rel_rmse_ci,
            delta_e_mean: d.mean,
            delta_e_p95: d.p95,
            delta_e_error: d.mean_error,
            delta_e_raw: d.raw_mean,
            pixels: d.pixels,
            gamut: Gamut::new(found.tone, gamut),
        });
    }
    let sheet = folder.join("sheet.png");
    write_sheet(&sheet, found)?;
    written.push(sheet);
    let table = folder.join("spectra.csv");
    scene_io::write::bytes(&table, csv(&modes).as_bytes())?;
    written.push(table);
    Ok(Report {
        written,
        scene: scene.display().to_string(),
        reference: found.reference.name(),
        modes,
    })
}

fn csv(modes: &[Row]) -> String {
    let head = "mode,seconds,rel_rmse,delta_e_mean,delta_e_p95,delta_e_error,delta_e_raw\n";
    let line = |r: &Row| {
        format!(
            "{},{},{},{},{},{},{}\n",
            r.name,
            r.seconds,
            r.rel_rmse,
            r.delta_e_mean,
            r.delta_e_p95,
            r.delta_e_error,
            r.delta_e_raw
        )
    };
    modes
        .iter()
        .map(line)
        .fold(head.to_owned(), |all, l| all + &l)
}

fn print(r: &Report, out: &mut String) -> fmt::Result {
    let pixels = r.modes.first().map_or(0, |m| m.pixels);
    writeln!(
        out,
        "{}: CIEDE2000 from {} over {pixels} pixels, noise taken off",
        r.scene, r.reference
    )?;
    writeln!(
        out,
        "mode     seconds  error %     mean      95 %   (with noise)"
    )?;
    for m in &r.modes {
        writeln!(
            out,
            "{:<7} {:8.2} {:8.3} {:8.4} {:9.4} {:9.4}",
            m.name,
            m.seconds,
            100.0 * m.rel_rmse,
            m.delta_e_mean,
            m.delta_e_p95,
            m.delta_e_raw
        )?;
    }
    writeln!(out, "wrote {} files", r.written.len())
}
