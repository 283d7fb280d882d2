//! `cargo xtask render-all`: every scene its data allow, with polar plots and a contact sheet.

mod page;

use crate::repo;
use anyhow::{Context, Result, bail};
use page::{Entry, Outcome};
use scene_io::scene::MaterialSpec;
use scene_io::{DataDirs, ErrorKind, SceneFile};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

const HELP: &str = "\
cargo xtask render-all [--quick] [--only NAME] [--spp N] [--data DIR]... [-o DIR]
  --quick     a quarter of the width and height, 32 samples a pixel
  --only NAME the scenes whose names begin so: --only thesis for the ten of chapter 6
  --spp N     other samples a pixel than the scenes say
  --data DIR  where measured files are (also GONIO_DATA)
  -o DIR      output folder (default: out/render-all)
";

struct Options {
    quick: bool,
    only: String,
    spp: Option<String>,
    data: Vec<PathBuf>,
    output: PathBuf,
}

pub(crate) fn run(args: &[String]) -> Result<()> {
    let Some(options) = parse(args)? else {
        print!("{HELP}");
        return Ok(());
    };
    crate::gonio::build()?;
    std::fs::create_dir_all(&options.output)
        .with_context(|| options.output.display().to_string())?;
    let mut entries = Vec::new();
    for path in repo::files("scenes", "scene.ron")? {
        let name = repo::shown(path.parent().unwrap_or(&path))
            .trim_start_matches("scenes/")
            .replace('/', "-");
        if !name.starts_with(&options.only) {
            continue;
        }
        let entry = Entry {
            outcome: one(&options, &path, &name)?,
            name,
        };
        println!("{}", entry.line());
        entries.push(entry);
    }
    let index = options.output.join("index.html");
    std::fs::write(&index, page::html(&entries)).with_context(|| index.display().to_string())?;
    let seconds: Vec<f64> = entries.iter().filter_map(|e| e.outcome.seconds()).collect();
    println!(
        "rendered {} of {} scenes in {:.0} s; see {}",
        seconds.len(),
        entries.len(),
        seconds.iter().sum::<f64>(),
        index.display()
    );
    match entries
        .iter()
        .find(|e| matches!(e.outcome, Outcome::Failed(_)))
    {
        Some(failed) => bail!("{} failed", failed.name),
        None => Ok(()),
    }
}

fn parse(args: &[String]) -> Result<Option<Options>> {
    let mut options = Options {
        quick: false,
        only: String::new(),
        spp: None,
        data: Vec::new(),
        output: repo::root().join("out/render-all"),
    };
    options
        .data
        .extend(std::env::var_os("GONIO_DATA").map(PathBuf::from));
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let mut value = || {
            let value = args.next().cloned();
            value.with_context(|| format!("{arg} wants a value"))
        };
        match arg.as_str() {
            "--quick" => options.quick = true,
            "--only" => options.only = value()?,
            "--spp" => options.spp = Some(value()?),
            "--data" => options.data.push(value()?.into()),
            "-o" => options.output = value()?.into(),
            "--help" | "-h" => return Ok(None),
            other => bail!("unknown option {other:?}\n{HELP}"),
        }
    }
    // programs are started in the repository's root: relative folders are meant from here
    options.data = options
        .data
        .iter()
        .map(std::path::absolute)
        .collect::<Result<_, _>>()?;
    options.output = std::path::absolute(&options.output)?;
    Ok(Some(options))
}

fn one(options: &Options, scene: &Path, name: &str) -> Result<Outcome> {
    let file = match SceneFile::load(scene) {
        Ok(file) => file,
        Err(error) => return Ok(Outcome::Failed(error.to_string())),
    };
    let dirs = DataDirs::new(options.data.iter().cloned());
    let mut measured = Vec::new();
    for material in file.materials.values() {
        let MaterialSpec::File(material) = material else {
            continue;
        };
        match dirs.find(&material.path, &material.home) {
            Ok(found) => measured.push(found),
            Err(error) if error.kind() == ErrorKind::NotFound => {
                return Ok(Outcome::Skipped(format!(
                    "{} is not there",
                    material.path.display()
                )));
            }
            Err(error) => return Ok(Outcome::Failed(error.to_string())),
        }
    }
    let picture = options.output.join(format!("{name}.exr"));
    let mut command = gonio(options);
    command
        .args(["render", "--json", "-o"])
        .arg(&picture)
        .arg(scene);
    if options.quick {
        let [w, h] = [file.film.width, file.film.height].map(|n| n.div_ceil(4));
        command.args(["--size", &format!("{w}x{h}")]);
    }
    let quick = options.quick.then_some("32");
    if let Some(spp) = options.spp.as_deref().or(quick) {
        command.args(["--spp", spp]);
    }
    let start = Instant::now();
    let output = command.output().context("cannot start gonio")?;
    let seconds = start.elapsed().as_secs_f64();
    if !output.status.success() {
        return Ok(Outcome::Failed(
            String::from_utf8_lossy(&output.stderr).trim().to_owned(),
        ));
    }
    let report = serde_json::from_slice(&output.stdout).context("gonio printed no JSON")?;
    let mut plots = Vec::new();
    for file in measured {
        let plot = format!(
            "{name}-{}.svg",
            file.file_stem().unwrap_or_default().to_string_lossy()
        );
        let status = gonio(options)
            .args(["plot", "--theta-i", "45,75,85", "--log", "-o"])
            .arg(options.output.join(&plot))
            .arg(&file)
            .output()?;
        if status.status.success() {
            plots.push(plot);
        }
    }
    Ok(Outcome::Rendered {
        about: file.about.clone(),
        report,
        seconds,
        plots,
    })
}

/// The program built above, told where the data are.
fn gonio(options: &Options) -> Command {
    let mut command = crate::gonio::command();
    for folder in &options.data {
        command.arg("--data").arg(folder);
    }
    command
}
