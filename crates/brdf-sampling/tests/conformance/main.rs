//! Every sampler against every target: density, agreement of sample and pdf, support; and proof that a wrong
//! sampler is found out.

#![expect(clippy::unwrap_used, reason = "a test fails by panicking")]

mod agreement;
mod baked;
mod furnace;
mod integral;
mod listed;
mod quadrature;
mod rendering;
mod samplers;
mod table_kinds;
mod targets;
mod wrong;

use brdf::{DirectionSampler, direction};
use glam::{DVec2, DVec3};
use samplers::{ALL, Entry, may_waste};
use targets::Case;
use testkit::chi2;

/// Viewers: normal, between slices, close to grazing, and below the horizon of nobody.
const THETA_DEG: [f64; 4] = [0.0, 23.7, 61.3, 88.0];

fn viewer(theta_deg: f64) -> DVec3 {
    direction(theta_deg.to_radians(), 0.9)
}

pub(crate) fn chi_square(
    sampler: &dyn DirectionSampler,
    wo: DVec3,
    samples: usize,
    tests: usize,
) -> chi2::Chi2Report {
    let config = chi2::Config {
        samples,
        tests,
        ..chi2::Config::default()
    };
    chi2::test(
        &config,
        |rng| {
            let s = sampler.sample(wo, DVec2::from(rng.uniform2()))?;
            Some(s.wi.to_array())
        },
        |wi| sampler.pdf(DVec3::from(wi), wo),
    )
}

fn run_chi_square(entries: &[&Entry], cases: &[Case], angles: &[f64], samples: usize) {
    let tests = entries.len() * cases.len() * angles.len();
    let mut failed = Vec::new();
    for case in cases {
        for entry in entries {
            let Some(sampler) = (entry.build)(case) else {
                continue;
            };
            for &theta in angles {
                let report = chi_square(&*sampler, viewer(theta), samples, tests);
                if !report.ok {
                    failed.push(format!(
                        "{} on {} at {theta}: {report}",
                        entry.name, case.name
                    ));
                }
            }
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

#[test]
fn chi_square_of_every_sampler() {
    // the larger tables run in the slow tier: their cells take the time
    let entries: Vec<&Entry> = ALL.iter().filter(|e| !e.name.contains("default")).collect();
    let quick = ["lambert", "ggx-0.05", "spiky", "brushed", "black"];
    let mut cases = targets::all();
    cases.retain(|c| quick.contains(&c.name));
    run_chi_square(&entries, &cases, &[33.3], 3_000);
}

/// Straight from above the horizon of the chart is a full circle: rounding must not tear it.
#[test]
fn chi_square_at_the_normal() {
    let mut cases = targets::all();
    cases.retain(|c| c.name == "lambert");
    let tables = ["Inversion", "Hvt tiny", "Hvt default"];
    let entries: Vec<&Entry> = ALL.iter().filter(|e| tables.contains(&e.name)).collect();
    run_chi_square(&entries, &cases, &[0.0], 20_000);
}

#[test]
fn slow_chi_square_of_every_sampler_at_every_angle() {
    let entries: Vec<&Entry> = ALL.iter().collect();
    run_chi_square(&entries, &targets::all(), &THETA_DEG, 20_000);
}

/// One test, because building the samplers is what takes the time.
#[test]
fn every_sampler_keeps_its_promises() {
    for case in targets::all() {
        for entry in ALL {
            let Some(sampler) = (entry.build)(&case) else {
                continue;
            };
            let name = format!("{} on {}", entry.name, case.name);
            for theta in THETA_DEG {
                agreement(&*sampler, viewer(theta), &format!("{name} at {theta}"));
            }
            support(&*sampler, &case, &name);
            horizon(&*sampler, &name);
            extremes(&*sampler, &name);
        }
    }
}

/// The same density from sample and pdf; unit vectors above the horizon; nothing wasted.
fn agreement(sampler: &dyn DirectionSampler, wo: DVec3, name: &str) {
    let mut rng = testkit::Rng::new(3);
    let n = 2_000;
    let mut off = 0;
    for _ in 0..n {
        let s = sampler.sample(wo, DVec2::from(rng.uniform2()));
        let Some(s) = s else {
            assert!(may_waste(name), "{name}: sample wasted");
            continue;
        };
        assert!(s.wi.z > 0.0, "{name}: below the horizon {}", s.wi);
        assert!(
            (s.wi.length() - 1.0).abs() < 1e-9,
            "{name}: not unit {}",
            s.wi
        );
        assert!(s.pdf > 0.0 && s.pdf.is_finite(), "{name}: pdf {}", s.pdf);
        let pdf = sampler.pdf(s.wi, wo);
        off += usize::from((pdf / s.pdf - 1.0).abs() > 1e-6);
    }
    // piecewise constant tables differ where rounding crosses a cell; that is below one in 10^6
    assert!(off == 0, "{name}: {off} of {n} disagree by more than 1e-6");
}

/// A positive density wherever the target is positive.
fn support(sampler: &dyn DirectionSampler, case: &Case, name: &str) {
    let mut rng = testkit::Rng::new(4);
    for _ in 0..2_000 {
        let ([x, y], [z, w]) = (rng.uniform2(), rng.uniform2());
        let wi = direction((1.0 - x).acos(), 6.3 * y);
        let wo = direction((1.0 - z).acos().min(1.57), 6.3 * w);
        if (case.f)(wi, wo) > 0.0 {
            let pdf = sampler.pdf(wi, wo);
            assert!(pdf > 0.0 && pdf.is_finite(), "{name}: {pdf} at {wi}, {wo}");
        }
    }
}

/// Nothing below or at the horizon, on either side.
fn horizon(sampler: &dyn DirectionSampler, name: &str) {
    let (up, down) = (direction(0.4, 0.2), direction(2.0, 0.1));
    for wo in [down, DVec3::X] {
        let sample = sampler.sample(wo, DVec2::new(0.3, 0.6));
        assert!(sample.is_none(), "{name}: {wo}");
        assert!(sampler.pdf(up, wo) <= 0.0, "{name}: {wo}");
    }
    assert!(sampler.pdf(down, up) <= 0.0, "{name}: below");
}

/// No panic for any argument, and a sample for every legal one.
fn extremes(sampler: &dyn DirectionSampler, name: &str) {
    let views = [
        DVec3::Z,
        direction(1.5706, 1.0),
        DVec3::new(1.0, 0.0, 1e-30),
        DVec3::new(f64::NAN, 0.0, 0.5),
    ];
    let edges = [0.0, 0.5, 1.0 - f64::EPSILON, 1.0];
    for wo in views {
        for (x, y) in edges.into_iter().flat_map(|x| edges.map(|y| (x, y))) {
            let s = sampler.sample(wo, DVec2::new(x, y));
            if let Some(s) = s.filter(|_| wo.is_finite() && x < 1.0 && y < 1.0) {
                let sound = s.wi.is_finite() && s.pdf > 0.0;
                assert!(sound, "{name} {wo} {x} {y}: {s:?}");
            }
        }
    }
}
