//! RGB to reflectance by a linear basis.

use crate::generated::linear_uplift::{FIRST_NM, STEP_NM, TABLE};
use crate::{Outside, Spectrum};

/// Three reflectances, one for each linear sRGB primary, that sum to 1 and have the primaries' colours under D65
/// [MallettYuksel2019].
///
/// The spectrum of a sum is the sum of the spectra: the uplift to use where a linear operator acts on the data
/// (interpolation, mixing, a change of basis), and the only one that takes colours out of gamut and
/// reflectances above 1 as they are. In [0, 1] for colours in the sRGB cube. The basis is the smoothest
/// one, the least sum of squared differences between neighbouring samples, solved by `cargo xtask codegen`.
///
/// For the colours of a scene, use [`crate::Sigmoid`]: smoother, and closer to real surfaces.
#[derive(Clone, Copy, Debug)]
pub struct LinearUplift;

impl LinearUplift {
    /// The reflectance of a linear sRGB colour, any values.
    #[must_use]
    pub fn spectrum(rgb: [f64; 3]) -> Spectrum {
        let values = TABLE
            .iter()
            .map(|[r, g, b]| r * rgb[0] + g * rgb[1] + b * rgb[2])
            .collect();
        Spectrum::regular(FIRST_NM, STEP_NM, values, Outside::Hold)
    }
}
