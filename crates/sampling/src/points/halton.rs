//! Halton's sequence with Owen scrambling of its digits.

/// One prime a dimension: the bases of 32 pairs.
const PRIMES: [u32; 64] = [
    2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59, 61, 67, 71, 73, 79, 83, 89, 97,
    101, 103, 107, 109, 113, 127, 131, 137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193,
    197, 199, 211, 223, 227, 229, 233, 239, 241, 251, 257, 263, 269, 271, 277, 281, 283, 293, 307,
    311,
];

/// Coordinates 2 `dim` and 2 `dim` + 1 of point `index`, scrambled by `seeds`; `None` beyond the primes.
pub(super) fn pair(index: u32, dim: u32, seeds: [u32; 2]) -> Option<[f32; 2]> {
    let first = 2 * dim as usize;
    let bases = PRIMES.get(first..first + 2)?;
    let at = |k: usize| {
        let x = radical_inverse(index, bases[k], seeds[k]) as f32;
        x.min(1.0 - f32::EPSILON / 2.0)
    };
    Some([at(0), at(1)])
}

/// The digits of `index` in `base` behind the point, each permuted in a way that depends on all digits
/// before it [Owen1995].
///
/// Leading zeros are digits, too, so digits are added until f32 can't tell: base^-k < 2^-24.
fn radical_inverse(mut index: u32, base: u32, seed: u32) -> f64 {
    let mut value: u64 = 0;
    let mut scale: u64 = 1;
    let mut prefix = mix(seed);
    while scale < 1 << 24 {
        let digit = index % base;
        index /= base;
        value = value * u64::from(base) + u64::from(permute(digit, base, prefix));
        scale *= u64::from(base);
        prefix = mix(prefix ^ (digit + 1).wrapping_mul(0x9e37_79b1));
    }
    value as f64 / scale as f64
}

/// The permutation d -> a d + c modulo the prime `base`, a != 0 and c chosen by `seed`.
///
/// Any two distinct digits have all distinct pairs of images equally likely, which is all that the variance
/// of a full random permutation rests on [Matousek1998].
fn permute(digit: u32, base: u32, seed: u32) -> u32 {
    let factor = 1 + (seed >> 16) % (base - 1);
    (factor * digit + (seed & 0xffff) % base) % base
}

/// A 32-bit finaliser: `lowbias32` [Wellons2018].
fn mix(x: u32) -> u32 {
    let x = (x ^ (x >> 16)).wrapping_mul(0x7feb_352d);
    let x = (x ^ (x >> 15)).wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_permuted() {
        for base in PRIMES {
            for seed in [0, 1, 0x1234_5678, u32::MAX] {
                let mut image: Vec<u32> = (0..base).map(|d| permute(d, base, seed)).collect();
                image.sort_unstable();
                assert!(image.into_iter().eq(0..base), "base {base}, seed {seed}");
            }
        }
    }

    #[test]
    fn each_block_of_base_to_the_k_is_stratified() {
        for (base, k) in [(2, 10), (3, 6), (5, 4), (7, 3)] {
            let n = u32::pow(base, k);
            for block in [0, 3] {
                let mut cells: Vec<u32> = (0..n)
                    .map(|j| {
                        let x = radical_inverse(block * n + j, base, 99);
                        // a multiple of base^-k up to rounding: 1e-9 is below the next one
                        (x * f64::from(n) + 1e-9) as u32
                    })
                    .collect();
                cells.sort_unstable();
                assert!(cells.into_iter().eq(0..n), "base {base}, block {block}");
            }
        }
    }
}
