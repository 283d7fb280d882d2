//! Error against run time, row by row as a render goes on.

use crate::error::Error;
use crate::write;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use tracer::Estimate;

/// Confidence of the intervals in rows.
pub const CONFIDENCE: f64 = 0.95;

/// What a render knew of its error at one moment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Wall-clock seconds of rendering.
    pub seconds: f64,
    /// Processor seconds of rendering, all threads.
    pub cpu_seconds: f64,
    /// Samples a pixel.
    pub spp: u32,
    /// Relative RMSE of the picture.
    pub rel_rmse: f64,
    /// Its 95 % interval.
    pub ci: [f64; 2],
}

/// Keeps rows and, where asked, a CSV file of them that is whole after every row.
#[derive(Clone, Debug, Default)]
pub struct Recorder {
    rows: Vec<Row>,
    path: Option<PathBuf>,
}

/// First line of the CSV file.
const HEADER: &str = "seconds,cpu_seconds,spp,rel_rmse,rel_rmse_low,rel_rmse_high\n";

impl Recorder {
    /// A recorder without a file.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A recorder that writes `path`: its header now, so that a path that can't be written is known before rendering.
    ///
    /// # Errors
    /// If the file can't be written.
    pub fn to_file(path: &Path) -> Result<Self, Error> {
        let recorder = Self {
            rows: Vec::new(),
            path: Some(path.to_owned()),
        };
        recorder.write()?;
        Ok(recorder)
    }

    /// Adds a row of `estimate` made with [`CONFIDENCE`], and writes the file anew.
    ///
    /// # Errors
    /// If the file can't be written; the row is kept.
    pub fn push(
        &mut self,
        [seconds, cpu_seconds]: [f64; 2],
        spp: u32,
        estimate: &Estimate,
    ) -> Result<(), Error> {
        self.rows.push(Row {
            seconds,
            cpu_seconds,
            spp,
            rel_rmse: estimate.rel_rmse,
            ci: estimate.rel_rmse_ci,
        });
        self.write()
    }

    /// The rows so far.
    #[must_use]
    pub fn rows(&self) -> &[Row] {
        &self.rows
    }

    fn write(&self) -> Result<(), Error> {
        let Some(path) = &self.path else {
            return Ok(());
        };
        let mut text = String::from(HEADER);
        for r in &self.rows {
            let [low, high] = r.ci;
            let line = writeln!(
                text,
                "{:.6},{:.6},{},{:e},{:e},{:e}",
                r.seconds, r.cpu_seconds, r.spp, r.rel_rmse, low, high
            );
            // writing to a string can't fail
            debug_assert!(line.is_ok(), "a string takes all");
        }
        write::bytes(path, text.as_bytes())
    }
}
