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
        for k in 0..LANES {
            let i = which[k.min(last)] as usize;
            let (block, lane) = (i / LANES, i % LANES);
            let rays = &paths.rays[block];
            let (o, d) = (rays.o.get(lane), rays.d.get(lane));
            let (t, prim) = (hits[block].t[lane], hits[block].prim[lane]);
            let at = geometry.point(prim, o, d, t);
            let back = d.dot(at.normal) > 0.0;
            let side = if back { -1.0 } else { 1.0 };
            let g = at.normal * side;
            let n = at.shading * side;
            // a shading normal that looks away from the viewer can't serve
            let n = if n.dot(d) < 0.0 { n } else { g };
            self.o.set(k, at.p + g * at.error);
            self.g.set(k, g);
            self.n.set(k, n);
            self.wo.set(k, -d);
            self.from[k] = 2 * prim + u32::from(back);
            self.slot[k] = paths.slot[i];
            for c in 0..N {
                self.throughput[c][k] = paths.throughput[i][c];
            }
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

    /// A world direction in the frame of lane `k`.
    #[inline(always)]
    pub(crate) fn local(&self, k: usize, w: Vec3) -> Vec3 {
        Vec3::new(
            w.dot(self.s.get(k)),
            w.dot(self.t.get(k)),
            w.dot(self.n.get(k)),
        )
    }

    /// A direction of the frame of lane `k` in the world.
    #[inline(always)]
    pub(crate) fn world(&self, k: usize, w: Vec3) -> Vec3 {
        self.s.get(k) * w.x + self.t.get(k) * w.y + self.n.get(k) * w.z
    }
}
