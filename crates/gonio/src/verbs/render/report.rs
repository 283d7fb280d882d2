//! What a render says of itself.

use super::account::{self, MaterialRow, Memory, Seconds};
use super::trace::Aimed;
use super::{Render, Traced, strategy};
use crate::output::say;
use crate::pictures::Gamut;
use scene_io::BuiltScene;
use scene_io::rows::{CONFIDENCE, Row};
use scene_io::spectral::AnyScene;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::{self, Write};
use std::path::PathBuf;

/// [`Row`] as JSON.
#[derive(Serialize)]
struct RowJson {
    seconds: f64,
    cpu_seconds: f64,
    spp: u32,
    rel_rmse: f64,
    rel_rmse_ci: [f64; 2],
}

/// What `--target-error` came to.
#[derive(Serialize)]
struct TargetJson {
    rel_rmse: f64,
    confidence: f64,
    reached: bool,
    bound: f64,
    rounds: u32,
    pilot_seconds: f64,
}

impl From<&Aimed> for TargetJson {
    fn from(aimed: &Aimed) -> Self {
        Self {
            rel_rmse: aimed.target.rel_rmse,
            confidence: aimed.target.confidence,
            reached: aimed.choice.reached,
            bound: aimed.choice.bound,
            rounds: aimed.choice.rounds,
            pilot_seconds: aimed.seconds,
        }
    }
}

impl From<&Row> for RowJson {
    fn from(row: &Row) -> Self {
        Self {
            seconds: row.seconds,
            cpu_seconds: row.cpu_seconds,
            spp: row.spp,
            rel_rmse: row.rel_rmse,
            rel_rmse_ci: row.ci,
        }
    }
}

#[derive(Serialize)]
pub(super) struct Report {
    written: Vec<PathBuf>,
    pub(super) scene: String,
    pub(super) sampler: String,
    spectrum: &'static str,
    pub(super) spp: u64,
    seconds: f64,
    cpu_seconds: f64,
    build_seconds: f64,
    paths_per_second: f64,
    rmse: Option<f64>,
    rmse_ci: Option<[f64; 2]>,
    rel_rmse: Option<f64>,
    rel_rmse_ci: Option<[f64; 2]>,
    light_strategy: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<TargetJson>,
    rows: Vec<RowJson>,
    left_out: Vec<String>,
    /// Instruction set everything wide ran with.
    instructions: &'static str,
    materials: Vec<MaterialRow>,
    stages: Seconds,
    thread_seconds: BTreeMap<&'static str, f64>,
    memory: Option<Memory>,
    /// Of the PNG; nothing where none is written.
    pub(super) gamut: Option<Gamut>,
    interrupted: bool,
}

impl Report {
    pub(super) fn new(
        built: &BuiltScene<AnyScene>,
        traced: &Traced,
        args: &Render,
        build_seconds: f64,
    ) -> Self {
        let whole = || traced.film.rgb().estimate(CONFIDENCE);
        let estimate = traced.estimate.unwrap_or_else(whole);
        let known = estimate.rel_rmse.is_finite();
        Self {
            written: written(built, args),
            scene: built.file.path.display().to_string(),
            sampler: sampler(built),
            spectrum: built.file.render.spectrum.name(),
            spp: traced.film.samples() / u64::from(built.size.0 * built.size.1).max(1),
            seconds: traced.seconds,
            cpu_seconds: traced.cpu_seconds,
            build_seconds,
            paths_per_second: traced.stats.paths as f64 / traced.seconds.max(1e-9),
            rmse: known.then_some(estimate.rmse),
            rmse_ci: known.then_some(estimate.rmse_ci),
            rel_rmse: known.then_some(estimate.rel_rmse),
            rel_rmse_ci: known.then_some(estimate.rel_rmse_ci),
            light_strategy: strategy::name(built.settings.strategy),
            target: traced.aimed.as_ref().map(TargetJson::from),
            rows: traced.rows.iter().map(RowJson::from).collect(),
            left_out: left_out(built),
            instructions: brdf::instructions(),
            materials: account::materials(built),
            stages: Seconds::default(),
            thread_seconds: account::threads(traced),
            memory: None,
            gamut: None,
            interrupted: traced.interrupted,
        }
    }

    /// What it took, once all is done.
    pub(super) fn account(
        &mut self,
        built: &BuiltScene<AnyScene>,
        traced: &Traced,
        seconds: Seconds,
    ) {
        self.stages = seconds;
        self.memory = Some(Memory::new(built, traced));
    }

    /// Where time and memory went.
    pub(super) fn explain(&self) {
        say(format_args!("instructions: {}", self.instructions));
        self.stages.explain();
        let threads = self.thread_seconds.iter();
        let all: f64 = threads.clone().map(|(_, t)| t).sum();
        let parts: Vec<String> = threads
            .map(|(name, t)| format!("{name} {:.0} %", 100.0 * t / all.max(1e-9)))
            .collect();
        say(format_args!(
            "of {all:.3} s of all threads: {}",
            parts.join(", ")
        ));
        if let Some(memory) = &self.memory {
            memory.explain();
        }
    }

    pub(super) fn print(&self, args: &Render, out: &mut String) -> fmt::Result {
        if self.interrupted {
            writeln!(
                out,
                "interrupted: the picture holds what was rendered until then"
            )?;
        }
        writeln!(
            out,
            "{} samples a pixel in {:.2} s ({:.2} s before that to load and build), {:.2} million paths/s",
            self.spp,
            self.seconds,
            self.build_seconds,
            self.paths_per_second / 1e6
        )?;
        if let Some(target) = &self.target {
            target.print(out)?;
        }
        self.print_error(out)?;
        if let Some(gamut) = &self.gamut {
            gamut.print(out)?;
        }
        for path in &self.written {
            writeln!(out, "wrote {}", path.display())?;
        }
        if args.scene.is_none() && args.material.is_none() {
            writeln!(
                out,
                "\nThat was the embedded default: two models, measured on the fly by a virtual gonioreflectometer. Now your own file:\n  \
                 gonio info FILE\n  gonio plot FILE --theta-i 45 -o lobes.svg\n  gonio render --material FILE -o mine.exr"
            )?;
        }
        Ok(())
    }
}

impl TargetJson {
    fn print(&self, out: &mut String) -> fmt::Result {
        let percent = |x: f64| 100.0 * x;
        writeln!(
            out,
            "target {:.3} % {}: with {:.3} % confidence at most {:.3} %, by a pilot of {} rounds in {:.2} s",
            percent(self.rel_rmse),
            if self.reached { "met" } else { "not met" },
            percent(self.confidence),
            percent(self.bound),
            self.rounds,
            self.pilot_seconds
        )
    }
}

impl Report {
    fn print_error(&self, out: &mut String) -> fmt::Result {
        let (Some(rmse), Some(rmse_ci), Some(rel), Some(rel_ci)) =
            (self.rmse, self.rmse_ci, self.rel_rmse, self.rel_rmse_ci)
        else {
            return writeln!(out, "relative RMSE unknown: too few samples to estimate it");
        };
        writeln!(
            out,
            "relative RMSE {:.3} %, 95 % interval {:.3} to {:.3} %; RMSE {rmse:.3e} ({:.3e} to {:.3e})",
            100.0 * rel,
            100.0 * rel_ci[0],
            100.0 * rel_ci[1],
            rmse_ci[0],
            rmse_ci[1]
        )
    }
}

/// Name of the sampler of the main material.
pub(super) fn sampler(built: &BuiltScene<AnyScene>) -> String {
    let main = built.materials.first();
    main.map_or_else(|| "none".into(), |m| m.sampler.name.to_string())
}

fn written(built: &BuiltScene<AnyScene>, args: &Render) -> Vec<PathBuf> {
    let png = args.output.with_extension("png");
    let mut all: Vec<_> = args.checkpoint.iter().collect();
    if built.settings.shard.is_none() {
        all.extend([&args.output, &png]);
        all.extend(args.error_map.iter().chain(&args.rows));
    }
    all.into_iter().cloned().collect()
}

/// What the scene and its files do not use, and what the tracer then does without.
fn left_out(built: &BuiltScene<AnyScene>) -> Vec<String> {
    let traced = built.scene.left_out(&built.settings);
    let traced = traced.iter().map(ToString::to_string);
    built.left_out.iter().cloned().chain(traced).collect()
}

/// What was built, and what was not.
pub(super) fn explain(built: &BuiltScene<AnyScene>, build_seconds: f64) {
    say(format_args!("built in {build_seconds:.3} s:"));
    for material in &built.materials {
        let file = material
            .file
            .as_ref()
            .map(|f| format!(" from {}", f.display()))
            .unwrap_or_default();
        let s = &material.sampler;
        say(format_args!(
            "  material {}{file}: table {} bytes, {:.3} s; sampler {}, {} bytes, {:.3} s",
            material.name,
            material.table_bytes,
            material.seconds[0],
            s.name,
            s.bytes,
            material.seconds[1]
        ));
        for note in &s.notes {
            say(format_args!("    {note}"));
        }
    }
    say("left out:");
    for line in left_out(built) {
        say(format_args!("  {line}"));
    }
}
