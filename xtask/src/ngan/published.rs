//! Ngan's parameters with Ngan's definitions.
//!
//! The files give colours without the factors 1.15 and 1.66 that MERL's green and blue are scaled by; rows marked as
//! corrupt in their source are skipped. The definitions were found by comparing the weights that fit the stand-ins best
//! at the published shapes with the published weights: for five of the models their ratio is the same factor
//! for each material only with the definitions below (Fresnel: exact for Cook-Torrance, Schlick's for
//! Ashikhmin-Shirley; the Lafortune lobe divided by its larger coefficient).

use anyhow::{Context, Result};
use brdf::Brdf;
use brdf_models::parse_model;
use glam::DVec3;
use std::path::Path;
use std::sync::Arc;

/// MERL's scale of red, green and blue, relative to red [Matusik2003].
const CHANNEL_SCALE: [f64; 3] = [1.0, 1.15, 1.66];

/// The number in a named column of a row.
type Columns<'a> = &'a dyn Fn(&str) -> Result<f64>;

/// A published model.
pub(super) struct Published {
    /// The file `ngan2005_NAME.csv`.
    file: &'static str,
    /// The family of ours that contains it.
    pub(super) family: &'static str,
    /// From the row's shape columns to a lobe of unit weight: its text and a factor.
    lobe: fn(Columns<'_>) -> Result<(String, f64)>,
}

pub(super) const FAMILIES: &[Published] = &[
    Published {
        file: "BlinnPhong",
        family: "blinn-phong",
        lobe: |at| {
            // (n+2)/(2 pi) in place of (n+2)(n+4)/(8 pi (2^(-n/2) + n))
            let n = at("n")?;
            let factor = 4.0 * ((-0.5 * n).exp2() + n) / (n + 4.0);
            Ok((format!("blinn-phong:n={n},ks=1,kd=0"), factor))
        },
    },
    Published {
        file: "Ward",
        family: "ward",
        lobe: |at| Ok((format!("ward:alpha={},ks=1,kd=0", at("alpha")?), 1.0)),
    },
    Published {
        file: "WardDuer",
        family: "ward-duer",
        lobe: |at| Ok((format!("ward-duer:alpha={},ks=1,kd=0", at("alpha")?), 1.0)),
    },
    Published {
        file: "Lafortune",
        family: "lafortune",
        lobe: |at| {
            let (cxy, cz) = (at("Cxy")?, at("Cz")?);
            let largest = cxy.abs().max(cz.abs());
            let (cx, cz, n) = (cxy / largest, cz / largest, at("n")?);
            Ok((format!("lafortune:ks=1,n={n},cx={cx},cz={cz},kd=0"), 1.0))
        },
    },
    Published {
        file: "CookTorrance",
        family: "cook-torrance",
        lobe: |at| {
            Ok((
                format!("cook-torrance:m={},f0={},ks=1,kd=0", at("m")?, at("F0")?),
                1.0,
            ))
        },
    },
    Published {
        file: "AshikhminShirley",
        family: "ashikhmin-lobe",
        lobe: |at| {
            Ok((
                format!("ashikhmin-lobe:n={},f0={},ks=1,kd=0", at("n")?, at("F0")?),
                1.0,
            ))
        },
    },
    Published {
        file: "He",
        family: "he",
        lobe: |at| {
            // tau, sigma and a real index; see the heading
            let (tau, sigma, n) = (at("p6")?, at("p7")?, at("p8")?);
            Ok((
                format!("he:sigma={sigma},tau={tau},n={n},mirror=0,ks=1,kd=0"),
                1.0,
            ))
        },
    },
];

/// One material of one file.
pub(super) struct Row {
    diffuse: [f64; 3],
    specular: [f64; 3],
    lobe: Arc<dyn Brdf<3>>,
}

impl Row {
    /// The row of `material`; `None` if it is missing or corrupt.
    pub(super) fn read(folder: &Path, model: &Published, material: &str) -> Result<Option<Self>> {
        let file = folder.join(format!("ngan2005_{}.csv", model.file));
        let text = std::fs::read_to_string(&file).with_context(|| file.display().to_string())?;
        let mut lines = text.lines();
        let header: Vec<&str> = lines.next().unwrap_or_default().split(',').collect();
        let Some(row) = lines
            .map(|l| l.split(',').collect::<Vec<_>>())
            .find(|r| r.first() == Some(&material))
        else {
            return Ok(None);
        };
        if row.last().is_some_and(|flag| !flag.is_empty()) {
            return Ok(None);
        }
        let at = |name: &str| -> Result<f64> {
            let place = header.iter().position(|h| *h == name);
            let text = place.and_then(|k| row.get(k));
            let text = text.with_context(|| format!("{}: no column {name}", file.display()))?;
            text.parse()
                .with_context(|| format!("{}: {material}, {name}: {text:?}", file.display()))
        };
        let (text, factor) = (model.lobe)(&at)?;
        let colour = |stem: &str, factor: f64| -> Result<[f64; 3]> {
            let mut out = CHANNEL_SCALE.map(|s| s * factor);
            for (value, channel) in out.iter_mut().zip(["r", "g", "b"]) {
                *value *= at(&format!("{stem}_{channel}"))?;
            }
            Ok(out)
        };
        Ok(Some(Self {
            diffuse: colour("kd", std::f64::consts::FRAC_1_PI)?,
            specular: colour("ks", factor)?,
            lobe: parse_model(&text)?.built.brdf,
        }))
    }
}

impl Brdf<3> for Row {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 3] {
        let lobe = self.lobe.eval(wi, wo);
        std::array::from_fn(|c| self.diffuse[c] + self.specular[c] * lobe[c])
    }
}
