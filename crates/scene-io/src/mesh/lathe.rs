//! Surfaces of revolution about the y axis, with smooth normals.

use super::triangles::Triangles;
use crate::error::Error;
use glam::{DVec2, DVec3};
use std::f64::consts::TAU;

/// Curve points between two neighbouring profile points.
const STEPS: usize = 16;

/// A sphere as triangles: `segments` around the equator, half as many from pole to pole (at least 2).
///
/// 256 segments give 65,024 triangles. Corners lie on the sphere, normals are those of the sphere.
///
/// # Errors
/// If nothing with an area is left, as for a radius that vanishes in f32.
pub fn uv_sphere(center: DVec3, radius: f64, segments: usize) -> Result<Triangles, Error> {
    let rings = (segments / 2).max(2);
    let curve: Vec<Station> = (0..=rings)
        .map(|k| {
            // exactly zero at both poles, so that their triangles close
            let pole = k == 0 || k == rings;
            let (sin, cos) = (k as f64 / rings as f64 * TAU / 2.0).sin_cos();
            let out = DVec2::new(if pole { 0.0 } else { sin }, -cos);
            Station {
                at: out * radius,
                normal: out,
            }
        })
        .collect();
    revolve(&curve, segments, center)
}

/// A smooth curve (Catmull-Rom) through `profile`, points of (radius, height) from bottom to top, turned
/// about the y axis; the front is on the outside. A radius of 0 at an end closes it.
///
/// # Errors
/// If nothing with an area is left.
pub fn lathe(profile: &[DVec2], segments: usize) -> Result<Triangles, Error> {
    let last = profile.len().saturating_sub(1);
    let mut curve = Vec::new();
    for k in 0..last {
        let steps = if k + 1 == last { STEPS + 1 } else { STEPS };
        for s in 0..steps {
            curve.push(station(profile, k, s as f64 / STEPS as f64));
        }
    }
    revolve(&curve, segments, DVec3::ZERO)
}

/// One point of the profile curve and the outward normal in its plane.
struct Station {
    at: DVec2,
    normal: DVec2,
}

fn station(profile: &[DVec2], k: usize, t: f64) -> Station {
    let last = profile.len() - 1;
    let (p1, p2) = (profile[k], profile[k + 1]);
    // End points are mirrored, which makes the curve leave them along their chord; on the axis the mirror
    // image is across the axis, which makes a closed end round.
    let beyond = |end: DVec2, next: DVec2| {
        if end.x > 0.0 {
            end * 2.0 - next
        } else {
            DVec2::new(-next.x, next.y)
        }
    };
    let p0 = if k == 0 {
        beyond(p1, p2)
    } else {
        profile[k - 1]
    };
    let p3 = if k + 1 == last {
        beyond(p2, p1)
    } else {
        profile[k + 2]
    };
    let (m1, m2) = ((p2 - p0) * 0.5, (p3 - p1) * 0.5);
    let (t2, t3) = (t * t, t * t * t);
    let at = p1 * (2.0 * t3 - 3.0 * t2 + 1.0)
        + m1 * (t3 - 2.0 * t2 + t)
        + p2 * (3.0 * t2 - 2.0 * t3)
        + m2 * (t3 - t2);
    let tangent = p1 * (6.0 * t2 - 6.0 * t)
        + m1 * (3.0 * t2 - 4.0 * t + 1.0)
        + p2 * (6.0 * t - 6.0 * t2)
        + m2 * (3.0 * t2 - 2.0 * t);
    Station {
        at: DVec2::new(at.x.max(0.0), at.y),
        normal: DVec2::new(tangent.y, -tangent.x).normalize_or(DVec2::X),
    }
}

fn revolve(curve: &[Station], segments: usize, center: DVec3) -> Result<Triangles, Error> {
    let mut out = Triangles::default();
    let mut normals = Vec::new();
    for station in curve {
        for j in 0..segments {
            let (sin, cos) = (j as f64 / segments as f64 * TAU).sin_cos();
            let turn = |v: DVec2| DVec3::new(v.x * cos, v.y, v.x * sin);
            out.positions.push((center + turn(station.at)).as_vec3());
            normals.push(turn(station.normal).as_vec3());
        }
    }
    out.normals = Some(normals);
    let index = |i: usize, j: usize| (i * segments + j % segments) as u32;
    for i in 1..curve.len() {
        for j in 0..segments {
            let (a, b) = (index(i - 1, j), index(i - 1, j + 1));
            let (c, d) = (index(i, j + 1), index(i, j));
            // one triangle where the other would be a line: at the axis
            if curve[i - 1].at.x > 0.0 {
                out.triangles.push([a, c, b]);
            }
            if curve[i].at.x > 0.0 {
                out.triangles.push([a, d, c]);
            }
        }
    }
    out.checked()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    #[test]
    fn the_sphere_of_the_benchmark_has_65_thousand_triangles_facing_outward() {
        let centre = DVec3::new(0.0, 1.0, 0.0);
        let mesh = uv_sphere(centre, 1.0, 256).unwrap();
        assert_eq!(mesh.triangles.len(), 65_024);
        assert_eq!(mesh.dropped, 0);
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize] - centre.as_vec3());
            let outward = (b - a).cross(c - a).dot(a + b + c);
            assert!(outward > 0.0, "{t:?} faces inward");
        }
    }

    #[test]
    fn a_closed_lathe_encloses_a_positive_volume() {
        let profile = [(0.0, 0.0), (1.0, 0.5), (0.6, 1.5), (0.0, 2.0)].map(DVec2::from);
        let mesh = lathe(&profile, 64).unwrap();
        let corner = |i: u32| mesh.positions[i as usize];
        let volume: f32 = mesh
            .triangles
            .iter()
            .map(|t| corner(t[0]).dot(corner(t[1]).cross(corner(t[2]))) / 6.0)
            .sum();
        assert!(volume > 1.0, "{volume}");
        let normals: &[Vec3] = mesh.normals.as_deref().unwrap();
        for t in &mesh.triangles {
            let flat = (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]));
            assert!(
                flat.dot(normals[t[0] as usize]) > 0.0,
                "normal against {t:?}"
            );
        }
    }
}
