//! Cornell's gonioreflectometer: eight angles of incidence, rings of scattered directions in a half plane.

use brdf::{Brdf, direction};
use brdf_formats::AstmFile;
use sampling::Rng;
use spectrum::Basis;
use std::f64::consts::{FRAC_PI_4, PI, SQRT_2};

use crate::columns::Columns;
use crate::{Instrument, MeasureError};

/// Rings of the scattered directions: sin(theta_s / 2) sqrt 2 = k / 10 for k = 0 ... 9.
const RINGS: u32 = 10;

/// Decimals of the published files; angles are rounded to them before anything is measured.
const DECIMALS: f64 = 1e6;

/// theta_i, phi_i, theta_s, phi_s in radians of Cornell's rows, as their files print them: theta_i = 10 ... 80
/// degrees, phi_s = 0, -45/k, ... degrees on ring k, and pi where -pi would be; nothing within
/// `blind_spot_deg` of the light.
///
/// With 17 degrees these are the 1439 rows of a published file and one more (theta_i = 80, theta_s = 79.05,
/// phi_s = -175), which is missing there.
#[must_use]
pub fn cornell_directions(blind_spot_deg: f64) -> Vec<[f64; 4]> {
    let mut rows = Vec::new();
    for ten in 1..=8_u32 {
        let theta_i = f64::from(10 * ten).to_radians();
        for k in 0..RINGS {
            let theta_s = 2.0 * (f64::from(k) / (10.0 * SQRT_2)).asin();
            for j in 0..=4 * k {
                let phi_s = match j {
                    0 => 0.0,
                    j if j == 4 * k => PI,
                    j => -f64::from(j) * FRAC_PI_4 / f64::from(k),
                };
                // 2 asin of half the distance: exact near zero
                let chord = direction(theta_i, 0.0).distance(direction(theta_s, phi_s));
                if 2.0 * (0.5 * chord).asin() >= blind_spot_deg.to_radians() {
                    rows.push([theta_i, 0.0, theta_s, phi_s].map(rounded));
                }
            }
        }
    }
    rows
}

fn rounded(x: f64) -> f64 {
    (x * DECIMALS).round() / DECIMALS
}

/// Measures `brdf` in Cornell's directions and writes it as their files are: six decimals, radians.
///
/// `basis` says what the columns are. RGB (any primaries; Cornell's own are a Trinitron set with white at
/// 0.358) and XYZ are made from a reflectance in linear sRGB; bands need a reflectance with those very bands
/// as its channels. Light comes from theta_i, the viewer is at theta_s.
///
/// The header is Cornell's in form and says that nothing real was measured; `sample` names the model.
///
/// # Errors
/// If the channel counts differ, the columns can't be written, or the instrument is impossible.
pub fn measure_astm<const N: usize>(
    brdf: &dyn Brdf<N>,
    basis: &Basis,
    sample: &str,
    instrument: &Instrument,
    seed: u64,
) -> Result<AstmFile, MeasureError> {
    instrument.check()?;
    let columns = Columns::new(basis, N)?;
    let directions = cornell_directions(instrument.blind_spot_deg);
    let mut rng = Rng::new(seed);
    let mut rows = Vec::with_capacity(directions.len() * (4 + N));
    for angles in &directions {
        let wi = direction(angles[0], angles[1]);
        let wo = direction(angles[2], angles[3]);
        let values = columns.convert(&brdf.eval(wi, wo));
        rows.extend(angles);
        for value in values {
            rows.push(rounded(instrument.read(value, wi.z, &mut rng)));
        }
    }
    let comments = format!(
        "Computed from a formula, not measured; {}",
        instrument.describe()
    );
    let fields = [
        ("LAB_NAME", "gonio, a virtual gonioreflectometer"),
        ("LAB_COMMENTS", comments.as_str()),
        ("SYSTEM_NAME", "gonio measure"),
        ("SAMPLE_NAME", sample),
        ("SAMPLE_TYPE", "Synthetic"),
        ("MEAS_NAME", "BRDF"),
        ("MEAS_DATE", "UNKNOWN"),
        ("MEAS_TIME", "UNKNOWN"),
    ];
    Ok(AstmFile::new(&fields, columns.channels, rows)?)
}
