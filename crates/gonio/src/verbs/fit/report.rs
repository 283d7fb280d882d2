//! What a fit says to people and programs.

use brdf_fit::{Estimate, Fit};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};
use std::fmt::{self, Write};
use std::path::PathBuf;

/// One material.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Report {
    pub(super) file: String,
    pub(super) metric: String,
    pub(super) lobes: u8,
    pub(super) cutoff_deg: f64,
    /// Pairs of directions the fit saw.
    pub(super) samples: usize,
    /// Of the content of the file and everything that was asked: a fit with the same key need not be made again.
    pub(super) key: String,
    /// Best first.
    pub(super) models: Vec<Model>,
    #[serde(default)]
    pub(super) written: Vec<PathBuf>,
    /// What the exports evaluate, and how far that is from the data.
    #[serde(default)]
    pub(super) exports: Vec<Exported>,
}

/// One model.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Model {
    pub(super) name: String,
    pub(super) error: f64,
    /// Value by name; one a channel for weights.
    pub(super) parameters: Map<String, Value>,
    /// 95 % interval by name, `null` where there is none.
    pub(super) ci: Map<String, Value>,
    pub(super) seconds: f64,
    /// The model as text, one entry a part of a sum.
    pub(super) parts: Vec<Part>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Part {
    pub(super) model: String,
    pub(super) scale: Vec<f64>,
}

#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Exported {
    pub(super) target: String,
    pub(super) model: String,
    pub(super) error: f64,
}

impl Model {
    pub(super) fn of(fit: &Fit) -> Self {
        let (mut parameters, mut ci) = (Map::new(), Map::new());
        for estimate in &fit.estimates {
            add(&mut parameters, estimate, json!(estimate.value));
            let (low, high) = estimate.ci;
            let interval = if low.is_finite() && high.is_finite() {
                json!([low, high])
            } else {
                Value::Null
            };
            add(&mut ci, estimate, interval);
        }
        let parts = fit.parts.iter().map(|p| Part {
            model: p.text.clone(),
            scale: p.scale.clone(),
        });
        Self {
            name: fit.name.clone(),
            error: fit.error,
            parameters,
            ci,
            seconds: fit.seconds,
            parts: parts.collect(),
        }
    }
}

/// A shape under its name, weights as a list.
fn add(map: &mut Map<String, Value>, estimate: &Estimate, value: Value) {
    if estimate.channel.is_none() {
        map.insert(estimate.name.clone(), value);
    } else if let Value::Array(list) = map.entry(&estimate.name).or_insert_with(|| json!([])) {
        list.push(value);
    }
}

impl Report {
    pub(super) fn print(&self, out: &mut String) -> fmt::Result {
        writeln!(
            out,
            "{}: {} over {} pairs of directions within {} degrees",
            self.file, self.metric, self.samples, self.cutoff_deg
        )?;
        for model in &self.models {
            let parameters: Vec<String> = (model.parameters.iter())
                .map(|(name, value)| format!("{name}={}", short(value, model.ci.get(name))))
                .collect();
            writeln!(
                out,
                "{:<20} {:.5e}  {:5.2} s  {}",
                model.name,
                model.error,
                model.seconds,
                parameters.join(" ")
            )?;
        }
        for export in &self.exports {
            writeln!(
                out,
                "for {:<8} {} at {:.5e}",
                export.target, export.model, export.error
            )?;
        }
        for path in &self.written {
            writeln!(out, "wrote {}", path.display())?;
        }
        Ok(())
    }
}

/// `0.123+-0.004`, channels joined by `/`.
fn short(value: &Value, ci: Option<&Value>) -> String {
    match value {
        Value::Array(values) => {
            let at = |k: usize| ci.and_then(|c| c.get(k));
            let texts: Vec<String> = values
                .iter()
                .enumerate()
                .map(|(k, v)| short(v, at(k)))
                .collect();
            texts.join("/")
        }
        value => {
            let end = |k: usize| ci.and_then(|c| c.get(k)).and_then(Value::as_f64);
            let value = value.as_f64().unwrap_or(f64::NAN);
            match (end(0), end(1)) {
                (Some(low), Some(high)) => format!("{value:.4}+-{:.1e}", 0.5 * (high - low)),
                _ => format!("{value:.4}"),
            }
        }
    }
}
