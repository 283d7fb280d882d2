//! An RGL file in memory, of zeros or with one bright value.

use super::tables::{Content, SPIKE};
use brdf_formats::{Dtype, RglFile, TensorField, write_tensor};
use brdf_table::RglTable;
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

/// Nodes of the warps and images.
const SIDE: usize = 8;
/// Polar angles of incidence.
const INCIDENCES: usize = 4;

/// The table; `None` if the file is not accepted.
pub(super) fn table(content: Content) -> Option<Arc<RglTable>> {
    let slice = SIDE * SIDE;
    let thetas: Vec<f32> = (0..INCIDENCES)
        .map(|k| (FRAC_PI_2 * k as f64 / (INCIDENCES - 1) as f64) as f32)
        .collect();
    let mut rgb = vec![0.0_f32; INCIDENCES * 3 * slice];
    let mut luminance = vec![1e-6_f32; INCIDENCES * slice];
    if content == Content::Spike {
        // the middle of the second slice
        let at = slice + slice / 2 + SIDE / 2;
        luminance[at] = SPIKE as f32;
        for c in 0..3 {
            rgb[(3 + c) * slice + slice / 2 + SIDE / 2] = SPIKE as f32;
        }
    }
    let (n, t) = (SIDE as u64, INCIDENCES as u64);
    let floats = TensorField::floats;
    let bytes = write_tensor(&[
        floats("phi_i", &[1], &[0.0]),
        floats("theta_i", &[t], &thetas),
        floats("sigma", &[2, 2], &[1.0, 0.2, 1.0, 0.2]),
        floats("ndf", &[n, n], &vec![0.5; slice]),
        floats("vndf", &[1, t, n, n], &vec![1.0; INCIDENCES * slice]),
        floats("luminance", &[1, t, n, n], &luminance),
        floats("rgb", &[1, t, 3, n, n], &rgb),
        TensorField {
            name: "jacobian",
            dtype: Dtype::U8,
            shape: &[1],
            data: vec![1],
        },
    ]);
    let file = RglFile::from_bytes(bytes).ok()?;
    Some(Arc::new(RglTable::new(&file).ok()?))
}
