//! One shadow ray for several candidates: resampling of light samples [Talbot2005].
//!
//! M points on lights and the one direction the material chose share the balance heuristic: candidate x_j adds
//! c_j = f cos L / (M p(x_j) + q(x_j)), with the densities p of the lights and q of the material, and the sum of all c_j
//! that are visible is the light's part of the estimate. Instead of M shadow rays one is sent, toward candidate y chosen
//! with probability t_y / T in proportion to the size t_j of c_j, T = sum t_j, and carries c_y T / t_y: the same in
//! expectation, for every set of candidates. The material's own direction needs no ray of its own, since the path goes
//! there in any case.

use crate::light::LightLanes;
use crate::math::F;
use brdf::{EvalPacket, LANES, Tag};

/// What the chosen candidate of each lane carries, and which it is.
pub(crate) struct Chosen<const N: usize> {
    pub(crate) candidate: [usize; LANES],
    pub(crate) carried: [F; N],
}

/// Chooses among the candidates of one block by one number `u` in [0, 1) a lane.
///
/// `weigh` is whether the material could find the light as well. Lanes without any light keep a zero.
#[inline(always)]
pub(crate) fn choose<const N: usize, T: Tag>(
    throughput: &[F; N],
    evals: &[EvalPacket<N, T>],
    lights: &[LightLanes<N>],
    u: &F,
    weigh: bool,
) -> Chosen<N> {
    let m = evals.len() as f32;
    let contribution = |j: usize, k: usize| -> ([f32; N], f32) {
        let (eval, light) = (&evals[j], &lights[j]);
        if light.pdf[k] <= 0.0 || eval.wi.z[k] <= 0.0 {
            return ([0.0; N], 0.0);
        }
        let found_by_material = if weigh {
            light.shared[k] * eval.pdf[k]
        } else {
            0.0
        };
        let weight = 1.0 / (m * light.pdf[k] + found_by_material);
        let c: [f32; N] = std::array::from_fn(|c| {
            throughput[c][k] * eval.f_cos[c][k] * light.radiance[c][k] * weight
        });
        let size: f32 = c.iter().map(|c| c.abs()).sum();
        if size < f32::INFINITY {
            (c, size)
        } else {
            ([0.0; N], 0.0)
        }
    };
    let mut total = [0.0; LANES];
    for j in 0..evals.len() {
        for k in 0..LANES {
            total[k] += contribution(j, k).1;
        }
    }
    let mut out = Chosen {
        candidate: [0; LANES],
        carried: [[0.0; LANES]; N],
    };
    for k in 0..LANES {
        let (at, mut sum) = (u[k] * total[k], 0.0);
        for j in 0..evals.len() {
            let (c, size) = contribution(j, k);
            if size > 0.0 && sum <= at {
                // the last of those whose part of [0, T) begins at or before `at`
                out.candidate[k] = j;
                for (carried, c) in out.carried.iter_mut().zip(c) {
                    carried[k] = c * (total[k] / size);
                }
            }
            sum += size;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Candidates of sizes 1, 0, 3 are chosen for the first quarter and the rest of `u`, and carry the sum of all.
    #[test]
    fn candidates_are_chosen_by_their_size() {
        let mut evals = vec![EvalPacket::<1>::ZERO; 3];
        let mut lights = vec![LightLanes::<1>::EMPTY; 3];
        for (j, size) in [1.0_f32, 0.0, 3.0].into_iter().enumerate() {
            evals[j].wi.z = [1.0; LANES];
            evals[j].f_cos = [[size * 3.0; LANES]];
            lights[j].pdf = [1.0; LANES];
            lights[j].radiance = [[1.0; LANES]];
        }
        let u = std::array::from_fn(|k| k as f32 / LANES as f32);
        let chosen = choose(&[[1.0; LANES]], &evals, &lights, &u, false);
        for k in 0..LANES {
            assert_eq!(
                chosen.candidate[k],
                if k < LANES / 4 { 0 } else { 2 },
                "lane {k}"
            );
            assert!((chosen.carried[0][k] - 4.0).abs() < 1e-6, "lane {k}");
        }
        evals[2].wi.z = [-1.0; LANES];
        let chosen = choose(&[[1.0; LANES]], &evals, &lights, &u, false);
        assert_eq!(chosen.candidate, [0; LANES], "below the horizon");
    }
}
