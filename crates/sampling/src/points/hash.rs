//! Hashes of a few machine words, made of operations every SIMD unit has.

/// Four words to four words that look unrelated to them: pcg4d [Jarzynski2020].
///
/// The low bits of every input spread everywhere, the top ones hardly: put small counters in.
#[inline(always)]
pub(super) fn pcg4d(v: [u32; 4]) -> [u32; 4] {
    let [x, y, z, w] = v.map(|v| v.wrapping_mul(1_664_525).wrapping_add(1_013_904_223));
    let [x, y, z, w] = stir([x, y, z, w]).map(|v| v ^ (v >> 16));
    stir([x, y, z, w])
}

#[inline(always)]
fn stir([x, y, z, w]: [u32; 4]) -> [u32; 4] {
    let x = x.wrapping_add(y.wrapping_mul(w));
    let y = y.wrapping_add(z.wrapping_mul(x));
    let z = z.wrapping_add(x.wrapping_mul(y));
    let w = w.wrapping_add(y.wrapping_mul(z));
    [x, y, z, w]
}

/// A hash in which bit k of the result depends on bits 0..=k of `x` only: applied to reversed bits it is a
/// nested uniform (Owen) scramble [Laine2011], here with the constants of [Vegdahl2021].
#[inline(always)]
pub(super) fn laine_karras(x: u32, seed: u32) -> u32 {
    let x = x ^ x.wrapping_mul(0x3d20_adea);
    let x = x.wrapping_add(seed).wrapping_mul((seed >> 16) | 1);
    let x = x ^ x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}
