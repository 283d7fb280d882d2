//! `--checkpoint` and `--shard`: what of a render survives the program.

use super::Render;
use crate::output::say;
use anyhow::{Result, bail};
use scene_io::checkpoint::About;
use scene_io::scene::ExposureSpec;
use scene_io::spectral::{AnyFilm, AnyScene};
use scene_io::{BuiltScene, Places, fingerprint};
use std::path::{Path, PathBuf};
use std::time::Duration;
use tracer::{Film, Shard};

/// Keeps the samples of a render in a file.
pub(super) struct Keeper {
    pub(super) path: PathBuf,
    pub(super) every: Duration,
    about: About,
    key: u64,
}

impl Keeper {
    pub(super) fn new(
        path: &Path,
        args: &Render,
        built: &BuiltScene<AnyScene>,
        places: &Places,
    ) -> Self {
        let exposure = match built.exposure {
            ExposureSpec::Auto => None,
            ExposureSpec::Scale(scale) => Some(scale.0 as f32),
        };
        Self {
            path: path.to_owned(),
            every: Duration::from_secs_f64(args.checkpoint_every),
            about: About {
                scene: built.file.path.display().to_string(),
                sampler: super::report::sampler(built),
                seed: built.settings.seed,
                spp: built.settings.spp,
                exposure,
                gamut: built.file.film.gamut.mapping(),
                channels: None,
                shard: built.settings.shard,
            },
            key: fingerprint(&built.file, &built.settings, places),
        }
    }

    /// Takes up what the file holds, if there is one; otherwise sees whether it can be written.
    pub(super) fn restore(&self, film: &mut AnyFilm) -> Result<()> {
        if !self.path.exists() {
            return Ok(scene_io::write::check(&self.path)?);
        }
        let mut found = film.clone();
        let about = found.restore(&self.path, self.key)?;
        if about.shard != self.about.shard {
            bail!(
                "{}: expected {}, found {}",
                self.path.display(),
                part(self.about.shard),
                part(about.shard)
            );
        }
        let sums = found.rgb();
        let most = sums.tiles().map(|t| t.done()).max();
        let most = most.unwrap_or_default();
        if most > self.about.spp {
            bail!(
                "{}: expected at most {} samples a pixel, found {most}",
                self.path.display(),
                self.about.spp
            );
        }
        say(format_args!(
            "going on from {}: {} of {} samples a pixel",
            self.path.display(),
            least(&sums, self.about.shard),
            self.about.spp
        ));
        drop(sums);
        *film = found;
        Ok(())
    }

    pub(super) fn save(&self, film: &AnyFilm) -> Result<()> {
        Ok(film.save(&self.path, &self.about, self.key)?)
    }
}

/// Samples a pixel that every tile of the shard has.
pub(crate) fn least<const N: usize>(film: &Film<N>, shard: Option<Shard>) -> u32 {
    let tiles = film.tiles().enumerate();
    tiles
        .filter(|(i, _)| shard.is_none_or(|s| s.has(*i)))
        .map(|(_, tile)| tile.done())
        .min()
        // a shard of a picture with fewer tiles than shards has nothing to do
        .unwrap_or(u32::MAX)
}

/// A shard in words.
pub(crate) fn part(shard: Option<Shard>) -> String {
    shard.map_or_else(
        || "a whole picture".into(),
        |s| format!("shard {}/{}", s.index + 1, s.count),
    )
}
