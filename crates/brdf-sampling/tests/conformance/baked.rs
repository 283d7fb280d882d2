//! `BakedHvt` as a reflectance: the albedo of its target for every channel, nothing below the horizon; and a wrong one
//! is found out.

use crate::quadrature::hemisphere;
use crate::{targets, viewer};
use brdf::{Brdf, direction};
use brdf_sampling::{BakedHvt, Hvt, Preset, Target};
use glam::DVec3;

/// A case as two channels, the second half as bright.
struct Two(targets::Case);

impl Brdf<2> for Two {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 2] {
        let above = wi.z > 0.0 && wo.z > 0.0;
        let f = if above { (self.0.f)(wi, wo) } else { 0.0 };
        [f, 0.5 * f]
    }
}

/// Albedo over that of the target, for one channel.
fn ratio(f: impl Fn(DVec3, DVec3) -> f64, target: &Two, channel: usize, theta: f64) -> f64 {
    let wo = viewer(theta);
    let albedo = |f: &dyn Fn(DVec3) -> f64| hemisphere(|wi| f(wi) * wi.z, wo, 0.02, [96, 40]);
    albedo(&|wi| f(wi, wo)) / albedo(&|wi| target.eval(wi, wo)[channel])
}

#[test]
fn baked_tables_keep_albedos() {
    for name in ["lambert", "ggx-0.3", "spiky"] {
        let mut cases = targets::all();
        cases.retain(|c| c.name == name);
        let target = Two(cases.remove(0));
        let luminance = |wi: DVec3, wo: DVec3| target.eval(wi, wo)[0];
        let table = Hvt::new(Target::new(&luminance), Preset::Default.options());
        let baked = BakedHvt::new(&target, table);
        for theta in [12.3, 47.0, 71.0] {
            for c in 0..2 {
                let found = ratio(|wi, wo| baked.eval(wi, wo)[c], &target, c, theta);
                // albedos are linear over a degree (over two it is 0.9 % here), and ridges cost either quadrature some 1e-3
                assert!((found - 1.0).abs() < 0.01, "{name}, {c}, {theta}: {found}");
            }
            // the cosine forgotten
            let wrong = ratio(|wi, wo| baked.eval(wi, wo)[0] * wi.z, &target, 0, theta);
            assert!((wrong - 1.0).abs() > 0.05, "{name} at {theta}: {wrong}");
        }
        let down = direction(2.0, 0.1);
        assert!(baked.eval(down, DVec3::Z)[0] <= 0.0, "light below");
        assert!(baked.eval(DVec3::Z, down)[0] <= 0.0, "viewer below");
    }
}
