//! The names users write, in scenes and on the command line alike.

use serde::Deserialize;
use spectrum::GamutMapping;
use std::fmt;
use std::str::FromStr;

macro_rules! names {
    ($(#[$doc:meta])* $name:ident, $what:literal { $($(#[$vdoc:meta])* $variant:ident = $text:literal),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize)]
        #[serde(try_from = "String")]
        pub enum $name { $($(#[$vdoc])* $variant),+ }

        impl $name {
            /// Every value, in the order of the documentation.
            pub const ALL: &'static [Self] = &[$(Self::$variant),+];

            /// The name users write.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$variant => $text),+ }
            }
        }

        impl FromStr for $name {
            type Err = String;
            fn from_str(text: &str) -> Result<Self, String> {
                match text {
                    $($text => Ok(Self::$variant),)+
                    _ => Err(format!(
                        concat!("expected ", $what, " ({}), found \"{}\""),
                        [$($text),+].join(", "),
                        text.chars().take(40).collect::<String>(),
                    )),
                }
            }
        }

        impl TryFrom<String> for $name {
            type Error = String;
            fn try_from(text: String) -> Result<Self, String> {
                text.parse()
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(self.name())
            }
        }
    };
}

names!(
    /// How directions toward the light are chosen.
    SamplerName, "a sampler" {
        /// Whatever is best for the material: `hvt` for tables and mixtures, the model's own where it has one.
        Auto = "auto",
        /// Half-vector table: nearly noiseless, a few kilobytes.
        Hvt = "hvt",
        /// The same in 1 KB.
        HvtTiny = "hvt-tiny",
        /// The same in 43 KB.
        HvtFine = "hvt-fine",
        /// The same in 111 KB.
        HvtReference = "hvt-reference",
        /// Ten GGX lobes and a cosine.
        Dictionary = "dictionary",
        /// The best single GGX lobe and a cosine.
        GgxSingle = "ggx-single",
        /// Exact inversion per slice of the known direction.
        Inversion = "inversion",
        /// The thesis' rejection per slice.
        Rejection = "rejection",
        /// Cosine-weighted hemisphere.
        Cosine = "cosine",
        /// Uniform hemisphere.
        Uniform = "uniform",
        /// The sampling that comes with the file (RGL) or the model.
        Native = "native",
    }
);

names!(
    /// How values between measured directions come about.
    InterpolationName, "an interpolation" {
        /// `linear` for grids, `thin-plate` for scattered measurements.
        Auto = "auto",
        /// The nearest cell (grids) or, layer by layer, measurement (scattered).
        Nearest = "nearest",
        /// Linear in every coordinate.
        Linear = "linear",
        /// The thesis' squared weights (scattered measurements only).
        SquaredLambda = "squared-lambda",
        /// Linear between layers in the log of the luminance (scattered measurements only).
        LayeredLog = "layered-log",
        /// The nearest of all measurements (scattered measurements only).
        KdNearest = "kd-nearest",
        /// Local thin-plate splines of log f in half-angle coordinates (scattered measurements only).
        ThinPlate = "thin-plate",
    }
);

names!(
    /// What a negative value of a file means.
    NegativeName, "a policy for negative values" {
        /// `keep` for scattered measurements (out-of-gamut colour), `clamp` for MERL's error marks.
        Auto = "auto",
        /// Stays negative: colour out of gamut.
        Keep = "keep",
        /// Becomes 0.
        Clamp = "clamp",
    }
);

names!(
    /// What answers in the hole around the incident direction of scattered measurements.
    GapName, "a policy for gaps" {
        /// The interpolant's own smooth continuation.
        Extend = "extend",
        /// The nearest row.
        Nearest = "nearest",
    }
);

names!(
    /// What answers beyond the most grazing rows of scattered measurements.
    BeyondName, "a policy beyond the rows" {
        /// The slope at the edge, bounded by Fresnel reflection.
        Schlick = "schlick",
        /// The nearest row.
        Nearest = "nearest",
    }
);

names!(
    /// How PNGs show colours with negative components; EXR files keep them.
    GamutName, "a gamut mapping" {
        /// Negative components become 0.
        Clip = "clip",
        /// Mixed with grey of the same luminance until none is negative.
        Desaturate = "desaturate",
    }
);

impl GamutName {
    /// What it stands for.
    #[must_use]
    pub fn mapping(self) -> GamutMapping {
        match self {
            Self::Clip => GamutMapping::Clip,
            Self::Desaturate => GamutMapping::Desaturate,
        }
    }
}

names!(
    /// What the channels of a render are.
    SpectrumName, "a spectrum" {
        /// Linear sRGB.
        Rgb = "rgb",
        /// CIE XYZ relative to white.
        Xyz = "xyz",
        /// Eight bins.
        Eight = "8",
        /// Sixteen bins.
        Sixteen = "16",
        /// Forty-five bins.
        FortyFive = "45",
        /// The bands of the main material's file, 31 or 65.
        Native = "native",
        /// Eight wavelengths a path, others on each.
        Hero = "hero",
    }
);

names!(
    /// The points that drive the random decisions.
    PointsName, "a point set" {
        /// Owen-scrambled Sobol' points.
        Sobol = "sobol",
        /// Scrambled Halton points.
        Halton = "halton",
        /// Independent random numbers.
        Independent = "independent",
    }
);
