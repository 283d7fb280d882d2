//! `cargo xtask render-all`: every scene its data allow, with polar plots and a contact sheet.

mod page;

use crate::{process, repo};
use anyhow::{Context, Result, bail};
use page::{Entry, Outcome};
use scene_io::scene::MaterialSpec;
use scene_io::{DataDirs, ErrorKind, SceneFile};
use std::path::{Path, PathBuf};
use std::process::Command;

const HELP: &str = "\
cargo xtask render-all [--quick] [--data DIR]... [-o DIR]
  --quick     a quarter of the width and height, 32 samples a pixel
  --data DIR  where measured files are (also GONIO_DATA)
  -o DIR      output folder (default: out/render-all)
";

struct Options {
    quick: bool,
    data: Vec<PathBuf>,
    output: PathBuf,
}

pub(crate) fn run(args: &[String]) -> Result<()> {
    let Some(options) = parse(args)? else {
        print!("{HELP}");
        return Ok(());
    };
    process::run("cargo", &["build", "--release", "--package", "gonio"])?;
    std::fs::create_dir_all(&options.output)
        .with_context(|| options.output.display().to_string())?;
    let mut entries = Vec::new();
    for path in repo::files("scenes", "scene.ron")? {
        let name = repo::shown(path.parent().unwrap_or(&path))
            .trim_start_matches("scenes/")
            .replace('/', "-");
        let entry = Entry {
            outcome: one(&options, &path, &name)?,
            name,
        };
        println!("{}", entry.line());
        entries.push(entry);
    }
    let index = options.output.join("index.html");
    std::fs::write(&index, page::html(&entries)).with_context(|| index.display().to_string())?;
    let rendered = entries
        .iter()
        .filter(|e| matches!(e.outcome, Outcome::Rendered { .. }))
        .count();
    println!(
        "rendered {rendered} of {} scenes; see {}",
        entries.len(),
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
        data: Vec::new(),
        output: repo::root().join("out/render-all"),
    };
    options
        .data
        .extend(std::env::var_os("GONIO_DATA").map(PathBuf::from));
    let mut args = args.iter();
    while let Some(arg) = args.next() {
        let mut folder = || {
            args.next()
                .map(PathBuf::from)
                .with_context(|| format!("{arg} wants a folder"))
        };
        match arg.as_str() {
            "--quick" => options.quick = true,
            "--data" => options.data.push(folder()?),
            "-o" => options.output = folder()?,
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
        command.args([
            "--spp",
            "32",
            "--size",
            &format!(
                "{}x{}",
                file.film.width.div_ceil(4),
                file.film.height.div_ceil(4)
            ),
        ]);
    }
    let output = command.output().context("cannot start gonio")?;
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
        plots,
    })
}

/// The program built above, told where the data are.
fn gonio(options: &Options) -> Command {
    let target = std::env::var_os("CARGO_TARGET_DIR")
        .map_or_else(|| repo::root().join("target"), PathBuf::from);
    let mut command = Command::new(target.join("release").join("gonio"));
    for folder in &options.data {
        command.arg("--data").arg(folder);
    }
    command
}
