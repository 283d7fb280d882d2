//! The verbs: each parses nothing, calls a library, prints.

pub(crate) mod compare;
pub(crate) mod converge;
pub(crate) mod convert;
pub(crate) mod eval;
pub(crate) mod fit;
pub(crate) mod info;
pub(crate) mod measure;
pub(crate) mod merge;
pub(crate) mod mix;
pub(crate) mod plot;
pub(crate) mod render;
pub(crate) mod samplers;
pub(crate) mod spectra;
pub(crate) mod stress;

use crate::args::Cli;
use crate::output;
use anyhow::Result;
use scene_io::{Cache, DataDirs, Places};
use serde::Serialize;
use std::fmt;
use std::path::PathBuf;

/// What every verb needs to know of the command line.
pub(crate) struct Context {
    /// Where files are looked for and slow results kept.
    pub(crate) places: Places,
    /// One JSON object instead of text.
    pub(crate) json: bool,
}

impl Context {
    pub(crate) fn new(cli: &Cli) -> Self {
        let environment = std::env::var_os("GONIO_DATA").filter(|v| !v.is_empty());
        let folders = cli.data.iter().cloned().chain(environment.map(Into::into));
        let cache = cache_folder().map(Cache::at).unwrap_or_default();
        Self {
            places: Places {
                data: DataDirs::new(folders),
                cache,
            },
            json: cli.json,
        }
    }

    /// Prints `value` as one line of JSON, or what `text` writes.
    pub(crate) fn report(
        &self,
        value: &impl Serialize,
        text: impl FnOnce(&mut String) -> fmt::Result,
    ) -> Result<()> {
        let mut out = String::new();
        if self.json {
            out = serde_json::to_string(value)?;
            out.push('\n');
        } else {
            text(&mut out)?;
        }
        output::print(&out)
    }
}

/// `GONIO_CACHE`, or `gonio` in the user's own cache folder; none where neither is known.
fn cache_folder() -> Option<PathBuf> {
    let set = |name| {
        std::env::var_os(name)
            .filter(|v| !v.is_empty())
            .map(PathBuf::from)
    };
    set("GONIO_CACHE")
        .or_else(|| set("XDG_CACHE_HOME").map(|d| d.join("gonio")))
        .or_else(|| set("HOME").map(|d| d.join(".cache/gonio")))
}
