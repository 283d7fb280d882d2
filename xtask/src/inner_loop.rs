//! `cargo xtask inner-loop`: whether RGB scenes pay for the spectral code.
//!
//! Two programs of the same scene, one that can render in RGB alone and one that has every mode; the machine code of the
//! stream's loop over RGB paths is compared between them, instruction by instruction. Needs `objdump`.

use crate::{process, repo};
use anyhow::{Context, Result, bail};
use std::process::Command;

const PROGRAMS: [&str; 2] = ["inner_loop_rgb", "inner_loop_all"];
/// What the mangled name of the loop contains: three channels.
const LOOP: &str = "5batch5BatchKj3_";
/// The instruction sets it is compiled for, as they show in the name.
const SETS: [(&str, &str); 2] = [("AVX2", "_2V39vectorize"), ("AVX-512", "_2V49vectorize")];
/// What fills the space between blocks of code.
const PADDING: [&str; 6] = ["nop", "nopw", "nopl", "data16", "cs", "int3"];

pub(crate) fn run() -> Result<()> {
    let target = repo::root().join("target/inner-loop");
    let folder = target.to_string_lossy();
    // names that say what a function was made for
    let names = "build.rustflags=[\"-Csymbol-mangling-version=v0\"]";
    let mut args = vec!["build", "--release", "-p", "tracer"];
    args.extend(["--target-dir", &folder, "--config", names]);
    PROGRAMS.iter().for_each(|p| args.extend(["--example", p]));
    process::run("cargo", &args)?;
    let mut differ = false;
    for (set, mark) in SETS {
        let [alone, beside] = PROGRAMS.map(|program| {
            let program = target.join("release/examples").join(program);
            instructions(&program.to_string_lossy(), mark)
        });
        let (alone, beside) = (alone?, beside?);
        let same = alone == beside;
        differ |= !same;
        println!(
            "{set}: {} instructions alone, {} beside six spectral modes: {}",
            alone.len(),
            beside.len(),
            if same { "the same" } else { "others" }
        );
    }
    if differ {
        bail!("expected the same instructions in both programs");
    }
    Ok(())
}

/// The instructions of the loop for one instruction set, without the addresses that depend on where it was put.
fn instructions(program: &str, mark: &str) -> Result<Vec<String>> {
    let output = Command::new("objdump")
        .args(["-d", "--no-show-raw-insn", program])
        .output()
        .context("cannot start objdump")?;
    let text = String::from_utf8_lossy(&output.stdout);
    let is_loop = |line: &str| line.contains(LOOP) && line.contains(mark) && line.ends_with(">:");
    let body = text
        .split("\n\n")
        .find(|function| function.lines().next().is_some_and(is_loop))
        .with_context(|| format!("{program}: expected a function named like {mark}..{LOOP}"))?;
    let code = body.lines().skip(1).filter_map(|l| l.split_once('\t'));
    Ok(code.filter_map(|(_, code)| without_places(code)).collect())
}

/// An instruction without what depends on where code and constants were put; `None` for padding.
///
/// Calls and jumps lose their aim: functions of the same code are one in the program, under the name of any.
fn without_places(code: &str) -> Option<String> {
    let code = code.split('#').next().unwrap_or(code).trim();
    let operation = code.split_whitespace().next().unwrap_or_default();
    let padding = PADDING.contains(&operation) || code == "xchg %ax,%ax";
    let aims = operation.starts_with("call") || operation.starts_with('j');
    let text = match code.find("(%rip)") {
        _ if aims => operation.to_owned(),
        Some(at) => {
            let start = code[..at].rfind([' ', ',', '*']).map_or(0, |s| s + 1);
            format!("{}{}", &code[..start], &code[at..])
        }
        None => code.to_owned(),
    };
    (!padding && !text.is_empty()).then_some(text)
}
