//! Rows of channels at the nodes of a table, as the look-up lane by lane reads them.

use std::fmt::Debug;

/// The channels of each node, neighbours in memory.
pub(crate) trait NodeRows {
    /// The channels of one node, in single precision.
    type Row: Copy + Debug;
    /// All zero.
    const ZERO: Self::Row;

    /// The row of one node.
    fn row(&self, node: usize) -> Self::Row;

    /// Adds the rows of `node` and the next, each by its weight, to `row`.
    fn add_pair(&self, node: usize, weights: [f32; 2], row: &mut Self::Row);
}

/// `K` floats a node.
pub(crate) struct FloatRows<'a, const K: usize>(pub(crate) &'a [[f32; K]]);

impl<const K: usize> NodeRows for FloatRows<'_, K> {
    type Row = [f32; K];
    const ZERO: Self::Row = [0.0; K];

    #[inline(always)]
    fn row(&self, node: usize) -> Self::Row {
        self.0[node]
    }

    #[inline(always)]
    fn add_pair(&self, node: usize, [low, high]: [f32; 2], row: &mut Self::Row) {
        let pair = &self.0[node..node + 2];
        for c in 0..K {
            row[c] += low * pair[0][c] + high * pair[1][c];
        }
    }
}

/// Entries of a cache line.
const LINE: usize = 32;

/// A cache line of whole numbers.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
struct Line([i16; LINE]);

/// Up to `32 L - 1` channels a node in `L` cache lines: whole numbers of 16 bits that share an exponent, kept in the last
/// entry.
///
/// A channel is off by at most 2^-15 of the largest of its node: half a unit, of which the largest has at least 2^14. A table of
/// 31 bands is half as large as in single precision, and a look-up waits for eight lines of memory instead of twenty.
#[derive(Clone, Debug)]
pub(crate) struct PackedRows<const L: usize> {
    lines: Vec<[Line; L]>,
}

impl<const L: usize> PackedRows<L> {
    /// How many channels fit.
    pub(crate) const CHANNELS: usize = LINE * L - 1;

    /// Packs `nodes`, `channels` finite floats each; `None` if so many don't fit.
    pub(crate) fn new(nodes: &[f32], channels: usize) -> Option<Self> {
        let fits = (1..=Self::CHANNELS).contains(&channels);
        let pack = |row| pack::<L>(row);
        fits.then(|| Self {
            lines: nodes.chunks_exact(channels).map(pack).collect(),
        })
    }

    /// Bytes held.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.lines.as_slice())
    }
}

fn pack<const L: usize>(row: &[f32]) -> [Line; L] {
    let most = row.iter().fold(0.0_f32, |m, v| m.max(v.abs()));
    // most / 2^e lies in [2^14, 2^15); below that range single precision has denormal numbers, which become zero
    let exponent = ((most.to_bits() >> 23).cast_signed() - 127 - 14).max(-126);
    let unit = power_of_two(exponent);
    let mut out = [Line([0; LINE]); L];
    for (c, v) in row.iter().enumerate() {
        let whole = (v / unit).round().clamp(-32_767.0, 32_767.0);
        out[c / LINE].0[c % LINE] = whole as i16;
    }
    out[L - 1].0[LINE - 1] = exponent as i16;
    out
}

/// 2^e for e from -126 to 127.
#[inline(always)]
fn power_of_two(e: i32) -> f32 {
    f32::from_bits(((e + 127) as u32) << 23)
}

#[inline(always)]
fn unit<const L: usize>(lines: &[Line; L]) -> f32 {
    power_of_two(i32::from(lines[L - 1].0[LINE - 1]))
}

impl<const L: usize> NodeRows for PackedRows<L> {
    /// The last entry means nothing.
    type Row = [[f32; LINE]; L];
    const ZERO: Self::Row = [[0.0; LINE]; L];

    #[inline(always)]
    fn row(&self, node: usize) -> Self::Row {
        let lines = &self.lines[node];
        let unit = unit(lines);
        lines.map(|line| line.0.map(|whole| unit * f32::from(whole)))
    }

    #[inline(always)]
    fn add_pair(&self, node: usize, weights: [f32; 2], row: &mut Self::Row) {
        let pair = &self.lines[node..node + 2];
        let low = weights[0] * unit(&pair[0]);
        let high = weights[1] * unit(&pair[1]);
        for l in 0..L {
            for c in 0..LINE {
                let (a, b) = (pair[0][l].0[c], pair[1][l].0[c]);
                row[l][c] += low * f32::from(a) + high * f32::from(b);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_rows_are_near_and_extremes_hold() {
        let rows: Vec<[f32; 31]> = [0.0, 1e-38, 1e-20, 1.0, 1.999_999, 3e9, 1e37]
            .map(|scale| std::array::from_fn(|c| scale * (c as f32 / 30.0 - 0.1)))
            .to_vec();
        let packed = PackedRows::<1>::new(rows.as_flattened(), 31).unwrap();
        assert_eq!(packed.bytes(), 64 * rows.len());
        for (node, row) in rows.iter().enumerate() {
            let most = row.iter().fold(0.0_f32, |m, v| m.max(v.abs()));
            let [found] = packed.row(node);
            for (v, f) in row.iter().zip(found) {
                let allowed = most * 0.5_f32.powi(15) + 1.2e-38;
                assert!((v - f).abs() <= allowed, "node {node}: {v} became {f}");
            }
        }
    }

    #[test]
    fn pairs_add_up_over_all_lines() {
        let nodes: Vec<f32> = (0..130).map(|c| 1.0 + c as f32).collect();
        let packed = PackedRows::<3>::new(&nodes, 65).unwrap();
        let mut row = PackedRows::<3>::ZERO;
        packed.add_pair(0, [0.25, 0.5], &mut row);
        for c in 0..65 {
            let expected = 0.25 * nodes[c] + 0.5 * nodes[65 + c];
            let found = row.as_flattened()[c];
            assert!((found - expected).abs() < 0.01, "{found} {expected}");
        }
        assert!(PackedRows::<3>::new(&nodes, 96).is_none(), "95 fit");
    }
}
