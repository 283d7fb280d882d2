//! Scattering vertices of one material, [`LANES`] to a block: gathered once, dense from there on.

use crate::geometry::Geometry;
use crate::math::{F, U, tangents};
use crate::path::{HitLanes, Paths};
use brdf::{LANES, Lanes3};
use glam::Vec3;

/// Where and with what [`LANES`] paths scatter.
#[derive(Clone, Debug)]
pub(crate) struct VertexLanes<const N: usize> {
    /// Hit point, lifted off the surface on the viewer's side: where new rays start.
    pub(crate) o: Lanes3,
    /// Shading frame: tangents and the normal on the viewer's side.
    pub(crate) s: Lanes3,
    pub(crate) t: Lanes3,
    pub(crate) n: Lanes3,
    /// Geometric normal on the viewer's side.
    pub(crate) g: Lanes3,
    /// Toward the viewer in the shading frame.
    pub(crate) wo: Lanes3,
    /// [`crate::path::RayLanes::from`] of new rays.
    pub(crate) from: U,
    pub(crate) slot: U,
    pub(crate) throughput: [F; N],
    /// Lanes in use.
    pub(crate) count: usize,
}

impl<const N: usize> VertexLanes<N> {
    pub(crate) const EMPTY: Self = Self {
        o: Lanes3::ZERO,
        s: Lanes3::ZERO,
        t: Lanes3::ZERO,
        n: Lanes3::ZERO,
        g: Lanes3::ZERO,
        wo: Lanes3::ZERO,
        from: [0; LANES],
        slot: [0; LANES],
        throughput: [[0.0; LANES]; N],
        count: 0,
    };

    /// Fills the block for the paths `which`, at most [`LANES`] and at least one; spare lanes repeat the last.
    #[inline(always)]
    pub(crate) fn gather(
        &mut self,
        geometry: &Geometry,
        paths: &Paths<N>,
        hits: &[HitLanes],
        which: &[u32],
    ) {
        self.count = which.len();
        let last = which.len() - 1;
        let (mut o, mut d) = (Lanes3::ZERO, Lanes3::ZERO);
        let (mut t, mut prim) = ([0.0; LANES], [0; LANES]);
        for k in 0..LANES {
            let i = which[k.min(last)] as usize;
            let (block, lane) = (i / LANES, i % LANES);
            let (rays, hits) = (&paths.rays[block], &hits[block]);
            o.set(k, rays.o.get(lane));
            d.set(k, rays.d.get(lane));
            (t[k], prim[k]) = (hits.t[lane], hits.prim[lane]);
            self.slot[k] = paths.slot[i];
            let throughput = paths.throughput[i];
            for c in 0..N {
                self.throughput[c][k] = throughput[c];
            }
        }
        let at = geometry.points(&prim, &o, &d, &t);
        for k in 0..LANES {
            let (dir, normal) = (d.get(k), at.normal.get(k));
            let back = normal.dot(dir) > 0.0;
            let side = if back { -1.0 } else { 1.0 };
            let g = normal * side;
            let n = at.shading.get(k) * side;
            // a shading normal that looks away from the viewer can't serve
            let n = if n.dot(dir) < 0.0 { n } else { g };
            self.o.set(k, at.p.get(k) + g * at.error[k]);
            self.g.set(k, g);
            self.n.set(k, n);
            self.wo.set(k, -dir);
            self.from[k] = 2 * prim[k] + u32::from(back);
        }
        self.frames();
    }

    /// Tangents, and `wo` into the frame.
    #[inline(always)]
    fn frames(&mut self) {
        for k in 0..LANES {
            let n = self.n.get(k);
            let (s, t) = tangents(n);
            self.s.set(k, s);
            self.t.set(k, t);
            let wo = self.wo.get(k);
            self.wo.set(k, Vec3::new(wo.dot(s), wo.dot(t), wo.dot(n)));
        }
    }

    /// World directions in the frames.
    #[inline(always)]
    pub(crate) fn locals(&self, w: &Lanes3) -> Lanes3 {
        let mut out = Lanes3::ZERO;
        for k in 0..LANES {
            let w = w.get(k);
            let (s, t, n) = (self.s.get(k), self.t.get(k), self.n.get(k));
            out.set(k, Vec3::new(w.dot(s), w.dot(t), w.dot(n)));
        }
        out
    }

    /// Directions of the frames in the world.
    #[inline(always)]
    pub(crate) fn worlds(&self, w: &Lanes3) -> Lanes3 {
        let mut out = Lanes3::ZERO;
        for k in 0..LANES {
            let (s, t, n) = (self.s.get(k), self.t.get(k), self.n.get(k));
            out.set(k, s * w.x[k] + t * w.y[k] + n * w.z[k]);
        }
        out
    }

    /// Clears the lanes of `keep` whose world direction leaves below the surface.
    #[inline(always)]
    pub(crate) fn drop_below(&self, d: &Lanes3, keep: &mut U) {
        for k in 0..LANES {
            keep[k] &= u32::from(d.get(k).dot(self.g.get(k)) > 0.0);
        }
    }
}
