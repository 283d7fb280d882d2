//! Interpolants resampled onto a grid, in linear sRGB or in bands: seconds to compute, milliseconds to read.

use super::Kind;
use brdf::{HalfDiff, Status};
use brdf_table::{HalfDiffTable, PhiDomain, Resampled};
use spectrum::{Basis, RgbSpace};
use std::f64::consts::{FRAC_PI_2, PI};

/// Raised whenever interpolation, resampling or the layout below changes.
const VERSION: u32 = 2;
/// Most cells of a stored grid: 4 million.
const MAX_CELLS: usize = 1 << 22;
/// Most bands.
const MAX_BANDS: usize = 1 << 10;

pub(super) const KIND: Kind<Resampled> = Kind {
    tag: *b"GRID",
    version: VERSION,
    name: "grid",
    encode,
    decode: |payload| decode(payload).ok_or_else(|| "its content contradicts itself".into()),
};

/// Three u64 (cells), error and mean f64, number of bands u64 (0: linear sRGB) and each one's nm f64, then 0 or 1 a cell
/// (measured), then f32 channels a cell.
fn encode(resampled: &Resampled) -> Vec<u8> {
    let table = &resampled.table;
    let mut out: Vec<u8> = (table.dims().into_iter())
        .flat_map(|n| (n as u64).to_le_bytes())
        .collect();
    out.extend(resampled.rms_error.to_le_bytes());
    out.extend(resampled.mean.to_le_bytes());
    let bands = match table.basis() {
        Basis::Bands(nm) => &nm[..],
        _ => &[],
    };
    out.extend((bands.len() as u64).to_le_bytes());
    out.extend(bands.iter().flat_map(|nm| nm.to_le_bytes()));
    out.extend(table.cell_indices().map(|c| u8::from(table.is_valid(c))));
    for cell in table.cell_indices() {
        for value in table.value(cell).unwrap_or_default() {
            out.extend(value.to_le_bytes());
        }
    }
    out
}

fn decode(payload: &[u8]) -> Option<Resampled> {
    let (words, _) = payload.as_chunks::<8>();
    let &[n_h, n_d, n_p, rms_error, mean, bands] = words.first_chunk()?;
    let bands = usize::try_from(u64::from_le_bytes(bands)).ok();
    let bands = bands.filter(|n| *n <= MAX_BANDS)?;
    let nm = words.get(6..6 + bands)?;
    let basis = match nm {
        [] => Basis::Rgb(RgbSpace::srgb()),
        nm => Basis::Bands(nm.iter().map(|w| f64::from_le_bytes(*w)).collect()),
    };
    let channels = basis.len();
    let rest = &payload[(6 + bands) * 8..];
    let mut dims = [0; 3];
    for (n, word) in dims.iter_mut().zip([n_h, n_d, n_p]) {
        *n = usize::try_from(u64::from_le_bytes(word)).ok()?;
    }
    let cells = (dims.iter())
        .try_fold(1_usize, |product, n| product.checked_mul(*n))
        .filter(|n| (1..=MAX_CELLS).contains(n))?;
    let (valid, values) = rest.split_at_checked(cells)?;
    let (values, []) = values.as_chunks::<4>() else {
        return None;
    };
    if Some(values.len()) != cells.checked_mul(channels) || valid.iter().any(|v| *v > 1) {
        return None;
    }
    let index = |wi, wo| {
        let at = HalfDiff::new(wi, wo);
        // asked at the centres of cells only: half a cell from where rounding could matter
        let cell = |part: f64, n: usize| ((part * n as f64) as usize).min(n - 1);
        // theta_h is spaced by its square root
        let h = cell((at.theta_h / FRAC_PI_2).sqrt(), dims[0]);
        let d = cell(at.theta_d / FRAC_PI_2, dims[1]);
        (h * dims[1] + d) * dims[2] + cell(at.phi_d.abs() / PI, dims[2])
    };
    let table = HalfDiffTable::from_fn(dims, PhiDomain::Mirror, basis, |wi, wo, out| {
        let k = index(wi, wo);
        for (o, bytes) in out.iter_mut().zip(&values[k * channels..]) {
            *o = f64::from(f32::from_le_bytes(*bytes));
        }
        match valid[k] {
            0 => Status::Filled,
            _ => Status::Interpolated,
        }
    });
    Some(Resampled {
        table,
        rms_error: f64::from_le_bytes(rms_error),
        mean: f64::from_le_bytes(mean),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn resampled(basis: Basis) -> Resampled {
        let table = HalfDiffTable::from_fn([9, 8, 7], PhiDomain::Mirror, basis, |wi, wo, out| {
            let values = [wi.z, wo.z * wo.x, -wi.dot(wo), 0.25];
            out.copy_from_slice(&values[..out.len()]);
            if wo.z > 0.3 {
                Status::Interpolated
            } else {
                Status::Filled
            }
        });
        Resampled {
            table,
            rms_error: 0.125,
            mean: 2.0,
        }
    }

    #[test]
    fn a_grid_comes_back_bit_by_bit_with_what_was_measured() {
        let bands = Basis::Bands(vec![400.0, 480.5, 520.0, 700.0]);
        for basis in [Basis::Rgb(RgbSpace::srgb()), bands] {
            let truth = resampled(basis);
            let valid = truth.table.valid_cells();
            assert!(valid > 0 && valid < 9 * 8 * 7, "{valid} cells");
            let back = decode(&encode(&truth)).unwrap();
            assert!(back.table == truth.table, "the table differs");
            assert_eq!(back.rms_error.to_bits(), truth.rms_error.to_bits());
            assert_eq!(back.mean.to_bits(), truth.mean.to_bits());
        }
    }

    #[test]
    fn no_byte_may_be_missing_or_too_many() {
        let bytes = encode(&resampled(Basis::Rgb(RgbSpace::srgb())));
        for length in (0..bytes.len()).step_by(97) {
            assert!(decode(&bytes[..length]).is_none(), "length {length}");
        }
        let longer = [&bytes[..], &[0]].concat();
        assert!(decode(&longer).is_none(), "longer");
        for at in 0..24 {
            let mut other = bytes.clone();
            other[at] ^= 0x80;
            assert!(decode(&other).is_none(), "dimension byte {at}");
        }
    }
}
