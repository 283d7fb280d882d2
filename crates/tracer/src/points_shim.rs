//! Shim until sampling::Points is merged.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PointSet {
    Independent,
    Halton,
    Sobol,
}

#[derive(Clone, Copy, Debug)]
pub struct Points {
    kind: PointSet,
    seed: u64,
}

#[inline(always)]
fn hash3(a: u32, b: u32, c: u32) -> u32 {
    let mut h = a.wrapping_mul(0x9e37_79b1)
        ^ b.wrapping_mul(0x85eb_ca6b).rotate_left(13)
        ^ c.wrapping_mul(0xc2b2_ae35).rotate_left(7);
    h ^= h >> 16;
    h = h.wrapping_mul(0x7feb_352d);
    h ^= h >> 15;
    h = h.wrapping_mul(0x846c_a68b);
    h ^ (h >> 16)
}
#[inline(always)]
fn lk(mut x: u32, seed: u32) -> u32 {
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x
}
#[inline(always)]
fn owen(x: u32, seed: u32) -> u32 {
    lk(x.reverse_bits(), seed).reverse_bits()
}

impl Points {
    #[must_use]
    pub fn new(kind: PointSet, seed: u64) -> Self {
        Self { kind, seed }
    }
    #[inline(always)]
    #[must_use]
    pub fn get2(&self, pixel: u32, index: u32, dim: u32) -> [f32; 2] {
        let h = hash3(self.seed as u32, pixel, dim);
        if self.kind == PointSet::Independent {
            let a = hash3(h, index, 1);
            let b = hash3(h, index, 2);
            return [
                (a >> 8) as f32 * (1.0 / 16_777_216.0),
                (b >> 8) as f32 * (1.0 / 16_777_216.0),
            ];
        }
        let i = owen(index, h);
        let x = i.reverse_bits();
        let mut y = x; // Sobol' dimension 2 = Pascal matrix: in reversed order
        y ^= y >> 16;
        y ^= (y & 0xff00_ff00) >> 8;
        y ^= (y & 0xf0f0_f0f0) >> 4;
        y ^= (y & 0xcccc_cccc) >> 2;
        y ^= (y & 0xaaaa_aaaa) >> 1;
        let x = owen(x, hash3(h, 0x1234, 5));
        let y = owen(y, hash3(h, 0x5678, 9));
        [
            (x >> 8) as f32 * (1.0 / 16_777_216.0),
            (y >> 8) as f32 * (1.0 / 16_777_216.0),
        ]
    }
    #[inline(always)]
    #[must_use]
    pub fn get1(&self, pixel: u32, index: u32, dim: u32) -> f32 {
        self.get2(pixel, index, dim)[0]
    }
    #[inline(always)]
    #[must_use]
    pub fn get2_lanes(&self, pixel: [u32; 16], index: [u32; 16], dim: u32) -> [[f32; 16]; 2] {
        let mut out = [[0.0; 16]; 2];
        for k in 0..16 { [out[0][k], out[1][k]] = self.get2(pixel[k], index[k], dim); }
        out
    }
}
