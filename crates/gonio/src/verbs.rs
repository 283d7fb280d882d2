//! The verbs: each parses nothing, calls a library, prints.

pub(crate) mod compare;
pub(crate) mod convert;
pub(crate) mod eval;
pub(crate) mod info;
pub(crate) mod measure;
pub(crate) mod mix;
pub(crate) mod plot;
pub(crate) mod render;

use crate::args::Cli;
use anyhow::Result;
use scene_io::DataDirs;
use serde::Serialize;

/// What every verb needs to know of the command line.
pub(crate) struct Context {
    /// Where files are looked for.
    pub(crate) dirs: DataDirs,
    /// One JSON object instead of text.
    pub(crate) json: bool,
}

impl Context {
    pub(crate) fn new(cli: &Cli) -> Self {
        let environment = std::env::var_os("GONIO_DATA").filter(|v| !v.is_empty());
        let folders = cli.data.iter().cloned().chain(environment.map(Into::into));
        Self { dirs: DataDirs::new(folders), json: cli.json }
    }

    /// Prints `value` as JSON, or calls `text`.
    pub(crate) fn report(&self, value: &impl Serialize, text: impl FnOnce()) -> Result<()> {
        if self.json {
            println!("{}", serde_json::to_string(value)?);
        } else {
            text();
        }
        Ok(())
    }
}
