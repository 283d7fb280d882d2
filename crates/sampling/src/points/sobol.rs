//! The first two dimensions of Sobol's sequence, a (0,2)-sequence in base 2 [Sobol1967].

use super::hash::laine_karras;

/// Point number `index` of the sequence, index-shuffled by `shuffle` and Owen-scrambled by `scramble`, as
/// fractions of 2^32.
///
/// The shuffle is an Owen scramble of the index, too: it maps aligned blocks of 2^k indices to aligned
/// blocks, so their points remain a (0,k,2)-net, and decorrelates dimension pairs [Burley2020].
#[inline(always)]
pub(super) fn pair(index: u32, shuffle: u32, scramble: [u32; 2]) -> [u32; 2] {
    let i = laine_karras(index.reverse_bits(), shuffle).reverse_bits();
    // Both coordinates bit-reversed: the first is i itself, which saves reversing it twice.
    let x = laine_karras(i, scramble[0]);
    let y = laine_karras(pascal(i), scramble[1]);
    [x.reverse_bits(), y.reverse_bits()]
}

/// The product of Pascal's matrix modulo 2 and the bits of `v`: the second dimension, bit-reversed.
///
/// With bit k of v as the coefficient of t^k it is the substitution t -> 1 + t, done in halves, since
/// (1 + t)^(2^k) = 1 + t^(2^k) modulo 2 [Ahmed2024].
#[inline(always)]
fn pascal(v: u32) -> u32 {
    let v = v ^ (v >> 16);
    let v = v ^ ((v & 0xff00_ff00) >> 8);
    let v = v ^ ((v & 0xf0f0_f0f0) >> 4);
    let v = v ^ ((v & 0xcccc_cccc) >> 2);
    v ^ ((v & 0xaaaa_aaaa) >> 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn second_dimension_is_the_one_of_the_direction_numbers() {
        // Direction numbers of x + 1: v_1 = 1/2, v_(k+1) = v_k xor v_k / 2 [Sobol1967].
        for index in (0..4096_u32).chain([0xdead_beef, u32::MAX]) {
            let (mut v, mut expected) = (1_u32 << 31, 0);
            for bit in 0..32 {
                if index >> bit & 1 == 1 {
                    expected ^= v;
                }
                v ^= v >> 1;
            }
            assert_eq!(pascal(index).reverse_bits(), expected, "index {index}");
        }
    }

    /// Aligned blocks of 2^k points must have one point in each elementary interval of area 2^-k.
    #[test]
    fn shuffled_and_scrambled_blocks_are_nets() {
        for (k, block, seed) in [(4, 0, 1_u32), (6, 5, 2), (10, 3, 3), (12, 1, 4)] {
            let n = 1_u32 << k;
            let points: Vec<[u32; 2]> = (0..n)
                .map(|j| pair(block * n + j, seed, [seed * 77, seed * 1_234_567]))
                .collect();
            for a in 0..=k {
                let mut hit = vec![false; n as usize];
                for p in &points {
                    let column = u64::from(p[0]) >> (32 - a);
                    let row = u64::from(p[1]) >> (32 - (k - a));
                    hit[(column << (k - a) | row) as usize] = true;
                }
                assert!(hit.iter().all(|h| *h), "k {k}, split {a}");
            }
        }
    }
}
