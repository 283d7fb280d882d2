//! An RGL file in memory, of zeros or with one bright value.

use super::tables::{Content, SPIKE};
use brdf_formats::RglFile;
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
    let fields = [
        ("phi_i", vec![1], vec![0.0]),
        ("theta_i", vec![t], thetas),
        ("sigma", vec![2, 2], vec![1.0, 0.2, 1.0, 0.2]),
        ("ndf", vec![n, n], vec![0.5; slice]),
        ("vndf", vec![1, t, n, n], vec![1.0; INCIDENCES * slice]),
        ("luminance", vec![1, t, n, n], luminance),
        ("rgb", vec![1, t, 3, n, n], rgb),
    ];
    let file = RglFile::from_bytes(bytes(&fields)).ok()?;
    Some(Arc::new(RglTable::new(&file).ok()?))
}

/// Magic, version 1.0, heads (name, dimensions, kind, offset, shape), then the data; kinds are 10 = f32 and 1 = u8.
fn bytes(fields: &[(&str, Vec<u64>, Vec<f32>)]) -> Vec<u8> {
    let mut all: Vec<(&str, u8, Vec<u64>, Vec<u8>)> = fields
        .iter()
        .map(|(name, shape, data)| {
            let data = data.iter().flat_map(|v| v.to_le_bytes()).collect();
            (*name, 10, shape.clone(), data)
        })
        .collect();
    all.push(("jacobian", 1, vec![1], vec![1]));
    let heads: usize = all.iter().map(|f| 13 + f.0.len() + 8 * f.2.len()).sum();
    let mut offset = (18 + heads) as u64;
    let mut out = b"tensor_file\0\x01\0".to_vec();
    out.extend((all.len() as u32).to_le_bytes());
    for (name, kind, shape, data) in &all {
        out.extend((name.len() as u16).to_le_bytes());
        out.extend(name.bytes());
        out.extend((shape.len() as u16).to_le_bytes());
        out.push(*kind);
        out.extend(offset.to_le_bytes());
        out.extend(shape.iter().flat_map(|n| n.to_le_bytes()));
        offset += data.len() as u64;
    }
    out.extend(all.iter().flat_map(|f| &f.3));
    out
}
