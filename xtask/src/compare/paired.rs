//! Both programs in turn, so that what the machine does besides slows both: whole processes, and paths a second.

use super::{Asked, Peer, folder, said};
use crate::gonio::{command, number, run};
use crate::repo;
use anyhow::{Context, Result};
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Samples a pixel of whole processes.
const FEW: u32 = 16;
/// Samples a pixel where the start does not matter.
const MANY: u32 = 64;
/// Pairs of whole processes; `--pairs` may ask for more.
const PAIRS: usize = 7;

/// Seconds from the start of the process to its end.
pub(super) fn from_start(asked: &Asked) -> Result<()> {
    println!(
        "| material | ours, s | of it paths, s | Mitsuba, s | ratio (quartiles) |\n|---|---:|---:|---:|---:|"
    );
    let pairs = asked.pairs.parse().unwrap_or(PAIRS).max(PAIRS);
    for (name, file, ..) in asked.rows() {
        let path = asked.path(*file)?;
        let folder = folder(&format!("{name}-start"))?;
        let (mut ours, mut paths, mut theirs) = (Vec::new(), Vec::new(), Vec::new());
        // the first pair warms caches, the peer's of machine code among them
        for pair in 0..=pairs {
            let start = Instant::now();
            let report = run(&mut render(asked, path.as_deref(), (FEW, &folder)))?;
            let own = start.elapsed().as_secs_f64();
            let start = Instant::now();
            let mut peer = asked.peer("area", path.as_deref());
            peer.args(["--once", "--spp", &FEW.to_string(), "--out"])
                .arg(folder.join("mitsuba.exr"));
            said(&mut peer)?;
            if pair > 0 {
                theirs.push(start.elapsed().as_secs_f64());
                ours.push(own);
                paths.push(number(&report, "/seconds")?);
            }
        }
        let ratios = ours.iter().zip(&theirs).map(|(a, b)| b / a).collect();
        println!(
            "| {name} | {:.3} | {:.3} | {:.3} | {} |",
            quartiles(ours)[1],
            quartiles(paths)[1],
            quartiles(theirs)[1],
            spread(ratios)
        );
    }
    Ok(())
}

/// Paths a second, and squared error times seconds, once all is warm.
pub(super) fn steady(asked: &Asked) -> Result<()> {
    println!(
        "| material | ours, M paths/s | Mitsuba | ratio (quartiles) | MSE x seconds, Mitsuba over ours |\n|---|---:|---:|---:|---:|"
    );
    let pixels = asked.size.0.parse::<f64>()? * asked.size.1.parse::<f64>()?;
    let millions = 1e-6 * pixels * f64::from(MANY);
    for (name, file, ..) in asked.rows() {
        let path = asked.path(*file)?;
        let folder = folder(&format!("{name}-steady"))?;
        let mut rates = [Vec::new(), Vec::new()];
        let (mut ratios, mut errors) = (Vec::new(), Vec::new());
        for _ in 0..asked.pairs.parse::<usize>()?.max(2) {
            let report = run(&mut render(asked, path.as_deref(), (MANY, &folder)))?;
            let mut peer = asked.peer("area", path.as_deref());
            peer.args(["--spp", &MANY.to_string(), "--pairs", "1", "--out"])
                .arg(folder.join("mitsuba.exr"));
            let peer: Peer =
                serde_json::from_slice(&said(&mut peer)?).context("the peer printed no JSON")?;
            let theirs = &peer.rows[1];
            let seconds = theirs.seconds.iter().sum::<f64>() / theirs.seconds.len() as f64;
            let own = number(&report, "/seconds")?;
            let mse = number(&report, "/rmse")?.powi(2);
            rates[0].push(millions / own);
            rates[1].push(millions / seconds);
            ratios.push(seconds / own);
            errors.push(theirs.mse[0] * seconds / (mse * own));
        }
        let [ours, theirs] = rates;
        println!(
            "| {name} | {:.1} | {:.1} | {} | {} |",
            quartiles(ours)[1],
            quartiles(theirs)[1],
            spread(ratios),
            spread(errors)
        );
    }
    Ok(())
}

/// Ours, as a user would call it.
fn render(asked: &Asked, material: Option<&Path>, (spp, folder): (u32, &Path)) -> Command {
    let mut command = command();
    command
        .arg("render")
        .arg(repo::root().join("scenes/benchmark/scene.ron"))
        .args(["--spp", &spp.to_string(), "--threads", "2"])
        .args([
            "--size",
            &format!("{}x{}", asked.size.0, asked.size.1),
            "-o",
        ])
        .arg(folder.join("gonio.exr"));
    if let Some(path) = material {
        command.arg("--material").arg(path);
    }
    command
}

/// First quartile, median, third quartile.
fn quartiles(mut values: Vec<f64>) -> [f64; 3] {
    values.sort_by(f64::total_cmp);
    let last = values.len().saturating_sub(1) as f64;
    [0.25, 0.5, 0.75].map(|part| {
        let at = part * last;
        let (low, high) = (at.floor() as usize, at.ceil() as usize);
        let between = at - at.floor();
        values[low] * (1.0 - between) + values[high] * between
    })
}

fn spread(values: Vec<f64>) -> String {
    let [low, median, high] = quartiles(values);
    format!("{median:.2} ({low:.2} to {high:.2})")
}
