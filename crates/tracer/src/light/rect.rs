//! The rectangle, sampled uniformly in the solid angle it is seen under [Urena2013].

use crate::math::{asin, sin_cos};
use glam::Vec3;

/// Below this solid angle the area is sampled instead: the four angles would cancel in single precision, and over so
/// small a light the two hardly differ.
const SMALL: f32 = 0.005;

/// A one-sided rectangle that shines.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RectLight {
    pub(crate) corner: Vec3,
    /// Unit edge directions and the front normal, x cross y.
    pub(crate) x: Vec3,
    pub(crate) y: Vec3,
    pub(crate) z: Vec3,
    /// Edge lengths.
    pub(crate) extent: [f32; 2],
}

/// A direction toward a light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Toward {
    /// Unit.
    pub(crate) wi: Vec3,
    pub(crate) distance: f32,
    /// Per solid angle; 0 = the light is not seen from here.
    pub(crate) pdf: f32,
}

/// The solid angle of a rectangle in the terms its sampling needs, symbols as in the paper.
struct Seen {
    x0: f32,
    x1: f32,
    y0: f32,
    y1: f32,
    /// Negative in front of the light.
    z0: f32,
    b0: f32,
    b1: f32,
    /// g2 + g3 - pi.
    a23: f32,
    solid_angle: f32,
}

impl RectLight {
    /// Corners of the box around it.
    pub(crate) fn bounds(&self) -> [Vec3; 2] {
        let (x, y) = (self.x * self.extent[0], self.y * self.extent[1]);
        let corners = [x, y, x + y].map(|to| self.corner + to);
        let low = corners.iter().fold(self.corner, |a, b| a.min(*b));
        let high = corners.iter().fold(self.corner, |a, b| a.max(*b));
        [low, high]
    }

    #[inline(always)]
    fn seen(&self, p: Vec3) -> Seen {
        let to = self.corner - p;
        let (x0, y0, z0) = (to.dot(self.x), to.dot(self.y), to.dot(self.z));
        let (x1, y1) = (x0 + self.extent[0], y0 + self.extent[1]);
        let z2 = z0 * z0;
        // z components of the normals of the four planes through p and an edge
        let n0 = -y0 / (z2 + y0 * y0).sqrt();
        let n1 = x1 / (z2 + x1 * x1).sqrt();
        let n2 = y1 / (z2 + y1 * y1).sqrt();
        let n3 = -x0 / (z2 + x0 * x0).sqrt();
        // inner angles less pi/2: their sum is the solid angle, without the 2 pi that would cancel
        let a23 = asin(n2 * n3) + asin(n3 * n0);
        Seen {
            x0,
            x1,
            y0,
            y1,
            z0,
            b0: n0,
            b1: n2,
            a23,
            solid_angle: asin(n0 * n1) + asin(n1 * n2) + a23,
        }
    }

    /// Density of the direction to local point (x, y, z0) at squared distance `d2`.
    #[inline(always)]
    fn density(&self, seen: &Seen, d2: f32) -> f32 {
        let by_area = d2 * d2.sqrt() / (self.extent[0] * self.extent[1] * -seen.z0);
        let pdf = if seen.solid_angle < SMALL {
            by_area
        } else {
            1.0 / seen.solid_angle
        };
        if seen.z0 < 0.0 { pdf } else { 0.0 }
    }

    /// A point of the light as seen from `p`.
    #[inline(always)]
    pub(crate) fn sample(&self, p: Vec3, u: f32, v: f32) -> Toward {
        let s = self.seen(p);
        let (sin, cos) = sin_cos(u * s.solid_angle - s.a23);
        let fu = (cos * s.b0 + s.b1) / sin;
        // cu / sqrt(1 - cu^2) = sign(fu) / sqrt(fu^2 + b0^2 - 1), where b0^2 - 1 = -z0^2 / (z0^2 + y0^2)
        let z2 = s.z0 * s.z0;
        let under = (fu * fu - z2 / (z2 + s.y0 * s.y0)).max(1e-30);
        let xu = (-s.z0 / under.sqrt()).copysign(fu);
        let small = s.solid_angle < SMALL;
        let xu = if small { s.x0 + u * self.extent[0] } else { xu };
        let xu = xu.max(s.x0).min(s.x1);
        let d2 = xu * xu + z2;
        let h0 = s.y0 / (d2 + s.y0 * s.y0).sqrt();
        let h1 = s.y1 / (d2 + s.y1 * s.y1).sqrt();
        let hv = h0 + v * (h1 - h0);
        let yv = hv * (d2 / (1.0 - hv * hv).max(1e-12)).sqrt();
        let yv = if small { s.y0 + v * self.extent[1] } else { yv };
        let yv = yv.max(s.y0).min(s.y1);
        let r2 = d2 + yv * yv;
        let inv = 1.0 / r2.sqrt();
        Toward {
            wi: (self.x * xu + self.y * yv + self.z * s.z0) * inv,
            distance: r2 * inv,
            pdf: self.density(&s, r2),
        }
    }

    /// Density of [`Self::sample`] for the point of the light at `distance` from `p`.
    #[inline(always)]
    pub(crate) fn pdf(&self, p: Vec3, distance: f32) -> f32 {
        self.density(&self.seen(p), distance * distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn light(corner: Vec3, extent: [f32; 2]) -> RectLight {
        RectLight {
            corner,
            x: Vec3::X,
            y: Vec3::Y,
            z: Vec3::Z,
            extent,
        }
    }

    /// Solid angle by a fine midpoint rule in double precision.
    fn solid_angle(l: &RectLight, p: Vec3) -> f64 {
        let (n, mut sum) = (400, 0.0);
        for i in 0..n * n {
            let (i, j) = (f64::from(i % n) + 0.5, f64::from(i / n) + 0.5);
            let q = l.corner.as_dvec3()
                + glam::DVec3::X * (i / f64::from(n) * f64::from(l.extent[0]))
                + glam::DVec3::Y * (j / f64::from(n) * f64::from(l.extent[1]))
                - p.as_dvec3();
            sum += -q.z / q.length().powi(3);
        }
        sum * f64::from(l.extent[0] * l.extent[1]) / f64::from(n * n)
    }

    #[test]
    fn density_is_one_over_the_solid_angle_near_and_far() {
        let cases = [
            (Vec3::new(0.0, 0.0, 1.0), 1e-4),
            (Vec3::new(0.5, 0.2, 0.3), 1e-4),
            (Vec3::new(-3.0, 5.0, 2.0), 1e-4),
            // f32 leaves the sum of four angles an absolute error of about 3e-7
            (Vec3::new(-9.0, 3.0, 3.0), 2e-4),
        ];
        for (p, tolerance) in cases {
            let l = light(Vec3::new(-1.0, -0.5, 0.0), [2.0, 1.0]);
            let exact = solid_angle(&l, p);
            let ours = l.seen(p).solid_angle;
            let error = (f64::from(ours) / exact - 1.0).abs();
            assert!(error < tolerance, "from {p}: {ours} for {exact}");
        }
    }

    #[test]
    fn mean_of_one_over_pdf_is_the_solid_angle_when_the_area_is_sampled() {
        let l = light(Vec3::new(-1.0, -0.5, 0.0), [2.0, 1.0]);
        let p = Vec3::new(20.0, 10.0, 25.0);
        let n = 64;
        let mut sum = 0.0;
        for i in 0..n * n {
            let (u, v) = ((i % n) as f32 + 0.5, (i / n) as f32 + 0.5);
            sum += 1.0 / f64::from(l.sample(p, u / n as f32, v / n as f32).pdf);
        }
        let error = sum / f64::from(n * n) / solid_angle(&l, p) - 1.0;
        assert!(error.abs() < 1e-4, "relative error {error}");
    }

    #[test]
    fn samples_lie_on_the_light_and_share_its_solid_angle_evenly() {
        let l = light(Vec3::new(-1.0, -0.5, 0.0), [2.0, 1.0]);
        let p = Vec3::new(0.7, 0.3, 0.4);
        let whole = solid_angle(&l, p);
        let n = 64;
        let mut left = 0;
        for i in 0..n * n {
            let (u, v) = ((i % n) as f32 + 0.5, (i / n) as f32 + 0.5);
            let s = l.sample(p, u / n as f32, v / n as f32);
            let q = p + s.wi * s.distance;
            assert!(q.z.abs() < 1e-5, "in the plane: {q}");
            assert!(
                q.x.abs() < 1.0001 && q.y.abs() < 0.5001,
                "inside the edges: {q}"
            );
            left += i32::from(q.x < 0.0);
        }
        let half = light(l.corner, [1.0, 1.0]);
        let expected = solid_angle(&half, p) / whole;
        let share = f64::from(left) / f64::from(n * n);
        // one row of the 64 x 64 grid may fall on either side
        assert!(
            (share - expected).abs() < 1.5 / 64.0,
            "{share} for {expected}"
        );
    }

    #[test]
    fn the_back_is_dark() {
        let l = light(Vec3::new(-1.0, -0.5, 0.0), [2.0, 1.0]);
        for p in [Vec3::new(0.0, 0.0, -1.0), Vec3::new(3.0, 0.0, 0.0)] {
            let s = l.sample(p, 0.3, 0.6);
            assert!(s.pdf.abs() == 0.0, "from {p}: {}", s.pdf);
            assert!(l.pdf(p, 1.0).abs() == 0.0, "pdf from {p}");
        }
    }
}
