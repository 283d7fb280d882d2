//! What the numbers of a measured file mean, where a user knows better than the file: in scenes and on the command line
//! in the same notation.

use super::checked::Colour;
use serde::Deserialize;
use spectrum::{D65_XY, Illuminant, Observer, RgbSpace, Viewing};
use std::str::FromStr;

/// What is said about a file; what is not, is as the file states or its format has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(rename = "FileColour", deny_unknown_fields, default)]
pub struct ColourChoice {
    /// Chromaticities of red, green and blue.
    pub primaries: Option<Primaries>,
    /// Chromaticity of white.
    pub white: Option<White>,
    /// Factor from the numbers of the file to f_r in 1/sr.
    pub scale: Option<FileScale>,
}

/// CIE 1931 xy of red, green and blue: `Rec.2020`, or six numbers with commas between.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct Primaries {
    /// The space whose primaries they are by name, as a place in the list of these.
    named: Option<usize>,
    /// xy of each.
    pub xy: [[f64; 2]; 3],
    /// The white that belongs to the name.
    pub white: Option<[f64; 2]>,
}

impl Primaries {
    /// The name they were given by.
    #[must_use]
    pub fn name(&self) -> Option<&'static str> {
        self.named.map(|k| SPACES[k].0)
    }
}

/// CIE 1931 xy of white: an illuminant's name, or two numbers with a comma between.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "String")]
pub struct White(pub [f64; 2]);

/// Positive factors of the channels: one number for all, or three with commas between.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Colour")]
pub struct FileScale(pub [f64; 3]);

type Space = fn() -> RgbSpace;

/// Spaces that primaries may be named after.
const SPACES: [(&str, Space); 4] = [
    ("sRGB", RgbSpace::srgb),
    ("Rec.2020", RgbSpace::rec2020),
    ("ACEScg", RgbSpace::acescg),
    ("Trinitron", RgbSpace::trinitron),
];
/// Largest chromaticity coordinate: those of real and of the usual imaginary primaries are within 1.2.
const MAX_XY: f64 = 2.0;
/// Largest factor.
const MAX_SCALE: f64 = 1e6;

impl FromStr for Primaries {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let named = (SPACES.iter()).position(|(n, _)| n.eq_ignore_ascii_case(text));
        if let Some(k) = named {
            let space = SPACES[k].1();
            return Ok(Self {
                named,
                xy: space.primaries,
                white: Some(space.white),
            });
        }
        let expected = || {
            format!(
                "expected sRGB, Rec.2020, ACEScg, Trinitron or xr,yr,xg,yg,xb,yb (chromaticities of magnitude at most {MAX_XY}, y not 0), found {text:?}"
            )
        };
        let [a, b, c, d, e, f] = numbers(text).ok_or_else(expected)?;
        let xy = [[a, b], [c, d], [e, f]];
        if !xy.iter().all(|p| is_chromaticity(*p)) {
            return Err(expected());
        }
        let (named, white) = (None, None);
        Ok(Self { named, xy, white })
    }
}

impl FromStr for White {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.parse::<Illuminant>() {
            Ok(Illuminant::D65) => return Ok(Self(D65_XY)),
            Ok(light) => {
                let [x, y, z] = Viewing::new(&light.spectrum(), &Observer::CIE_1931).white();
                return Ok(Self([x / (x + y + z), y / (x + y + z)]));
            }
            Err(_) => {}
        }
        match numbers(text) {
            Some(xy) if is_chromaticity(xy) => Ok(Self(xy)),
            _ => Err(format!(
                "expected A, C, D50, D65, E, F2, F11, blackbody:KELVIN or x,y (of magnitude at most {MAX_XY}, y not 0), found {text:?}"
            )),
        }
    }
}

impl FromStr for FileScale {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let one = numbers::<1>(text).map(|[k]| [k; 3]);
        let found = one.or_else(|| numbers(text)).ok_or_else(|| {
            format!("expected a factor, or three with commas between, found {text:?}")
        })?;
        Self::try_from(Colour(found))
    }
}

impl TryFrom<String> for Primaries {
    type Error = String;
    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl TryFrom<String> for White {
    type Error = String;
    fn try_from(text: String) -> Result<Self, String> {
        text.parse()
    }
}

impl TryFrom<Colour> for FileScale {
    type Error = String;
    fn try_from(Colour(factors): Colour) -> Result<Self, String> {
        match factors.into_iter().find(|k| !(*k > 0.0 && *k <= MAX_SCALE)) {
            Some(k) => Err(format!(
                "expected factors above 0 and at most 1e6, found {k}"
            )),
            None => Ok(Self(factors)),
        }
    }
}

/// `N` numbers with commas between.
fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let fields = text.split(',').map(|t| t.trim().parse().ok());
    let all: Option<Vec<f64>> = fields.collect();
    all?.try_into().ok()
}

fn is_chromaticity([x, y]: [f64; 2]) -> bool {
    x.abs() <= MAX_XY && y.abs() <= MAX_XY && y != 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_numbers_say_the_same() {
        let named: Primaries = "rec.2020".parse().unwrap();
        let plain: Primaries = "0.708,0.292, 0.170,0.797, 0.131,0.046".parse().unwrap();
        assert_eq!(named.xy, plain.xy);
        assert_eq!((named.name(), plain.name()), (Some("Rec.2020"), None));
        assert_eq!((named.white, plain.white), (Some(D65_XY), None));
        assert_eq!("D65".parse::<White>(), Ok(White(D65_XY)));
        // [Cie15] illuminant A; five digits, by sums of 5 nm
        let [x, y] = "A".parse::<White>().unwrap().0;
        assert!(
            (x - 0.44758).abs() < 3e-5 && (y - 0.40745).abs() < 3e-5,
            "{x}, {y}"
        );
        assert_eq!("2".parse::<FileScale>(), "2,2,2".parse());
    }

    #[test]
    fn what_is_no_colour_is_refused_in_words() {
        for text in [
            "",
            "PAL",
            "1,2,3",
            "0.64,0.33,0.3,0.6,0.15,0",
            "0.64,0.33,0.3,0.6,0.15,nan",
        ] {
            let error = text.parse::<Primaries>().unwrap_err();
            assert!(
                error.starts_with("expected sRGB") && error.contains("found"),
                "{error}"
            );
        }
        for text in ["", "D66", "0.3", "0.3,0", "0.3,9"] {
            let error = text.parse::<White>().unwrap_err();
            assert!(
                error.starts_with("expected A, C") && error.contains("found"),
                "{error}"
            );
        }
        for text in ["", "x", "0", "-1", "1,2", "1,2,0", "inf", "nan", "1e9"] {
            let error = text.parse::<FileScale>().unwrap_err();
            assert!(
                error.starts_with("expected") && error.contains("found"),
                "{error}"
            );
        }
    }
}
