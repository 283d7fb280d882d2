//! Node values in one byte: four bits of exponent, four of mantissa.
//!
//! A byte q stands for (1 + (q mod 16) / 16) 2^(q div 16), from 1 to 63488; the step is 3 to 6 %. Placed into
//! the exponent field of an f32 this is a shift and an addition, so whole rows decode without a table.

/// Largest value a byte can hold.
pub(crate) const MAX: f64 = 63488.0;

/// The value of `q`.
#[inline(always)]
pub(crate) const fn decode(q: u8) -> f32 {
    f32::from_bits(((q as u32) << 19) + 0x3f80_0000)
}

/// All values.
static VALUES: [f32; 256] = {
    let (mut values, mut q) = ([0.0; 256], 0);
    while q < 256 {
        values[q] = decode(q as u8);
        q += 1;
    }
    values
};

/// [`decode`] by a table: one instruction where single nodes are wanted and not rows.
#[inline(always)]
pub(crate) fn look_up(q: u8) -> f32 {
    VALUES[usize::from(q)]
}

/// The value of the lowest byte of `word`.
#[inline(always)]
pub(crate) fn decode_low_byte(word: u32) -> f32 {
    f32::from_bits(((word & 0xff) << 19) + 0x3f80_0000)
}

/// The byte nearest to `value`, which is clamped to [1, [`MAX`]].
pub(crate) fn encode(value: f64) -> u8 {
    let clamped = value.clamp(1.0, MAX) as f32;
    // half a step is added in the last mantissa bit kept; the clamp keeps this within a byte
    let bits = clamped.to_bits() - 0x3f80_0000 + (1 << 18);
    (bits >> 19).min(255) as u8
}

#[cfg(test)]
mod tests {
    use super::{MAX, decode, encode, look_up};

    #[test]
    fn bytes_survive_and_values_round_to_the_nearest() {
        for q in 0..=255 {
            assert_eq!(encode(f64::from(decode(q))), q, "byte {q}");
            assert_eq!(look_up(q).to_bits(), decode(q).to_bits(), "byte {q}");
        }
        assert_eq!(f64::from(decode(255)).to_bits(), MAX.to_bits(), "largest");
        for k in 0..5000 {
            let value = (f64::from(k) * 0.0022).exp();
            let back = f64::from(decode(encode(value)));
            // half a step of 1/16 at the low end of an octave
            assert!(
                (back / value - 1.0).abs() <= 1.0 / 32.0 + 1e-6,
                "{value} became {back}"
            );
        }
    }
}
