//! Eight numbers at a time: AVX where the machine has it, plain loops elsewhere, the same bits from both.
//!
//! The compiler makes no mask of eight comparisons by itself, and lays out the slab test badly: hence by hand.

use crate::shape::{Number, ShearedRay, meet};

/// What the machine offers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lanes8 {
    #[cfg(target_arch = "x86_64")]
    avx: Option<pulp::core_arch::x86::Avx>,
}

/// One axis of a slab test: planes met first and last by a ray, its origin for either and the inverse of its direction.
#[derive(Clone, Copy)]
pub(super) struct Slab<'a> {
    pub(super) near: &'a [f32; 8],
    pub(super) far: &'a [f32; 8],
    pub(super) o: [f32; 2],
    pub(super) inverse: f32,
}

/// Widens the far end of a slab by the rounding of its two operations, here and of the near end [Pharr2023].
pub(super) const WIDER: f32 = 1.0 + 4.0 * f32::EPSILON;

impl Lanes8 {
    pub(super) fn detect() -> Self {
        Self {
            #[cfg(target_arch = "x86_64")]
            avx: match brdf::arch() {
                pulp::Arch::Scalar => None,
                _ => pulp::core_arch::x86::Avx::try_new(),
            },
        }
    }

    /// Where a ray enters each of eight boxes, and a bit for each that it enters between 0 and `t_max`.
    #[inline(always)]
    pub(super) fn enter(self, slabs: [Slab<'_>; 3], t_max: f32) -> ([f32; 8], u32) {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx) = self.avx {
            let (mut near, mut far) = (avx._mm256_setzero_ps(), avx._mm256_set1_ps(t_max));
            for slab in slabs {
                let inverse = avx._mm256_set1_ps(slab.inverse);
                let at = |planes: &[f32; 8], o: f32| {
                    let off = avx._mm256_sub_ps(pulp::cast(*planes), avx._mm256_set1_ps(o));
                    avx._mm256_mul_ps(off, inverse)
                };
                // of a NaN and a number both operations take the second: 0 * inf, a ray within a plane, bounds nothing
                near = avx._mm256_max_ps(at(slab.near, slab.o[0]), near);
                far = avx._mm256_min_ps(at(slab.far, slab.o[1]), far);
            }
            let far = avx._mm256_mul_ps(far, avx._mm256_set1_ps(WIDER));
            let met = avx._mm256_cmp_ps::<LESS_OR_EQUAL>(near, far);
            return (pulp::cast(near), avx._mm256_movemask_ps(met) as u32);
        }
        let (mut near, mut far) = ([0.0_f32; 8], [t_max; 8]);
        for slab in slabs {
            for k in 0..8 {
                let a = (slab.near[k] - slab.o[0]) * slab.inverse;
                near[k] = if a > near[k] { a } else { near[k] };
                let b = (slab.far[k] - slab.o[1]) * slab.inverse;
                far[k] = if b < far[k] { b } else { far[k] };
            }
        }
        (
            near,
            mask(std::array::from_fn(|k| near[k] <= far[k] * WIDER)),
        )
    }

    /// [`meet`] for eight triangles: corner, coordinate, lane.
    #[inline(always)]
    pub(super) fn meet(self, ray: &ShearedRay, corners: [[&[f32; 8]; 3]; 3]) -> [f32; 8] {
        let [a, b, c] = corners;
        #[cfg(target_arch = "x86_64")]
        if let Some(avx) = self.avx {
            let eight = |x: &[f32; 8]| Eight(avx, pulp::cast(*x));
            let a = [eight(a[0]), eight(a[1]), eight(a[2])];
            let b = [eight(b[0]), eight(b[1]), eight(b[2])];
            let c = [eight(c[0]), eight(c[1]), eight(c[2])];
            return pulp::cast(meet(ray, [a, b, c]).1);
        }
        let mut t = [0.0; 8];
        for k in 0..8 {
            let a = [a[0][k], a[1][k], a[2][k]];
            let b = [b[0][k], b[1][k], b[2][k]];
            let c = [c[0][k], c[1][k], c[2][k]];
            t[k] = meet(ray, [a, b, c]);
        }
        t
    }

    /// A bit for each number below `limit`.
    #[inline(always)]
    pub(super) fn below(self, x: &[f32; 8], limit: f32) -> u32 {
        #[cfg(target_arch = "x86_64")]
        if let Some(avx) = self.avx {
            let met = avx._mm256_cmp_ps::<LESS>(pulp::cast(*x), avx._mm256_set1_ps(limit));
            return avx._mm256_movemask_ps(met) as u32;
        }
        mask(std::array::from_fn(|k| x[k] < limit))
    }
}

#[cfg(target_arch = "x86_64")]
const LESS: i32 = std::arch::x86_64::_CMP_LT_OQ;
#[cfg(target_arch = "x86_64")]
const LESS_OR_EQUAL: i32 = std::arch::x86_64::_CMP_LE_OQ;

/// Eight numbers in a register of AVX.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
struct Eight(pulp::core_arch::x86::Avx, std::arch::x86_64::__m256);

#[cfg(target_arch = "x86_64")]
macro_rules! operator {
    ($operator:ident, $name:ident, $instruction:ident) => {
        impl std::ops::$operator for Eight {
            type Output = Self;

            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                Self(self.0, self.0.$instruction(self.1, other.1))
            }
        }
    };
}

#[cfg(target_arch = "x86_64")]
operator!(Add, add, _mm256_add_ps);
#[cfg(target_arch = "x86_64")]
operator!(Sub, sub, _mm256_sub_ps);
#[cfg(target_arch = "x86_64")]
operator!(Mul, mul, _mm256_mul_ps);
#[cfg(target_arch = "x86_64")]
operator!(Div, div, _mm256_div_ps);

#[cfg(target_arch = "x86_64")]
impl Number for Eight {
    #[inline(always)]
    fn splat(self, x: f32) -> Self {
        Self(self.0, self.0._mm256_set1_ps(x))
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        Self(self.0, self.0._mm256_min_ps(self.1, other.1))
    }

    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        Self(self.0, self.0._mm256_max_ps(self.1, other.1))
    }

    #[inline(always)]
    fn if_positive(self, yes: Self, no: Self) -> Self {
        let zero = self.0._mm256_setzero_ps();
        let met = self.0._mm256_cmp_ps::<LESS>(zero, self.1);
        Self(self.0, self.0._mm256_blendv_ps(no.1, yes.1, met))
    }

    #[inline(always)]
    fn if_zero(self, yes: Self, no: Self) -> Self {
        let zero = self.0._mm256_setzero_ps();
        let met = self.0._mm256_cmp_ps::<EQUAL>(zero, self.1);
        Self(self.0, self.0._mm256_blendv_ps(no.1, yes.1, met))
    }
}

#[cfg(target_arch = "x86_64")]
const EQUAL: i32 = std::arch::x86_64::_CMP_EQ_OQ;

/// A bit for each that is true.
#[inline(always)]
fn mask(set: [bool; 8]) -> u32 {
    (0..8).fold(0, |bits, k| bits | (u32::from(set[k]) << k))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn both_ways_give_the_same_bits() {
        #[cfg(target_arch = "x86_64")]
        let plain = Lanes8 { avx: None };
        #[cfg(not(target_arch = "x86_64"))]
        let plain = Lanes8 {};
        let number = |i: u64| (crate::math::mix(i) >> 40) as f32 / 8_388_608.0 - 1.0;
        let mut met = 0;
        for i in 0..2_000_u64 {
            let at = |j: u64| number(128 * i + j);
            let corners = [0, 1, 2].map(|corner: u64| {
                [0, 1, 2]
                    .map(|axis: u64| std::array::from_fn(|k| at(9 * k as u64 + 3 * corner + axis)))
            });
            // on every third turn a ray within a plane of coordinates, whose edges may vanish
            let x = if i % 3 == 0 { 0.0 } else { at(100) };
            let d = Vec3::new(x, at(101), at(102)).normalize_or(Vec3::Y);
            let ray = ShearedRay::new(Vec3::new(x, at(103), at(104)), d);
            let [a, b] = [plain, Lanes8::detect()]
                .map(|lanes| lanes.meet(&ray, corners.each_ref().map(|c| c.each_ref())));
            assert_eq!(a.map(f32::to_bits), b.map(f32::to_bits), "ray {i}");
            met += a.iter().filter(|t| t.is_finite()).count();
        }
        assert!(met > 100, "only {met} hits");
    }
}
