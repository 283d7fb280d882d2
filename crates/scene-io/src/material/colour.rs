//! From what a file's numbers are taken for to channels: conventions of the formats, and what a user says instead.

use crate::error::Error;
use crate::scene::ColourChoice;
use brdf::{Measured, Status, Symmetry};
use brdf_formats::{Format, MERL_SCALE};
use brdf_table::HalfDiffTable;
use glam::DVec3;
use spectrum::{Basis, RgbSpace};
use std::sync::Arc;

/// Who says what a number means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// The file itself.
    File,
    /// The format, or the laboratory whose files these are: the file states no numbers.
    Convention,
    /// The user.
    User,
}

impl Source {
    /// `file`, `convention` or `user`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::File => "file",
            Self::Convention => "convention",
            Self::User => "user",
        }
    }
}

/// What the numbers of a file are taken for.
#[derive(Clone, Debug, PartialEq)]
pub struct ColourMeaning {
    /// Who says what the channels are: for RGB the primaries, else the wavelengths or XYZ.
    pub channels_from: Source,
    /// Who says which white an RGB file has.
    pub white_from: Source,
    /// Factor from the numbers of the file to f_r in 1/sr, per channel.
    pub scale: Vec<f64>,
    /// Who says so.
    pub scale_from: Source,
}

/// The meaning of a file's channels, and the factors that bring values that were decoded by convention to it.
#[derive(Clone, Debug)]
pub(super) struct Recolouring {
    pub(super) basis: Basis,
    pub(super) factors: Vec<f64>,
    pub(super) meaning: ColourMeaning,
    changes: bool,
}

impl Recolouring {
    /// `basis` is what the format's convention makes of the channels.
    pub(super) fn new(
        choice: &ColourChoice,
        format: &Format,
        basis: &Basis,
    ) -> Result<Self, Error> {
        let n = basis.len();
        // decoding has multiplied by this; what else is between values and f_r is the white level
        let decoded = match format.name {
            "merl" => MERL_SCALE.to_vec(),
            _ => vec![1.0; n],
        };
        let level = match basis {
            Basis::Rgb(space) => space.white_level,
            _ => 1.0,
        };
        let said = scale(choice, basis)?;
        let scale = said.clone();
        let scale = scale.unwrap_or_else(|| decoded.iter().map(|k| k / level).collect());
        let factors = match &said {
            None => vec![1.0; n],
            Some(scale) => scale.iter().zip(&decoded).map(|(s, k)| s / k).collect(),
        };
        let from = |user: bool, otherwise: Source| if user { Source::User } else { otherwise };
        let rgb = matches!(basis, Basis::Rgb(_));
        let stated = if rgb {
            Source::Convention
        } else {
            Source::File
        };
        let named = choice.primaries.and_then(|p| p.white);
        Ok(Self {
            basis: recoloured(choice, basis, said.is_some())?,
            factors,
            meaning: ColourMeaning {
                channels_from: from(choice.primaries.is_some(), stated),
                white_from: from(
                    choice.white.is_some() || named.is_some(),
                    Source::Convention,
                ),
                scale,
                scale_from: from(said.is_some(), Source::Convention),
            },
            changes: *choice != ColourChoice::default(),
        })
    }

    /// Whether anything is to be done.
    pub(super) fn changes(&self) -> bool {
        self.changes
    }

    /// What tells this apart from other choices.
    pub(super) fn key(&self) -> u64 {
        let text = format!("{:?} {:?}", self.basis, self.factors);
        crate::sealed::content_hash(text.as_bytes())
    }

    /// A table decoded by convention, as the user sees it.
    pub(super) fn table(&self, table: HalfDiffTable) -> Result<HalfDiffTable, Error> {
        if !self.changes {
            return Ok(table);
        }
        let n = self.factors.len();
        let row = |c: usize| (0..n).map(move |k| if c == k { self.factors[c] } else { 0.0 });
        let matrix: Vec<Vec<f64>> = (0..n).map(|c| row(c).collect()).collect();
        let mapped = table.map_channels(&matrix, self.basis.clone());
        mapped.map_err(|e| Error::invalid(e.to_string()))
    }

    /// Anything decoded by convention, likewise.
    pub(super) fn measured(self, measured: Arc<dyn Measured>) -> Arc<dyn Measured> {
        Arc::new(Recoloured {
            measured,
            basis: self.basis,
            factors: self.factors,
        })
    }
}

/// Factors to f_r, if the user says any.
fn scale(choice: &ColourChoice, basis: &Basis) -> Result<Option<Vec<f64>>, Error> {
    let Some([r, g, b]) = choice.scale.map(|s| s.0) else {
        return Ok(None);
    };
    if basis.len() == 3 {
        return Ok(Some(vec![r, g, b]));
    }
    if r.to_bits() != g.to_bits() || g.to_bits() != b.to_bits() {
        let message = format!("expected one factor for {} bands, found three", basis.len());
        return Err(Error::invalid(message).in_field("scale"));
    }
    Ok(Some(vec![r; basis.len()]))
}

/// What the channels then mean. A scale makes values f_r: white is at 1.
fn recoloured(choice: &ColourChoice, basis: &Basis, scaled: bool) -> Result<Basis, Error> {
    let Basis::Rgb(space) = basis else {
        let field = match (choice.primaries, choice.white) {
            (Some(_), _) => "primaries",
            (_, Some(_)) => "white",
            _ => return Ok(basis.clone()),
        };
        let found = match basis {
            Basis::Xyz => "XYZ".to_owned(),
            other => format!("{} bands", other.len()),
        };
        let message = format!("expected an RGB file for other {field}, found {found}");
        return Err(Error::invalid(message).in_field(field));
    };
    let mut space = space.clone();
    if let Some(primaries) = choice.primaries {
        space.name = primaries.name().unwrap_or("given").into();
        space.primaries = primaries.xy;
        space.white = primaries.white.unwrap_or(space.white);
    }
    if let Some(white) = choice.white {
        space.white = white.0;
    }
    if scaled {
        space.white_level = 1.0;
    }
    if space.convert_to(&RgbSpace::srgb()).is_none() {
        let [r, g, b] = space.primaries;
        let message = format!(
            "expected primaries of which white can be mixed, found {r:?}, {g:?}, {b:?} and white {:?}",
            space.white
        );
        let field = if choice.primaries.is_some() {
            "primaries"
        } else {
            "white"
        };
        return Err(Error::invalid(message).in_field(field));
    }
    Ok(Basis::Rgb(space))
}

/// A measurement whose values are read differently.
struct Recoloured {
    measured: Arc<dyn Measured>,
    basis: Basis,
    factors: Vec<f64>,
}

impl Measured for Recoloured {
    fn basis(&self) -> &Basis {
        &self.basis
    }

    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        let status = self.measured.eval_native(wi, wo, out);
        out.iter_mut().zip(&self.factors).for_each(|(o, f)| *o *= f);
        status
    }

    fn symmetry(&self) -> Symmetry {
        self.measured.symmetry()
    }
}
