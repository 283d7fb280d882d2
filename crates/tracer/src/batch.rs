//! The stream: a batch of paths goes through each stage together.
//!
//! Per vertex: nearest hits; light met; sorting by material; for each material, blocks of vertices with a point on a
//! light, one virtual call to evaluate and one to sample, shadow rays; new rays, dense again. Light is collected in
//! one slot a path and added to the film in the order of the slots, whatever the paths' order became.

use crate::film::TileMut;
use crate::kernel::{Kernel, SHINES};
use crate::math::{F, U, splat3};
use crate::mode::{Develop, Mode};
use crate::path::{NONE, PathState};
use crate::ris;
use crate::workspace::{BLOCKS, WAITING, Workspace};
use brdf::{LANES, Lanes3, Tag};
use std::time::Instant;

/// A path this weak ends: its products would be denormal. What a shadow ray carries is light, of any strength.
const FAINT: f32 = 1e-30;

/// Up to so many materials, paths are sorted in one pass each.
const FEW: usize = 6;

/// Shortens shadow rays by a relative hair, so that what touches a light's back does not hide it.
const NEARLY: f32 = 1.0 - 1.0 / 16_384.0;

/// Which samples a batch takes: of every pixel of a tile, the samples from `first` on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Samples {
    pub(crate) first: u32,
    pub(crate) count: u32,
}

/// A batch to be compiled for each instruction set and run with the widest there is.
///
/// Everything down to the materials' virtual calls is inlined into it; results are the same bits, since no step is fused.
pub(crate) struct Batch<'a, 'k, 't, const N: usize, const M: usize, S: Mode<N>> {
    pub(crate) workspace: &'a mut Workspace<N, S>,
    pub(crate) kernel: &'a Kernel<'k, N, S>,
    pub(crate) tile: &'a mut TileMut<'t, M>,
    pub(crate) samples: Samples,
}

impl<const N: usize, const M: usize, S: Develop<N, M>> pulp::WithSimd
    for Batch<'_, '_, '_, N, M, S>
{
    type Output = ();

    #[inline(always)]
    fn with_simd<I: pulp::Simd>(self, _: I) {
        self.workspace.run(self.kernel, self.tile, self.samples);
    }
}

impl<const N: usize, S: Mode<N>> Workspace<N, S> {
    /// Traces the samples of every pixel of `tile` and adds them to it.
    #[inline(always)]
    fn run<const M: usize>(
        &mut self,
        kernel: &Kernel<'_, N, S>,
        tile: &mut TileMut<'_, M>,
        samples: Samples,
    ) where
        S: Develop<N, M>,
    {
        let mut clock = Instant::now();
        let mut lap = || {
            let now = Instant::now();
            let passed = now - clock;
            clock = now;
            passed
        };
        self.start(kernel, tile, samples);
        self.stats.stages.camera += lap();
        for depth in 0..=kernel.max_depth {
            if self.paths.len == 0 {
                break;
            }
            for (rays, hits) in self.paths.rays[..self.paths.blocks()]
                .iter()
                .zip(&mut self.hits)
            {
                kernel.scene.geometry.closest(rays, hits);
            }
            self.stats.closest_rays += self.paths.len as u64;
            self.stats.stages.closest += lap();
            self.meet(kernel, depth);
            self.stats.stages.sort += lap();
            self.next.len = 0;
            let mut start = 0;
            for material in 0..kernel.scene.materials.len() {
                let end = self.ends[material];
                while start < end {
                    let stop = end.min(start + BLOCKS * LANES);
                    let blocks = self.prepare(kernel, depth, start..stop);
                    self.stats.stages.prepare += lap();
                    self.ask(kernel, material, blocks);
                    self.stats.stages.material += lap();
                    self.advance(kernel, depth, blocks);
                    self.stats.stages.advance += lap();
                    if self.shadows.len + BLOCKS * LANES > WAITING {
                        self.trace_shadows(kernel);
                        self.stats.stages.shadow += lap();
                    }
                    start = stop;
                }
            }
            self.stats.vertices += start as u64;
            self.next.seal();
            std::mem::swap(&mut self.paths, &mut self.next);
            self.trace_shadows(kernel);
            self.stats.stages.shadow += lap();
        }
        self.finish(&kernel.scene.mode, tile, samples);
        self.stats.stages.film += lap();
    }

    /// Camera rays, slot by slot: all pixels of the first sample, then of the next.
    #[inline(always)]
    fn start<const M: usize>(
        &mut self,
        kernel: &Kernel<'_, N, S>,
        tile: &TileMut<'_, M>,
        samples: Samples,
    ) {
        self.place(kernel, tile, samples);
        let slot = self.paths.len;
        self.slots[..slot].fill([0.0; N]);
        for slot in 0..slot {
            let tag = kernel.tag(self.stream[slot], self.index[slot]);
            tag.put(&mut self.tag, slot);
        }
        for block in 0..self.paths.blocks() {
            let lanes = block * LANES..(block + 1) * LANES;
            let stream = lanes_of(&self.stream[lanes.clone()]);
            let index = lanes_of(&self.index[lanes.clone()]);
            let x = lanes_of(&self.corner[0][lanes.clone()]);
            let y = lanes_of(&self.corner[1][lanes.clone()]);
            let u = kernel.points.get2_lanes(stream, index, 0);
            let (x, y) = kernel.filter.place(&x, &y, &u);
            let rays = &mut self.paths.rays[block];
            for k in 0..LANES {
                rays.d.set(k, kernel.camera.direction(x[k], y[k]));
            }
            rays.o = splat3(kernel.camera.eye);
            rays.t_max = [f32::INFINITY; LANES];
            rays.from = [NONE; LANES];
            self.paths.throughput[lanes.clone()].fill([1.0; N]);
            for (slot, i) in self.paths.slot[lanes.clone()].iter_mut().zip(lanes) {
                *slot = i as u32;
            }
        }
        self.paths.seal();
        self.stats.paths += self.paths.len as u64;
    }

    /// Pixels and points of all slots; their number is that of the paths.
    #[inline(always)]
    fn place<const M: usize>(
        &mut self,
        kernel: &Kernel<'_, N, S>,
        tile: &TileMut<'_, M>,
        samples: Samples,
    ) {
        let replicates = kernel.replicates;
        let pixels = tile.pixels().len();
        for (slot, (x, y)) in tile.pixels().enumerate() {
            (self.corner[0][slot], self.corner[1][slot]) = (x as f32, y as f32);
            // wraps for pictures of 2^32 / replicates pixels and more, whose ends then share scrambles
            self.stream[slot] =
                (y.wrapping_mul(kernel.width).wrapping_add(x)).wrapping_mul(replicates);
        }
        // the first sample last: the others are made of its slots
        for i in (0..samples.count).rev() {
            let sample = samples.first + i;
            let first = i as usize * pixels;
            for corner in &mut self.corner {
                corner.copy_within(..pixels, first);
            }
            self.stream.copy_within(..pixels, first);
            for stream in &mut self.stream[first..first + pixels] {
                *stream = stream.wrapping_add(sample % replicates);
            }
            self.index[first..first + pixels].fill(sample / replicates);
        }
        self.paths.len = samples.count as usize * pixels;
    }

    /// Adds the light that rays met, and sorts the paths that go on by material.
    #[inline(always)]
    fn meet(&mut self, kernel: &Kernel<'_, N, S>, depth: u32) {
        let met = match &kernel.scene.geometry.bvh {
            None => self.look_up(kernel, depth, |side| side),
            Some(_) => self.look_up(kernel, depth, |side| kernel.side(side)),
        };
        if depth == 0 || kernel.count_met {
            for n in 0..met {
                self.meet_light(kernel, depth, self.met[n] as usize);
            }
        }
        if kernel.scene.materials.len() <= FEW {
            self.order_few();
        } else {
            self.order_many();
        }
    }

    /// What each path met: its bucket, and which met a light; how many these are. `of` finds the entry of
    /// [`Kernel::sides`] from twice the primitive and its back.
    #[inline(always)]
    fn look_up(&mut self, kernel: &Kernel<'_, N, S>, depth: u32, of: impl Fn(u64) -> u64) -> usize {
        let end = kernel.scene.materials.len() as u32;
        let last = depth == kernel.max_depth;
        let sides = &kernel.sides[..];
        let nothing = sides.len() - 1;
        let bucket = &mut self.bucket[..self.paths.len];
        let met = &mut self.met[..bucket.len()];
        let mut count = 0;
        for (block, (bucket, hits)) in bucket.chunks_mut(LANES).zip(&self.hits).enumerate() {
            for (k, bucket) in bucket.iter_mut().enumerate() {
                // NONE, doubled, is beyond all sides
                let side = 2 * u64::from(hits.prim[k]) + u64::from(hits.back[k]);
                let code = sides[of(side).min(nothing as u64) as usize];
                *bucket = if last { end } else { code & !SHINES };
                if let Some(next) = met.get_mut(count) {
                    *next = (block * LANES + k) as u32;
                }
                count += usize::from(code & SHINES != 0);
            }
        }
        count
    }

    /// One pass a material: no count waits for the one stored before it.
    #[inline(always)]
    fn order_few(&mut self) {
        let bucket = &self.bucket[..self.paths.len];
        let order = &mut self.order[..bucket.len()];
        let mut at = 0;
        // the last bucket holds paths that end
        let materials = self.ends.len() - 1;
        for (material, end) in self.ends[..materials].iter_mut().enumerate() {
            for (i, own) in bucket.iter().enumerate() {
                // none to spare once all are placed
                if let Some(next) = order.get_mut(at) {
                    *next = i as u32;
                }
                at += usize::from(*own == material as u32);
            }
            *end = at;
        }
    }

    /// Counting sort.
    #[inline(never)]
    fn order_many(&mut self) {
        let bucket = &self.bucket[..self.paths.len];
        self.ends.fill(0);
        for own in bucket {
            self.ends[*own as usize] += 1;
        }
        let mut sum = 0;
        for end in &mut self.ends {
            let count = *end;
            *end = sum;
            sum += count;
        }
        for (i, own) in bucket.iter().enumerate() {
            let at = &mut self.ends[*own as usize];
            self.order[*at] = i as u32;
            *at += 1;
        }
    }

    /// Adds the light that path `i` met.
    #[inline(always)]
    fn meet_light(&mut self, kernel: &Kernel<'_, N, S>, depth: u32, i: usize) {
        let scene = kernel.scene;
        let (rays, hits, k) = (
            &self.paths.rays[i / LANES],
            &self.hits[i / LANES],
            i % LANES,
        );
        let (o, d, prim) = (rays.o.get(k), rays.d.get(k), hits.prim[k]);
        let light = if prim == NONE {
            scene.environment.unwrap_or(NONE)
        } else {
            scene.surfaces[scene.geometry.object(prim) as usize].light
        };
        let index = light as usize;
        let Some(light) = kernel.lights.lights.get(index) else {
            return;
        };
        let weight = if depth > 0 && kernel.weigh {
            let pdf = self.paths.pdf[i];
            let other = kernel.candidates as f32
                * kernel.lights.probability(index, o)
                * light.pdf(o, d, hits.t[k], || scene.geometry.flat_normal(prim));
            // written so that an infinite density of the material gives one
            1.0 / (1.0 + other / pdf)
        } else {
            1.0
        };
        let slot = self.paths.slot[i] as usize;
        let radiance = light.radiance(d, S::Tag::of(&self.tag, slot));
        let slot = &mut self.slots[slot];
        for c in 0..N {
            slot[c] += self.paths.throughput[i][c] * radiance[c] * weight;
        }
    }

    /// Gathers the vertices `order[range]` into blocks with random numbers and points on lights; how many blocks.
    #[inline(always)]
    fn prepare(
        &mut self,
        kernel: &Kernel<'_, N, S>,
        depth: u32,
        range: std::ops::Range<usize>,
    ) -> usize {
        let dimension = Kernel::<N, S>::dimension;
        let mut blocks = 0;
        for which in self.order[range].chunks(LANES) {
            let vertex = &mut self.vertices[blocks];
            vertex.gather(&kernel.scene.geometry, &self.paths, &self.hits, which);
            let stream = vertex.slot.map(|s| self.stream[s as usize]);
            let index = vertex.slot.map(|s| self.index[s as usize]);
            let tag = vertex.slot.map(|s| S::Tag::of(&self.tag, s as usize));
            let sampling = &mut self.samples[blocks];
            sampling.tag = tag;
            sampling.wo = vertex.wo;
            sampling.u = kernel.points.get2_lanes(stream, index, dimension(depth, 0));
            blocks += 1;
        }
        if kernel.ask_lights {
            for block in 0..blocks {
                self.propose(kernel, depth, block);
            }
        }
        blocks
    }

    /// Points on lights for one block of vertices.
    #[inline(always)]
    fn propose(&mut self, kernel: &Kernel<'_, N, S>, depth: u32, block: usize) {
        let dimension = Kernel::<N, S>::dimension;
        let m = kernel.candidates;
        let vertex = &self.vertices[block];
        let stream = vertex.slot.map(|s| self.stream[s as usize]);
        let index = vertex.slot.map(|s| self.index[s as usize]);
        let tag = vertex.slot.map(|s| self.tag[s as usize]);
        for j in 0..m {
            // M points in a row of the sequence are even among themselves
            let index = index.map(|i| i.wrapping_mul(m as u32).wrapping_add(j as u32));
            let on_light = kernel.points.get2_lanes(stream, index, dimension(depth, 1));
            let choice = if kernel.lights.several() {
                let at = dimension(depth, 2);
                std::array::from_fn(|k| kernel.points.get1(stream[k], index[k], at))
            } else {
                [0.0; LANES]
            };
            let light = &mut self.lights[block * m + j];
            let u = (&choice, &on_light);
            kernel.lights.sample(&vertex.o, u, &tag, light);
            let eval = &mut self.evals[block * m + j];
            eval.tag = tag;
            eval.wo = vertex.wo;
            eval.wi = vertex.locals(&light.wi);
        }
    }

    /// The two virtual calls.
    fn ask(&mut self, kernel: &Kernel<'_, N, S>, material: usize, blocks: usize) {
        let material = &kernel.scene.materials[material];
        if kernel.ask_lights {
            material.eval(&mut self.evals[..blocks * kernel.candidates]);
        }
        material.sample(&mut self.samples[..blocks]);
    }

    /// Makes shadow rays and new rays of what the material said.
    #[inline(always)]
    fn advance(&mut self, kernel: &Kernel<'_, N, S>, depth: u32, blocks: usize) {
        for block in 0..blocks {
            if kernel.ask_lights {
                self.advance_shadows(kernel, depth, block);
            }
            let (vertex, s) = (&self.vertices[block], &self.samples[block]);
            let mut throughput = [[0.0; LANES]; N];
            for c in 0..N {
                for k in 0..LANES {
                    throughput[c][k] = vertex.throughput[c][k] * s.weight[c][k];
                }
            }
            let d = vertex.worlds(&s.wi);
            let mut keep = lasts(&throughput, FAINT);
            for k in 0..LANES {
                keep[k] &= u32::from(s.pdf[k] > 0.0);
            }
            if kernel.scene.smooth {
                vertex.drop_below(&d, &mut keep);
            }
            if depth + 1 >= kernel.roulette {
                self.roulette(kernel, depth, block, &mut throughput, &mut keep);
            }
            let (vertex, s) = (&self.vertices[block], &self.samples[block]);
            for k in 0..vertex.count {
                let path = PathState {
                    o: vertex.o.get(k),
                    d: d.get(k),
                    from: vertex.from[k],
                    slot: vertex.slot[k],
                    pdf: s.pdf[k],
                    throughput: std::array::from_fn(|c| throughput[c][k]),
                };
                self.next.push(&path, keep[k] != 0);
            }
        }
    }

    /// Ends weak paths by chance and strengthens those that survive.
    #[inline(never)]
    fn roulette(
        &self,
        kernel: &Kernel<'_, N, S>,
        depth: u32,
        block: usize,
        throughput: &mut [F; N],
        keep: &mut U,
    ) {
        let vertex = &self.vertices[block];
        for k in 0..vertex.count {
            if keep[k] == 0 {
                continue;
            }
            let slot = vertex.slot[k] as usize;
            let most = throughput.iter().fold(0.0_f32, |m, c| m.max(c[k].abs()));
            let survive = most.min(1.0);
            if kernel.chance(self.stream[slot], self.index[slot], depth) >= survive {
                keep[k] = 0;
            }
            for channel in throughput.iter_mut() {
                channel[k] /= survive;
            }
        }
    }

    /// Shadow rays of one block, weighed by the balance heuristic.
    #[inline(always)]
    fn advance_shadows(&mut self, kernel: &Kernel<'_, N, S>, depth: u32, block: usize) {
        if kernel.candidates > 1 {
            self.advance_chosen(kernel, depth, block);
            return;
        }
        let (vertex, eval, light) = (
            &self.vertices[block],
            &self.evals[block],
            &self.lights[block],
        );
        let mut weight = [0.0; LANES];
        for k in 0..LANES {
            let found_by_material = if kernel.weigh {
                light.shared[k] * eval.pdf[k]
            } else {
                0.0
            };
            weight[k] = 1.0 / (light.pdf[k] + found_by_material);
        }
        let mut carried = [[0.0; LANES]; N];
        for c in 0..N {
            for k in 0..LANES {
                let f_cos = vertex.throughput[c][k] * eval.f_cos[c][k];
                carried[c][k] = f_cos * light.radiance[c][k] * weight[k];
            }
        }
        let mut keep = lasts(&carried, f32::MIN_POSITIVE);
        for k in 0..LANES {
            keep[k] &= u32::from((light.pdf[k] > 0.0) & (eval.wi.z[k] > 0.0));
        }
        self.send(kernel, block, [block; LANES], &carried, &mut keep);
    }

    /// The same for the candidate of each lane that resampling chooses.
    #[inline(always)]
    fn advance_chosen(&mut self, kernel: &Kernel<'_, N, S>, depth: u32, block: usize) {
        let m = kernel.candidates;
        let all = block * m..(block + 1) * m;
        let vertex = &self.vertices[block];
        let at = Kernel::<N, S>::dimension(depth, 1);
        let u = std::array::from_fn(|k| {
            let slot = vertex.slot[k] as usize;
            kernel.points.get1(self.stream[slot], self.index[slot], at)
        });
        let chosen = ris::choose(
            &vertex.throughput,
            &self.evals[all.clone()],
            &self.lights[all.clone()],
            &u,
            kernel.weigh,
        );
        let mut keep = lasts(&chosen.carried, f32::MIN_POSITIVE);
        let from = chosen.candidate.map(|j| all.start + j);
        self.send(kernel, block, from, &chosen.carried, &mut keep);
    }

    /// Sends the shadow rays of one block toward lanes of the lights `from`.
    #[inline(always)]
    fn send(
        &mut self,
        kernel: &Kernel<'_, N, S>,
        block: usize,
        from: [usize; LANES],
        carried: &[F; N],
        keep: &mut U,
    ) {
        let vertex = &self.vertices[block];
        let mut wi = Lanes3::ZERO;
        for k in 0..LANES {
            wi.set(k, self.lights[from[k]].wi.get(k));
        }
        if kernel.scene.smooth {
            vertex.drop_below(&wi, keep);
        }
        for k in 0..vertex.count {
            let light = &self.lights[from[k]];
            let path = PathState {
                o: vertex.o.get(k),
                d: wi.get(k),
                from: vertex.from[k],
                slot: vertex.slot[k],
                pdf: 0.0,
                throughput: std::array::from_fn(|c| carried[c][k]),
            };
            let t_max = light.distance[k] * NEARLY;
            self.shadows.push(&path, t_max, light.prim[k], keep[k] != 0);
        }
    }

    /// Adds what shadow rays carry where the way is free.
    #[inline(always)]
    fn trace_shadows(&mut self, kernel: &Kernel<'_, N, S>) {
        self.shadows.seal();
        let shadows = &self.shadows;
        for block in 0..shadows.len.div_ceil(LANES) {
            let blocked = kernel
                .scene
                .geometry
                .blocked(&shadows.rays[block], &shadows.target[block]);
            let first = block * LANES;
            for k in 0..LANES.min(shadows.len - first) {
                let slot = &mut self.slots[shadows.slot[first + k] as usize];
                let free = if blocked[k] == 0 { 1.0 } else { 0.0 };
                for c in 0..N {
                    slot[c] += shadows.light[first + k][c] * free;
                }
            }
        }
        self.stats.shadow_rays += shadows.len as u64;
        self.shadows.len = 0;
    }

    /// Adds the slots to the tile, in their order.
    #[inline(always)]
    fn finish<const M: usize>(&self, mode: &S, tile: &mut TileMut<'_, M>, samples: Samples)
    where
        S: Develop<N, M>,
    {
        let pixels = tile.pixels().len();
        tile.add(samples.first, samples.count, |sample, pixel| {
            let slot = sample as usize * pixels + pixel;
            mode.develop(S::Tag::of(&self.tag, slot), &self.slots[slot])
        });
    }
}

/// 1 in each lane in which more than `least` is left to carry: not infinite, not NaN.
#[inline(always)]
fn lasts<const N: usize>(values: &[F; N], least: f32) -> U {
    let mut sum = [0.0; LANES];
    for channel in values {
        for k in 0..LANES {
            sum[k] += channel[k].abs();
        }
    }
    std::array::from_fn(|k| u32::from((sum[k] > least) & (sum[k] < f32::INFINITY)))
}

/// A slice of [`LANES`] values as an array.
#[inline(always)]
fn lanes_of<T: Copy>(values: &[T]) -> [T; LANES] {
    std::array::from_fn(|k| values[k])
}
