//! Tables that are all zero or zero but for one value, in every kind of interpolation.

use crate::case::Case;
use crate::grid::{in_f32, pairs};
use crate::tally::Tally;
use brdf::{Brdf, HalfDiff, LANES, Lanes3, Measured, Status};
use brdf_models::parse_model_n;
use brdf_sampling::{BakedHvt, Hvt, Preset, Target};
use brdf_table::{
    Gridded, GriddedN, HalfDiffTable, Interpolation, KdNearest, LayerMode, LayeredTable, PhiDomain,
    SampleCloud, ThinPlate,
};
use spectrum::{Basis, RgbSpace};
use std::sync::Arc;

/// What a table holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Content {
    /// Nothing but zeros.
    Zero,
    /// Zeros and one value of [`SPIKE`].
    Spike,
}

/// The one value: that of a mirror-like lobe.
pub(super) const SPIKE: f64 = 1e6;

/// Cells of grids.
const DIMS: [usize; 3] = [12, 9, 12];

/// A kind of table, by the type's name.
pub(super) struct Kind {
    pub(super) name: &'static str,
    pub(super) make: fn(Content) -> Option<Arc<dyn Measured>>,
}

/// All of them; a test compares the names with the source.
pub(super) const KINDS: &[Kind] = &[
    Kind {
        name: "Gridded nearest",
        make: |c| Some(gridded(c, PhiDomain::Reciprocal, Interpolation::Nearest)),
    },
    Kind {
        name: "Gridded linear",
        make: |c| Some(gridded(c, PhiDomain::Reciprocal, Interpolation::Linear)),
    },
    Kind {
        name: "Gridded linear full",
        make: |c| Some(gridded(c, PhiDomain::Full, Interpolation::Linear)),
    },
    Kind {
        name: "GriddedN linear",
        make: |c| Some(gridded(c, PhiDomain::Mirror, Interpolation::Linear)),
    },
    Kind {
        name: "LayeredTable nearest",
        make: |c| layered(c, LayerMode::Nearest),
    },
    Kind {
        name: "LayeredTable linear",
        make: |c| layered(c, LayerMode::Linear),
    },
    Kind {
        name: "LayeredTable squared",
        make: |c| layered(c, LayerMode::SquaredLambda),
    },
    Kind {
        name: "LayeredTable logarithmic",
        make: |c| layered(c, LayerMode::LogLinear),
    },
    Kind {
        name: "KdNearest",
        make: |c| Some(Arc::new(KdNearest::new(&cloud(c)?).ok()?)),
    },
    Kind {
        name: "ThinPlate",
        make: |c| Some(Arc::new(ThinPlate::new(&cloud(c)?).ok()?)),
    },
    Kind {
        name: "RglTable",
        make: |c| Some(super::rgl::table(c)?),
    },
];

pub(super) fn cases() -> Vec<Case> {
    let mut all: Vec<_> = KINDS
        .iter()
        .flat_map(|kind| {
            [Content::Zero, Content::Spike].map(|content| {
                let what = if content == Content::Zero {
                    "zero"
                } else {
                    "spike"
                };
                Case::new(
                    format!("table/{}/{what}", kind.name),
                    1e-6,
                    "zero is zero; no interpolation rises above the spike, f32 as it is stored",
                    move |effort, tally| bounded(kind, content, effort.pick(29, 3), tally),
                )
            })
        })
        .collect();
    all.push(Case::new(
        "table/BakedHvt/finite",
        0.0,
        "a density over a cosine: finite and not negative for black, a spike and a lobe of 1e-4",
        |effort, tally| baked(effort.pick(29, 3), tally),
    ));
    all.push(Case::new(
        "table/GriddedN/f32 lanes at a spike",
        1e-3,
        "f32 angles to 2e-7, between nodes a few hundredths apart, where the value falls from 1e6 to 0",
        |effort, tally| lanes(effort.pick(29, 1), tally),
    ));
    all
}

fn basis() -> Basis {
    Basis::Rgb(RgbSpace::srgb())
}

/// A table of a grid; the spike is one cell of theta_h and theta_d wide.
fn grid(content: Content, phi: PhiDomain) -> HalfDiffTable {
    HalfDiffTable::from_fn(DIMS, phi, basis(), move |wi, wo, out| {
        let at = HalfDiff::new(wi, wo);
        let near = (at.theta_h - 0.35).abs() < 0.12 && (at.theta_d - 0.5).abs() < 0.1;
        let here = content == Content::Spike && near && at.phi_d.abs() < 2.0;
        out.fill(if here { SPIKE } else { 0.0 });
        Status::Measured
    })
}

fn gridded(content: Content, phi: PhiDomain, interpolation: Interpolation) -> Arc<dyn Measured> {
    Arc::new(Gridded {
        table: Arc::new(grid(content, phi)),
        interpolation,
    })
}

/// Rows on rings, as Cornell's files have them.
fn cloud(content: Content) -> Option<SampleCloud> {
    let mut angles = Vec::new();
    for i in 1..=8 {
        for k in 0..8 {
            for j in 0..=8 {
                let deg = |d: i32| f64::from(d).to_radians();
                angles.push([deg(10 * i), 0.0, deg(10 * k + 1), deg(-20 * j)]);
            }
        }
    }
    let rows = angles.len();
    let values: Vec<f64> = (0..3 * rows)
        .map(|n| match content {
            Content::Spike if n / 3 == rows / 2 => SPIKE,
            _ => 0.0,
        })
        .collect();
    SampleCloud::new(basis(), &angles, &values).ok()
}

fn layered(content: Content, mode: LayerMode) -> Option<Arc<dyn Measured>> {
    Some(Arc::new(LayeredTable::new(&cloud(content)?, mode)))
}

fn bounded(kind: &Kind, content: Content, step: usize, tally: &mut Tally) {
    let Some(table) = (kind.make)(content) else {
        tally.error(f64::INFINITY, || "could not be built".into());
        return;
    };
    let mut out = vec![0.0; table.basis().len()];
    for (named, wo) in pairs(step) {
        table.eval_native(named.w, wo, &mut out);
        for &f in &out {
            let place = || format!("{}, wi {}, wo {wo}: {f:e}", named.what, named.w);
            // a smooth surface through a spike falls below zero beside it, by far less than the digits of a measurement
            if kind.name == "ThinPlate" && content == Content::Spike {
                tally.error((-f).max(f - SPIKE).max(0.0) / SPIKE, place);
                continue;
            }
            tally.sound(f, place);
            match content {
                Content::Zero => tally.error(f.abs(), place),
                // an RGL value is multiplied by the file's own normal distribution
                Content::Spike if kind.name == "RglTable" => {}
                Content::Spike => tally.error((f - SPIKE).max(0.0) / SPIKE, place),
            }
        }
    }
}

fn baked(step: usize, tally: &mut Tally) {
    for text in [
        "lambert:kd=0",
        "ggx:alpha=0.0001,f0=1",
        "phong:n=1000000,ks=1,kd=0",
    ] {
        let Ok(model) = parse_model_n::<1>(text) else {
            tally.error(f64::INFINITY, || text.into());
            continue;
        };
        let target = |i, o| model.built.brdf.eval(i, o)[0];
        let hvt = Hvt::new(Target::new(&target), Preset::Tiny.options());
        let baked = BakedHvt::<1>::new(&model.built.brdf, hvt);
        for (named, wo) in pairs(step) {
            for f in baked.eval(named.w, wo) {
                tally.sound(f, || {
                    format!("{text}, {}, wi {}, wo {wo}", named.what, named.w)
                });
            }
        }
    }
}

fn lanes(step: usize, tally: &mut Tally) {
    for how in [Interpolation::Nearest, Interpolation::Linear] {
        let table = Arc::new(grid(Content::Spike, PhiDomain::Mirror));
        let Ok(table) = GriddedN::<3>::new(table, how) else {
            tally.error(f64::INFINITY, || "could not be built".into());
            return;
        };
        for chunk in pairs(step).chunks(LANES) {
            let (mut wi, mut wo) = (Lanes3::ZERO, Lanes3::ZERO);
            for (k, (i, o)) in chunk.iter().enumerate() {
                wi.set(k, in_f32(i.w));
                wo.set(k, in_f32(*o));
            }
            let f = table.eval_lanes(&wi, &wo);
            for (k, (named, _)) in chunk.iter().enumerate() {
                let (i, o) = (wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                let place = || format!("{how:?}, {}, wi {i}, wo {o}", named.what);
                let exact = table.eval(i, o)[0];
                let value = f64::from(f[0][k]);
                if how == Interpolation::Linear {
                    tally.value(value, exact, SPIKE, place);
                } else {
                    // on the border of two cells either may answer
                    tally.sound(value, place);
                }
            }
        }
    }
}
