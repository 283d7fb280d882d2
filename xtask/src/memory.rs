//! `cargo xtask memory`: the bytes a render takes by arithmetic beside the largest resident size the system saw.

use crate::gonio::{self, number, report};
use crate::repo;
use anyhow::{Context, Result, bail};
use std::fmt::Write;
use std::path::{Path, PathBuf};

const HELP: &str = "cargo xtask memory --data DIR...
renders one scene of each kind that its data allow, and one of a million triangles in all MERL files of the folders";

/// Segments of each of the 25 balls: 40,400 triangles.
const SEGMENTS: usize = 202;
const BALLS: usize = 25;

pub(crate) fn run(args: &[String]) -> Result<()> {
    let mut folders = Vec::new();
    for pair in args.chunks(2) {
        match pair {
            [key, folder] if key == "--data" => folders.push(PathBuf::from(folder)),
            _ => bail!("{HELP}"),
        }
    }
    gonio::build()?;
    let out = repo::root().join("target/memory");
    std::fs::create_dir_all(&out).with_context(|| out.display().to_string())?;
    let mut rows: Vec<(&str, Vec<String>)> = Vec::new();
    let benchmark = scene("benchmark");
    rows.push(("benchmark, GGX", vec![benchmark.clone()]));
    let find = |name: &str| folders.iter().map(|f| f.join(name)).find(|f| f.exists());
    for (label, file, sampler) in [
        ("benchmark, brass, hvt", "brass.binary", "hvt"),
        ("benchmark, brass, cosine", "brass.binary", "cosine"),
        (
            "benchmark, RGL, its own",
            "satin_rosaline_rgb.bsdf",
            "native",
        ),
        ("benchmark, RGL, hvt", "satin_rosaline_rgb.bsdf", "hvt"),
        ("benchmark, Cornell", "garnet_red_RGB.astm", "hvt"),
    ] {
        if let Some(path) = find(file) {
            let path = path.display().to_string();
            let more = ["--material", &path, "--sampler", sampler].map(String::from);
            rows.push((label, [&[benchmark.clone()][..], &more].concat()));
        }
    }
    rows.push(("benchmark-mesh", vec![scene("benchmark-mesh")]));
    for (label, spectrum) in [
        ("benchmark, 8 samples", "8"),
        ("benchmark, 45 samples", "45"),
        ("benchmark, hero", "hero"),
    ] {
        let more = ["--spectrum", spectrum].map(String::from);
        rows.push((label, [&[benchmark.clone()][..], &more].concat()));
    }
    if let Some(file) = million(&folders, &out)? {
        rows.push(("a million triangles, 25 materials", vec![file]));
    }
    println!(
        "| scene | film | pictures | tables | samplers | triangles | workers | (building) | in all | seen | ratio | s to build |\n\
         |---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
    );
    for (label, arguments) in rows {
        println!("{}", row(label, &arguments, &out)?);
    }
    Ok(())
}

fn scene(name: &str) -> String {
    let path = repo::root().join("scenes").join(name).join("scene.ron");
    path.display().to_string()
}

fn row(label: &str, arguments: &[String], out: &Path) -> Result<String> {
    let output = out.join("out.exr").display().to_string();
    let mut all = vec!["render", "--spp", "8", "--threads", "2", "-o", &output];
    all.extend(arguments.iter().map(String::as_str));
    let said = report(&all)?;
    let mb = |name: &str| Ok::<_, anyhow::Error>(number(&said, &format!("/memory/{name}"))? / 1e6);
    let mut line = format!("| {label} |");
    for name in [
        "film",
        "pictures",
        "tables",
        "samplers",
        "triangles",
        "workers",
        "building",
        "sum",
        "peak",
    ] {
        write!(line, " {:.1} |", mb(name)?)?;
    }
    write!(
        line,
        " {:.2} | {:.2} |",
        mb("peak")? / mb("sum")?,
        number(&said, "/build_seconds")?
    )?;
    Ok(line)
}

/// 25 balls of 40,400 triangles, each of another MERL file; `None` if there are not as many.
fn million(folders: &[PathBuf], out: &Path) -> Result<Option<String>> {
    let mut files = Vec::new();
    for folder in folders {
        for entry in std::fs::read_dir(folder).with_context(|| folder.display().to_string())? {
            let path = entry?.path();
            if path.extension().is_some_and(|e| e == "binary") {
                files.push(path);
            }
        }
    }
    files.sort();
    if files.len() < BALLS {
        return Ok(None);
    }
    let (mut materials, mut shapes) = (String::new(), String::new());
    for (k, file) in files.iter().take(BALLS).enumerate() {
        let file = std::path::absolute(file)?.display().to_string();
        writeln!(materials, "\"m{k}\": File(path: {file:?}),")?;
        let (x, z) = (1.1 * (k % 5) as f64 - 2.2, 1.1 * (k / 5) as f64 - 2.2);
        writeln!(
            shapes,
            "(form: UvSphere(center: ({x}, 0.5, {z}), radius: 0.5, segments: {SEGMENTS}), material: \"m{k}\"),"
        )?;
    }
    let base = scene("benchmark");
    let text = format!(
        "(base: {base:?}, materials: {{\n{materials}}},\nmain_material: \"m0\",\nshapes: [\n{shapes}\
         (form: Quad(corner: (-10, 0, 10), edge_u: (20, 0, 0), edge_v: (0, 0, -20)), material: \"grey\"),\n\
         (form: Quad(corner: (-1, 4, 0), edge_u: (2, 0, 0), edge_v: (0, 0, 2)), material: \"grey\", emission: 10, one_sided: true),\n])\n"
    );
    let path = out.join("million.ron");
    std::fs::write(&path, text).with_context(|| path.display().to_string())?;
    Ok(Some(path.display().to_string()))
}
