//! Tables of numbers in `xtask/data/`: lines starting with `#`, a line of names, rows by wavelength.

use crate::repo;
use anyhow::{Context, Result, bail};

/// The columns of a table.
pub(super) struct Table {
    /// Names, the first of which is `nm`.
    pub(super) names: Vec<String>,
    /// Rows of as many fields as names; `None` where the source has no number.
    pub(super) rows: Vec<Vec<Option<f64>>>,
}

impl Table {
    /// Reads `xtask/data/NAME.csv`.
    pub(super) fn read(name: &str) -> Result<Self> {
        Self::parse(&text(name)?).with_context(|| format!("xtask/data/{name}.csv"))
    }

    fn parse(text: &str) -> Result<Self> {
        let mut lines = text.lines().filter(|l| !l.starts_with('#'));
        let names: Vec<String> = lines
            .next()
            .context("no line of names")?
            .split(',')
            .map(str::to_owned)
            .collect();
        let mut rows = Vec::new();
        for line in lines {
            let fields: Result<Vec<_>> = line.split(',').map(field).collect();
            let fields = fields.with_context(|| format!("row {line:?}"))?;
            if fields.len() != names.len() || fields[0].is_none() {
                bail!(
                    "row {line:?}: expected a wavelength and {} fields",
                    names.len() - 1
                );
            }
            rows.push(fields);
        }
        Ok(Self { names, rows })
    }

    /// Wavelengths and values of one column, where it has numbers.
    pub(super) fn column(&self, name: &str) -> Result<Vec<(f64, f64)>> {
        let c = self
            .names
            .iter()
            .position(|n| n == name)
            .with_context(|| format!("no column {name}"))?;
        let points = self.rows.iter().filter_map(|r| Some((r[0]?, r[c]?)));
        Ok(points.collect())
    }
}

/// `xtask/data/NAME.csv` as it is.
pub(super) fn text(name: &str) -> Result<String> {
    repo::read(&repo::root().join("xtask/data").join(format!("{name}.csv")))
}

fn field(text: &str) -> Result<Option<f64>> {
    if text.is_empty() {
        return Ok(None);
    }
    Ok(Some(text.parse().with_context(|| text.to_owned())?))
}
