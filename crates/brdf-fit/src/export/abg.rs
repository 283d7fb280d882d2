//! The ABg numbers of optical design programs, a line a channel.

use crate::{Fit, FitError};
use brdf_models::Abg;
use glam::DVec3;
use std::fmt::Write as _;

/// Names of the channels and the dominant wavelengths of the primaries of linear sRGB over D65, um [Bt709], [Cie15].
const CHANNELS: [(&str, f64); 3] = [("red", 0.6114), ("green", 0.5491), ("blue", 0.4642)];

const HEAD: &str = "\
# ABg scatter of a fitted surface, a line a channel
# BSDF = A / (B + |beta - beta0|^g) + lambert/pi, in 1/sr, without the cosine
# beta, beta0: direction cosines along the surface of the scattered ray and of the mirrored one
# TIS: share of light at normal incidence that the ABg part scatters; what is mirrored is no part of it
# channels are linear sRGB; the wavelengths are the dominant ones of its primaries
# channel wavelength_um A B g lambert TIS
";

/// The table of a fit of the family `abg` with one lobe and three channels.
pub(super) fn text(fit: &Fit) -> Result<String, FitError> {
    let ([b, g], 3) = (&fit.shape[..], fit.weights.len()) else {
        return Err(FitError::Channels(fit.weights.len()));
    };
    let model = Abg {
        a: std::array::from_fn(|c| fit.weights[c][1]),
        b: *b,
        g: *g,
        diffuse: [0.0; 3],
    };
    let tis = model.tis(DVec3::Z);
    let mut out = HEAD.to_owned();
    for (c, (name, um)) in CHANNELS.iter().enumerate() {
        let (a, lambert) = (model.a[c], fit.weights[c][0]);
        let _ = writeln!(
            out,
            "{name} {um} {a:.9e} {b:.9e} {g:.9} {lambert:.9e} {:.4e}",
            tis[c]
        );
    }
    Ok(out)
}
