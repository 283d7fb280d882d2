//! `cargo xtask compare mitsuba`: time to 1 % relative RMSE, ours and Mitsuba 3's, on the scene both know.
//!
//! Mitsuba's error comes from pairs of independent images, at two numbers of samples, and falls as 1/spp; ours from
//! `gonio converge`. Both render the same file in the same size with as many threads, one after the other.

mod paired;

use crate::repo;
use anyhow::{Context, Result, bail};
use serde::Deserialize;
use std::path::{Path, PathBuf};
use std::process::Command;

const HELP: &str = "cargo xtask compare mitsuba --data DIR [--rows NAME,...] [--lights area,env] [--size WxH] [--seconds S] [--pairs N]
cargo xtask compare mitsuba --stage from-start|steady --data DIR [--rows NAME,...] [--size WxH] [--pairs N]
DIR holds the .bsdf and .binary files of the rows; needs python3 with mitsuba. Prints a table.
from-start: seconds of the whole process at 16 samples a pixel; steady: paths/s and efficiency at 64; in turn, by pairs.";

/// Relative RMSE whose times are compared.
const TARGET: f64 = 0.01;
type Row = (&'static str, Option<&'static str>, u32, &'static str);
/// Name, file (none: the model), samples a pixel of the peer's longer images, and our method.
const ROWS: &[Row] = &[
    ("ggx-copper", None, 64, "native"),
    (
        "cc-ibiza-sunset",
        Some("cc_ibiza_sunset_rgb.bsdf"),
        64,
        "hvt-fine",
    ),
    ("paper-white", Some("paper_white_rgb.bsdf"), 64, "hvt-fine"),
    (
        "satin-rosaline",
        Some("satin_rosaline_rgb.bsdf"),
        64,
        "hvt-fine",
    ),
    (
        "vch-golden-yellow",
        Some("vch_golden_yellow_rgb.bsdf"),
        64,
        "hvt-fine",
    ),
    ("brass", Some("brass.binary"), 256, "hvt-fine"),
    (
        "gold-metallic-paint",
        Some("gold-metallic-paint.binary"),
        256,
        "hvt-fine",
    ),
    ("blue-rubber", Some("blue-rubber.binary"), 256, "hvt-fine"),
];

struct Asked {
    stage: Option<String>,
    data: Vec<PathBuf>,
    rows: Vec<String>,
    lights: Vec<String>,
    size: (String, String),
    seconds: String,
    pairs: String,
}

#[derive(Deserialize)]
struct Peer {
    version: String,
    variant: String,
    mean: f64,
    mean_square: f64,
    spp_in_all: f64,
    rows: Vec<PeerRow>,
}

#[derive(Deserialize)]
struct PeerRow {
    spp: f64,
    seconds: Vec<f64>,
    mse: Vec<f64>,
}

/// A number with its standard error.
#[derive(Clone, Copy)]
struct Known {
    value: f64,
    error: f64,
}

pub(crate) fn run(args: &[String]) -> Result<()> {
    if args.first().map(String::as_str) != Some("mitsuba") {
        bail!("expected the name of a peer: mitsuba\n{HELP}");
    }
    let asked = parse(&args[1..])?;
    crate::gonio::build()?;
    match asked.stage.as_deref() {
        None => {}
        Some("from-start") => return paired::from_start(&asked),
        Some("steady") => return paired::steady(&asked),
        Some(other) => bail!("unknown stage {other}\n{HELP}"),
    }
    println!(
        "| material | light | ours: s to 1 % | Mpaths/s | Mitsuba: s to 1 % | Mpaths/s | MSE x spp, 1/4 of the spp over all | \
         ratio (95 %) | means apart |\n|---|---|---:|---:|---:|---:|---:|---:|---:|"
    );
    for light in &asked.lights {
        for (name, file, spp, method) in asked.rows() {
            row(&asked, light, (name, *file, *spp, method))?;
        }
    }
    Ok(())
}

fn parse(args: &[String]) -> Result<Asked> {
    let mut asked = Asked {
        stage: None,
        data: Vec::new(),
        rows: Vec::new(),
        lights: vec!["area".into(), "env".into()],
        size: ("640".into(), "480".into()),
        seconds: "20".into(),
        pairs: "4".into(),
    };
    for pair in args.chunks(2) {
        let [key, value] = pair else {
            bail!("{}: expected a value\n{HELP}", pair[0]);
        };
        let list = || value.split(',').map(String::from).collect();
        match key.as_str() {
            "--data" => asked.data.push(value.into()),
            "--rows" => asked.rows = list(),
            "--lights" => asked.lights = list(),
            "--stage" => asked.stage = Some(value.clone()),
            "--seconds" => asked.seconds.clone_from(value),
            "--pairs" => asked.pairs.clone_from(value),
            "--size" => {
                let (w, h) = value.split_once('x').context("expected --size WxH")?;
                asked.size = (w.into(), h.into());
            }
            other => bail!("unknown option {other}\n{HELP}"),
        }
    }
    Ok(asked)
}

impl Asked {
    /// The rows that were asked for.
    fn rows(&self) -> impl Iterator<Item = &'static Row> {
        let wanted = |name| self.rows.is_empty() || self.rows.iter().any(|r| r == name);
        ROWS.iter().filter(move |row| wanted(row.0))
    }

    /// Where the file of a row is.
    fn path(&self, file: Option<&str>) -> Result<Option<PathBuf>> {
        let Some(file) = file else {
            return Ok(None);
        };
        let mut places = self.data.iter().map(|d| d.join(file));
        let found = places.find(|p| p.exists());
        (found.map(Some)).with_context(|| format!("{file} is in no --data folder"))
    }

    /// The peer at work on `material`, without what differs between stages.
    fn peer(&self, light: &str, material: Option<&Path>) -> Command {
        let mut command = Command::new("python3");
        command
            .arg(repo::root().join("xtask/peers/mitsuba3.py"))
            .arg("--material")
            .arg(material.unwrap_or(Path::new("ggx")))
            .args(["--light", light, "--threads", "2"])
            .args(["--width", &self.size.0, "--height", &self.size.1]);
        command
    }
}

/// A folder for what is rendered.
fn folder(name: &str) -> Result<PathBuf> {
    let folder = repo::root().join("target/compare").join(name);
    std::fs::create_dir_all(&folder)?;
    Ok(folder)
}

fn row(
    asked: &Asked,
    light: &str,
    (name, file, spp, method): (&str, Option<&str>, u32, &str),
) -> Result<()> {
    let path = asked.path(file)?;
    let folder = folder(&format!("{name}-{light}"))?;
    let peer = mitsuba(asked, light, path.as_deref(), (spp, &folder))?;
    let ours = gonio(asked, light, path.as_deref(), (method, &folder))?;
    let curve = &ours["curves"][0];
    let number = |v: &serde_json::Value| v.as_f64().context("gonio converge left out a number");
    let time = Known {
        value: number(&curve["seconds_to_target"])?,
        error: number(&curve["seconds_to_target_error"])?,
    };
    let last = curve["points"]
        .as_array()
        .and_then(|p| p.last())
        .context("no points")?;
    let pixels = asked.size.0.parse::<f64>()? * asked.size.1.parse::<f64>()?;
    let our_rate = pixels * number(&last["spp"])? / number(&last["seconds"])?;
    let [quarter, whole] = [&peer.rows[0], &peer.rows[1]];
    let constant = |r: &PeerRow| scaled(known(&r.mse), r.spp);
    let seconds_a_sample = scaled(known(&whole.seconds), whole.spp.recip());
    // error^2 = constant / spp, so the target takes constant / target^2 samples
    let to_target = times(
        scaled(constant(whole), 1.0 / (TARGET * TARGET * peer.mean_square)),
        seconds_a_sample,
    );
    let ratio = over(to_target, time);
    let law = over(constant(quarter), constant(whole));
    // few runs on both sides: Student's t with three degrees
    let half = 3.18 * ratio.error / ratio.value;
    println!(
        "| {name} | {light} | {:.3} ± {:.3}{} | {:.1} | {:.1} ± {:.1} | {:.1} | {:.3}; {:.2} ± {:.2} | {:.1} ({:.1} to {:.1}) | {} |",
        time.value,
        time.error,
        if curve["extrapolated"] == true {
            "*"
        } else {
            ""
        },
        1e-6 * our_rate,
        to_target.value,
        to_target.error,
        1e-6 * pixels / seconds_a_sample.value,
        constant(whole).value / peer.mean_square,
        law.value,
        law.error,
        ratio.value,
        ratio.value * (-half).exp(),
        ratio.value * half.exp(),
        apart(&peer, &folder)?
    );
    Ok(())
}

fn mitsuba(
    asked: &Asked,
    light: &str,
    material: Option<&Path>,
    (spp, folder): (u32, &Path),
) -> Result<Peer> {
    let mut command = asked.peer(light, material);
    command
        .args(["--spp", &spp.to_string(), "--pairs", &asked.pairs, "--out"])
        .arg(folder.join("mitsuba.exr"));
    let peer: Peer =
        serde_json::from_slice(&said(&mut command)?).context("the peer printed no JSON")?;
    eprintln!(
        "mitsuba {} {}, mean {:.5}",
        peer.version, peer.variant, peer.mean
    );
    Ok(peer)
}

/// What the peer prints.
fn said(command: &mut Command) -> Result<Vec<u8>> {
    let output = command.output().context("cannot start python3")?;
    if !output.status.success() {
        let said = String::from_utf8_lossy(&output.stderr);
        bail!("the peer failed: {said}");
    }
    Ok(output.stdout)
}

fn gonio(
    asked: &Asked,
    light: &str,
    material: Option<&Path>,
    (method, folder): (&str, &Path),
) -> Result<serde_json::Value> {
    let root = repo::root();
    let scene = if light == "env" {
        "benchmark-env"
    } else {
        "benchmark"
    };
    let mut command = crate::gonio::command();
    command
        .arg("converge")
        .arg(root.join("scenes").join(scene).join("scene.ron"))
        .args([
            "--methods",
            method,
            "--reference-method",
            method,
            "--runs",
            "4",
            "--threads",
            "2",
        ])
        .args(["--target", &TARGET.to_string(), "--seconds", &asked.seconds])
        .args([
            "--size",
            &format!("{}x{}", asked.size.0, asked.size.1),
            "-o",
        ])
        .arg(folder);
    if let Some(path) = material {
        command.arg("--material").arg(path);
        // the peer reads MERL cells by the nearest: the same reflectance on both sides
        if path.extension().is_some_and(|e| e == "binary") {
            command.args(["--interpolation", "nearest"]);
        }
    }
    crate::gonio::run(&mut command)
}

/// How far the long-run means are apart: relative difference of the pictures' means with its standard error, and the
/// relative RMSE between the pictures beside what their own errors explain.
fn apart(peer: &Peer, folder: &Path) -> Result<String> {
    let theirs = scene_io::image::read_exr(&folder.join("mitsuba.exr"))?;
    let ours = scene_io::image::read_exr(&folder.join("reference.exr"))?;
    let found = scene_io::compare(&theirs, &ours)?;
    let variance = |p: &scene_io::image::Picture| -> f64 {
        let planes = p.variance.iter().flatten().flatten();
        planes.map(|v| f64::from(*v)).sum::<f64>() / (3 * p.pixels.len()) as f64
    };
    let whole = &peer.rows[1];
    let own = known(&whole.mse).value * whole.spp / peer.spp_in_all + variance(&ours);
    // channels of a pixel err together
    let of_mean = (own / theirs.pixels.len() as f64).sqrt();
    Ok(format!(
        "{:+.3} ± {:.3} %; {:.2} % of {:.2} %",
        100.0 * (found.mean_a / found.mean_b - 1.0),
        100.0 * of_mean / found.mean_b,
        100.0 * found.rel_rmse,
        100.0 * (own / peer.mean_square).sqrt()
    ))
}

fn known(values: &[f64]) -> Known {
    let n = values.len() as f64;
    let value = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|v| (v - value).powi(2)).sum();
    Known {
        value,
        error: (squares / (n * (n - 1.0))).sqrt(),
    }
}

fn scaled(k: Known, factor: f64) -> Known {
    Known {
        value: k.value * factor,
        error: k.error * factor,
    }
}

fn times(a: Known, b: Known) -> Known {
    let value = a.value * b.value;
    Known {
        value,
        error: value * (a.error / a.value).hypot(b.error / b.value),
    }
}

fn over(a: Known, b: Known) -> Known {
    let value = a.value / b.value;
    Known {
        value,
        error: value * (a.error / a.value).hypot(b.error / b.value),
    }
}
