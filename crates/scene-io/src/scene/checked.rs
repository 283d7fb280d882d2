//! Numbers that are checked where they are read, so that an error knows its line and column.

use serde::Deserialize;
use serde::de::{Deserializer, Error as _, SeqAccess, Visitor};
use std::convert::identity;
use std::fmt;

/// Largest magnitude of a coordinate or length in a scene: beyond it f32 rendering has no digits left.
pub const MAX_COORDINATE: f64 = 1e7;
/// Largest radiance, intensity or irradiance.
pub const MAX_RADIANCE: f64 = 1e12;

macro_rules! checked {
    ($(#[$doc:meta])* $name:ident($inner:ty, $convert:expr), $expected:literal, $ok:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, PartialOrd, Deserialize)]
        #[serde(try_from = "f64")]
        pub struct $name(pub $inner);

        impl TryFrom<f64> for $name {
            type Error = String;
            fn try_from(value: f64) -> Result<Self, String> {
                let ok: fn(f64) -> bool = $ok;
                if ok(value) {
                    Ok(Self($convert(value)))
                } else {
                    Err(format!(concat!("expected ", $expected, ", found {}"), value))
                }
            }
        }
    };
}

/// A whole number that was found to be in range.
fn whole(value: f64) -> u32 {
    value as u32
}

checked!(
    /// A coordinate: finite, at most [`MAX_COORDINATE`] in magnitude.
    Coordinate(f64, identity), "a finite number of magnitude at most 1e7", |v| v.abs() <= MAX_COORDINATE
);
checked!(
    /// A length or scale: positive, at most [`MAX_COORDINATE`].
    Positive(f64, identity), "a number above 0 and at most 1e7", |v| v > 0.0 && v <= MAX_COORDINATE
);
checked!(
    /// A radiometric quantity: at least 0, at most [`MAX_RADIANCE`].
    Radiometric(f64, identity), "a number from 0 to 1e12", |v| (0.0..=MAX_RADIANCE).contains(&v)
);
checked!(
    /// A weight or channel factor: at least 0, at most 1e6.
    Weight(f64, identity), "a number from 0 to 1e6", |v| (0.0..=1e6).contains(&v)
);
checked!(
    /// A full field of view in degrees, between 0.01 and 175.
    FieldOfView(f64, identity), "a field of view from 0.01 to 175 degrees", |v| (0.01..=175.0).contains(&v)
);
checked!(
    /// An angle in degrees, at most 36000 in magnitude.
    Degrees(f64, identity), "an angle of at most 36000 degrees", |v| v.abs() <= 36000.0
);
checked!(
    /// An image side in pixels.
    Side(u32, whole), "a whole number of pixels from 1 to 32768",
    |v| (1.0..=32768.0).contains(&v) && v.fract() == 0.0
);
checked!(
    /// Samples a pixel.
    SampleCount(u32, whole), "a whole number of samples from 1 to 16777216",
    |v| (1.0..=16_777_216.0).contains(&v) && v.fract() == 0.0
);
checked!(
    /// Scattering vertices of a path.
    Depth(u32, whole), "a whole number of scattering events from 0 to 1000",
    |v| (0.0..=1000.0).contains(&v) && v.fract() == 0.0
);
checked!(
    /// A wavelength in nm.
    Wavelength(f64, identity), "a wavelength from 100 to 10000 nm", |v| (100.0..=10_000.0).contains(&v)
);
checked!(
    /// A temperature in K.
    Kelvin(f64, identity), "a temperature from 500 to 100000 K", |v| (500.0..=100_000.0).contains(&v)
);
checked!(
    /// Segments around a surface of revolution.
    Segments(u32, whole), "a whole number of segments from 3 to 4096",
    |v| (3.0..=4096.0).contains(&v) && v.fract() == 0.0
);

/// A point or a direction.
pub type Point = [Coordinate; 3];

/// The plain numbers of a point.
#[must_use]
pub fn plain(p: Point) -> [f64; 3] {
    p.map(|c| c.0)
}

/// Three channels of linear sRGB, written as `(r, g, b)` or as one number for all three.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Colour(pub [f64; 3]);

impl<'de> Deserialize<'de> for Colour {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ColourVisitor)
    }
}

struct ColourVisitor;

impl<'de> Visitor<'de> for ColourVisitor {
    type Value = Colour;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a colour: one number or (r, g, b), each from 0 to 1e12")
    }

    fn visit_f64<E: serde::de::Error>(self, v: f64) -> Result<Colour, E> {
        let c = Radiometric::try_from(v).map_err(E::custom)?;
        Ok(Colour([c.0; 3]))
    }

    fn visit_i64<E: serde::de::Error>(self, v: i64) -> Result<Colour, E> {
        self.visit_f64(v as f64)
    }

    fn visit_u64<E: serde::de::Error>(self, v: u64) -> Result<Colour, E> {
        self.visit_f64(v as f64)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Colour, A::Error> {
        let mut channels = [0.0; 3];
        for (k, c) in channels.iter_mut().enumerate() {
            let value: Radiometric = seq
                .next_element()?
                .ok_or_else(|| A::Error::invalid_length(k, &self))?;
            *c = value.0;
        }
        if seq.next_element::<Radiometric>()?.is_some() {
            return Err(A::Error::invalid_length(4, &self));
        }
        Ok(Colour(channels))
    }
}
