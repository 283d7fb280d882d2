//! What the value columns of a file are.

use crate::error::{Error, Place, quote};

/// The meaning of a file's channels, as far as the file itself says it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Channels {
    /// Three additive primaries R, G, B. Which ones depends on the format: see its docs page.
    Rgb,
    /// CIE XYZ.
    Xyz,
    /// Values at these wavelengths in nm: positive, finite, strictly ascending, at least one.
    Wavelengths(Vec<f64>),
}

impl Channels {
    /// How many channels there are.
    #[must_use]
    #[expect(clippy::len_without_is_empty, reason = "no file has zero channels")]
    pub fn len(&self) -> usize {
        match self {
            Self::Rgb | Self::Xyz => 3,
            Self::Wavelengths(nm) => nm.len(),
        }
    }

    /// The column names of ASTM files: `R`, `X`, `550nm`.
    ///
    /// ```
    /// # use brdf_formats::Channels;
    /// assert_eq!(Channels::Wavelengths(vec![400.0, 412.5]).names(), ["400nm", "412.5nm"]);
    /// ```
    #[must_use]
    pub fn names(&self) -> Vec<String> {
        match self {
            Self::Rgb => ["R", "G", "B"].map(String::from).to_vec(),
            Self::Xyz => ["X", "Y", "Z"].map(String::from).to_vec(),
            Self::Wavelengths(nm) => nm.iter().map(|l| format!("{l}nm")).collect(),
        }
    }

    /// The inverse of [`Channels::names`].
    pub(crate) fn from_names(names: &[String], place: Place) -> Result<Self, Error> {
        const EXPECTED: &str = "R,G,B or X,Y,Z or <wavelength>nm value columns";
        match names {
            [r, g, b] if [r, g, b] == ["R", "G", "B"] => return Ok(Self::Rgb),
            [x, y, z] if [x, y, z] == ["X", "Y", "Z"] => return Ok(Self::Xyz),
            [] => return Err(Error::invalid(place, "VARS", EXPECTED, "none")),
            _ => {}
        }
        let mut nm = Vec::with_capacity(names.len());
        for name in names {
            let number = name.strip_suffix("nm").map(|n| n.trim_end().parse::<f64>());
            match number {
                Some(Ok(lambda)) => nm.push(lambda),
                _ => {
                    let found = quote(name.as_bytes());
                    return Err(Error::unsupported(place, "VARS", EXPECTED, found));
                }
            }
        }
        check_wavelengths(&nm, place, "VARS")?;
        Ok(Self::Wavelengths(nm))
    }
}

/// `nm` must be non-empty, positive, finite and strictly ascending.
pub(crate) fn check_wavelengths(nm: &[f64], place: Place, field: &str) -> Result<(), Error> {
    let mut below = 0.0;
    for &lambda in nm {
        if !(lambda > below && lambda.is_finite()) {
            let found = format!("{lambda} after {below}");
            return Err(Error::invalid(
                place,
                field,
                "ascending wavelengths in nm",
                found,
            ));
        }
        below = lambda;
    }
    if nm.is_empty() {
        return Err(Error::invalid(
            place,
            field,
            "at least one wavelength",
            "none",
        ));
    }
    Ok(())
}
