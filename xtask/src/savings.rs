//! `cargo xtask savings`: what each thing that `--explain` lists as left out would cost, were it there.
//!
//! Each row is the benchmark scene with and without one feature that changes next to nothing in the picture; both are
//! rendered in turn, and the ratio of processor times is told with its quartiles.

use crate::gonio::{self, number, report};
use crate::repo;
use anyhow::{Context, Result};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Pairs of renders a row.
const PAIRS: usize = 15;

/// The shapes of the benchmark.
const SPHERE: &str =
    r#"(form: Sphere(center: (0, 1, 0), radius: 1), material: "measured", one_sided: true),"#;
const GROUND: &str = r#"(form: Quad(corner: (-10, 0, 10), edge_u: (20, 0, 0), edge_v: (0, 0, -20)), material: "grey", one_sided: true),"#;

fn lamp(x: f64, emission: &str) -> String {
    format!(
        r#"(form: Quad(corner: ({x}, 4, 0), edge_u: (0.1, 0, 0), edge_v: (0, 0, 2)), material: "grey", {emission} one_sided: true),"#
    )
}

fn lamps(count: usize) -> String {
    let mut all = String::new();
    for k in 0..count {
        all += &lamp(0.12 * k as f64 - 1.0, "emission: 10,");
    }
    all
}

fn scene(shapes: &str, more: &str) -> String {
    let base = repo::root().join("scenes/benchmark/scene.ron");
    format!(
        "(base: {:?}, shapes: [{SPHERE} {GROUND} {shapes}], {more})\n",
        base.display().to_string()
    )
}

/// What is left out, a scene without it and one with it.
fn rows(folder: &Path) -> Result<Vec<(&'static str, [String; 2])>> {
    let one = lamps(1);
    let mesh = folder.join("triangle.obj");
    // below the ground: no ray comes there
    let text = "v 0 -5 0\nv 0.1 -5 0\nv 0 -5 0.1\nvn 0 1 0\nf 1//1 2//1 3//1\n";
    std::fs::write(&mesh, text).with_context(|| mesh.display().to_string())?;
    let triangle = |flat: bool| {
        let path = mesh.display().to_string();
        format!(r#"{one} (form: Mesh(path: {path:?}, flat: {flat}), material: "grey"),"#)
    };
    let sky = "lights: [Constant(radiance: 0.3)]";
    let dark = lamp(-1.0, "");
    Ok(vec![
        ("triangles", [scene(&one, ""), scene(&triangle(true), "")]),
        (
            "shading normals",
            [scene(&triangle(true), ""), scene(&triangle(false), "")],
        ),
        (
            "environment",
            [
                scene(&one, ""),
                scene(&one, "lights: [Constant(radiance: 1e-20)]"),
            ],
        ),
        (
            "asking lights",
            [
                scene(&dark, sky),
                scene(&lamp(-1.0, "emission: 1e-20,"), sky),
            ],
        ),
        ("choice of a light", [scene(&one, ""), scene(&lamps(2), "")]),
        ("light tree", [scene(&lamps(15), ""), scene(&lamps(16), "")]),
        (
            "roulette",
            [scene(&one, ""), scene(&one, "render: (roulette: 1000)")],
        ),
        (
            "pixel filter",
            [
                scene(&one, ""),
                scene(&one, "film: (filter: Gaussian(sigma: 0.5, radius: 1.5))"),
            ],
        ),
    ])
}

pub(crate) fn run() -> Result<()> {
    gonio::build()?;
    let folder = repo::root().join("target/savings");
    std::fs::create_dir_all(&folder).with_context(|| folder.display().to_string())?;
    println!("| left out | ns a path without | with, over without (quartiles) |\n|---|---:|---:|");
    for (name, scenes) in rows(&folder)? {
        let mut files = Vec::new();
        for (k, text) in scenes.iter().enumerate() {
            let file = folder.join(format!("{}-{k}.ron", name.replace(' ', "-")));
            std::fs::write(&file, text).with_context(|| file.display().to_string())?;
            files.push(file);
        }
        println!("{}", row(name, &files, &folder.join("out.exr"))?);
    }
    Ok(())
}

fn row(name: &str, files: &[PathBuf], output: &Path) -> Result<String> {
    let cost = |file: &Path| -> Result<f64> {
        let (file, output) = (file.display().to_string(), output.display().to_string());
        let said = report(&[
            "render",
            &file,
            "-o",
            &output,
            "--size",
            "320x240",
            "--spp",
            "16",
            "--threads",
            "1",
            "--light-strategy",
            "mis",
        ])?;
        Ok(number(&said, "/cpu_seconds")? * 1e9 / (320.0 * 240.0 * 16.0))
    };
    let (mut without, mut ratios) = (Vec::new(), Vec::new());
    for _ in 0..PAIRS {
        let pair = [cost(&files[0])?, cost(&files[1])?];
        without.push(pair[0]);
        ratios.push(pair[1] / pair[0]);
    }
    without.sort_by(f64::total_cmp);
    ratios.sort_by(f64::total_cmp);
    let mut line = String::new();
    let at = |k: usize| ratios[PAIRS * k / 4];
    write!(
        line,
        "| {name} | {:.1} | {:.3} ({:.3} to {:.3}) |",
        without[PAIRS / 2],
        at(2),
        at(1),
        at(3)
    )?;
    Ok(line)
}
