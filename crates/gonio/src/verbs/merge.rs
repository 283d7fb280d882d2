//! `gonio merge SHARD... -o OUT.exr`.

use super::Context;
use super::render::keeper::part;
use crate::args::parse_exr;
use crate::pictures::{Gamut, write_pictures};
use anyhow::{Context as _, Result, bail};
use clap::Args;
use scene_io::checkpoint::About;
use scene_io::image::{Metadata, Picture, ToneMap};
use scene_io::rows::CONFIDENCE;
use scene_io::spectral::AnyFilm;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt::{self, Write};
use std::path::{Path, PathBuf};
use tracer::{Film, Shard};

/// Put the shards of a picture together: the same bits as one render.
#[derive(Debug, Args)]
#[command(after_help = "Example:
  gonio render --checkpoint part1 --shard 1/2
  gonio render --checkpoint part2 --shard 2/2               (here or on another machine)
  gonio merge part1 part2 -o whole.exr")]
pub(crate) struct Merge {
    /// What `gonio render --shard K/N --checkpoint SHARD` wrote, all of them.
    #[arg(required = true, value_name = "SHARD")]
    pub(crate) shards: Vec<PathBuf>,
    /// Output; a tone-mapped PNG is written beside it.
    #[arg(short, long, value_name = "OUT.exr", value_parser = parse_exr)]
    pub(crate) output: PathBuf,
}

#[derive(Serialize)]
struct Report {
    written: [PathBuf; 2],
    scene: String,
    sampler: String,
    shards: u32,
    spp: u32,
    rmse: f64,
    rmse_ci: [f64; 2],
    rel_rmse: f64,
    rel_rmse_ci: [f64; 2],
    gamut: Gamut,
}

pub(crate) fn run(context: &Context, args: &Merge) -> Result<()> {
    scene_io::write::check(&args.output)?;
    let (whole, shards) = gather(&args.shards)?;
    let about = &whole.about;
    let film = whole.film.rgb();
    let mut picture = Picture::of_film(&film)?;
    picture.metadata = Metadata {
        scene: Some(about.scene.clone()),
        seed: Some(about.seed),
        spp: Some(about.spp.into()),
        seconds: None,
        version: Some(env!("CARGO_PKG_VERSION").into()),
        sampler: Some(about.sampler.clone()),
    };
    let auto = || ToneMap::auto(&picture).scale;
    let tone = ToneMap {
        scale: about.exposure.unwrap_or_else(auto),
        gamut: about.gamut,
    };
    let (png, gamut) = write_pictures(&args.output, &whole.film, &picture, tone)?;
    let estimate = film.estimate(CONFIDENCE);
    let report = Report {
        written: [args.output.clone(), png],
        scene: about.scene.clone(),
        sampler: about.sampler.clone(),
        shards,
        spp: about.spp,
        rmse: estimate.rmse,
        rmse_ci: estimate.rmse_ci,
        rel_rmse: estimate.rel_rmse,
        rel_rmse_ci: estimate.rel_rmse_ci,
        gamut: Gamut::new(tone, gamut),
    };
    context.report(&report, |out| report.print(out))
}

impl Report {
    fn print(&self, out: &mut String) -> fmt::Result {
        writeln!(
            out,
            "{} shards, {} samples a pixel; relative RMSE {:.3} %, 95 % interval {:.3} to {:.3} %",
            self.shards,
            self.spp,
            100.0 * self.rel_rmse,
            100.0 * self.rel_rmse_ci[0],
            100.0 * self.rel_rmse_ci[1]
        )?;
        self.gamut.print(out)?;
        self.written
            .iter()
            .try_for_each(|path| writeln!(out, "wrote {}", path.display()))
    }
}

/// A checkpoint of any mode.
struct Found {
    film: AnyFilm,
    about: About,
    key: u64,
}

/// The whole picture, and of how many shards.
fn gather(paths: &[PathBuf]) -> Result<(Found, u32)> {
    let mut whole: Option<(&Path, Found, Shard)> = None;
    let mut seen = BTreeMap::new();
    for path in paths {
        let (film, about, key) = AnyFilm::open(path)?;
        let found = Found { film, about, key };
        let name = path.display();
        let Some(shard) = found.about.shard else {
            bail!("{name}: expected a shard, found the checkpoint of a whole picture");
        };
        if let Some(twin) = seen.insert(shard.index, path) {
            bail!(
                "{name}: expected each shard once, found {} again after {}",
                part(Some(shard)),
                twin.display()
            );
        }
        finished(&found, shard).with_context(|| name.to_string())?;
        match &mut whole {
            None => whole = Some((path, found, shard)),
            Some((first, whole, of)) => {
                let same = |f: &Film<3>| (f.width(), f.height(), f.replicates());
                if found.key != whole.key
                    || shard.count != of.count
                    || found.about.spp != whole.about.spp
                    || found.about.channels != whole.about.channels
                    || same(&found.film.rgb()) != same(&whole.film.rgb())
                {
                    bail!(
                        "{name}: expected a shard of the render of {}, found one of another",
                        first.display()
                    );
                }
                whole.film.take(&found.film, shard)?;
            }
        }
    }
    let Some((_, whole, shard)) = whole else {
        bail!("expected shards, found none");
    };
    let missing: Vec<String> = (0..shard.count)
        .filter(|k| !seen.contains_key(k))
        .map(|k| format!("{}/{}", k + 1, shard.count))
        .collect();
    if !missing.is_empty() {
        bail!(
            "expected all {} shards, found none for {}",
            shard.count,
            missing.join(", ")
        );
    }
    Ok((whole, shard.count))
}

fn finished(found: &Found, shard: Shard) -> Result<()> {
    let done = super::render::keeper::least(&found.film.rgb(), Some(shard));
    if done < found.about.spp {
        bail!(
            "expected {} samples a pixel, found {done}: render it again with the same checkpoint to go on",
            found.about.spp
        );
    }
    Ok(())
}
