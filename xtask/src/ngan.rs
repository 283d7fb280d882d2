//! `cargo xtask ngan [DIR]`: our fits against the parameters published by Ngan, Durand and Matusik, on the same data.

mod published;

use anyhow::{Context, Result};
use brdf::{Measured, Status};
use brdf_fit::{FitData, Metric, Samples, error_of, family, fit};
use published::{FAMILIES, Row};
use scene_io::material::{MaterialOptions, load_measured};
use std::path::{Path, PathBuf};

/// MERL's cells [Matusik2003].
const DIMS: [usize; 3] = [90, 90, 180];
/// Ngan and others left out what is further from the normal.
const CUTOFF_DEG: f64 = 80.0;

pub(crate) fn run(args: &[String]) -> Result<()> {
    let usage = "usage: cargo xtask ngan DIR (a folder of MERL files), with GONIO_DATA set";
    let folder = PathBuf::from(args.first().context(usage)?);
    let data = PathBuf::from(std::env::var_os("GONIO_DATA").context(usage)?);
    let mut files: Vec<PathBuf> = std::fs::read_dir(&folder)
        .with_context(|| folder.display().to_string())?
        .filter_map(|e| Some(e.ok()?.path()))
        .filter(|p| p.extension().is_some_and(|e| e == "binary"))
        .collect();
    files.sort();
    println!("| material | model | ours | Ngan's parameters | ratio | seconds |");
    println!("|---|---|---|---|---|---|");
    let (mut pairs, mut above, mut worst) = (0_u32, 0_u32, 0.0_f64);
    for file in files {
        let name = file
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        let table = FitData::new(samples(&file)?, Metric::Ngan);
        for entry in FAMILIES {
            let Some(row) = Row::read(&data.join("fits"), entry, &name)? else {
                continue;
            };
            let theirs = error_of::<3>(&row, table.samples(), Metric::Ngan);
            let ours = fit(&*family(entry.family, 1)?, &table)?;
            let ratio = ours.error / theirs;
            println!(
                "| {name} | {} | {:.5} | {theirs:.5} | {ratio:.4} | {:.2} |",
                entry.family, ours.error, ours.seconds
            );
            pairs += 1;
            above += u32::from(ratio > 1.0);
            worst = worst.max(ratio);
        }
    }
    println!("\n{pairs} pairs, ours above Ngan's in {above}, largest ratio {worst:.4}");
    Ok(())
}

/// The measured cells of a MERL file.
fn samples(file: &Path) -> Result<Samples> {
    let loaded = load_measured(file, &MaterialOptions::default())?;
    let measured = loaded.measured;
    let all = Samples::on_grid(DIMS, 3, |wi, wo, out| {
        measured.eval_native(wi, wo, out) != Status::Filled
    });
    Ok(all.within(CUTOFF_DEG))
}
