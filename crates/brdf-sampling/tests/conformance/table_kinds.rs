//! One small table of every kind, made from a model whose truth is known: the list the furnace runs over.

use crate::targets::Case;
use brdf::{Brdf, Measured, Status};
use brdf_formats::{Dtype, RglFile, TensorField, write_tensor};
use brdf_measure::{Instrument, measure_astm, measure_merl};
use brdf_models::parse_model;
use brdf_table::scattered::Domain;
use brdf_table::{
    CellPolicy, Gridded, HalfDiffTable, Interpolation, KdNearest, LayerMode, LayeredTable,
    PhiDomain, RglTable, SampleCloud, ThinPlate, resample,
};
use glam::DVec3;
use spectrum::{Basis, RgbSpace};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;

/// What all tables are measurements of: gloss over a diffuse base.
const MODEL: &str = "ward:alpha=0.25,ks=0.2,kd=0.3";
/// Cells of grids: theta_h, theta_d, phi_d.
const DIMS: [usize; 3] = [24, 18, 24];

/// A kind of table; names begin with the type's.
pub(crate) struct TableKind {
    pub(crate) name: &'static str,
    make: fn() -> Made,
    /// How far the albedo may be from the model's: coarse grids, steps between neighbours.
    pub(crate) tolerance: f64,
    /// Microseconds a look-up: not for samplers that evaluate 10^6 times.
    pub(crate) costly: bool,
}

/// A table, and the sampler that comes with it.
enum Made {
    Plain(Arc<dyn Measured>),
    Rgl(Arc<RglTable>),
}

const fn kind(name: &'static str, tolerance: f64, costly: bool, make: fn() -> Made) -> TableKind {
    TableKind {
        name,
        make,
        tolerance,
        costly,
    }
}

/// All of them. `every_table_kind_and_its_own_sampler_are_listed` compares the names with the source.
pub(crate) const TABLES: &[TableKind] = &[
    kind("Gridded nearest reciprocal", 0.1, false, || {
        merl(Interpolation::Nearest)
    }),
    kind("Gridded linear reciprocal", 0.05, false, || {
        merl(Interpolation::Linear)
    }),
    kind("Gridded nearest mirror", 0.1, false, || {
        grid(PhiDomain::Mirror, Interpolation::Nearest)
    }),
    kind("Gridded linear mirror", 0.05, false, || {
        grid(PhiDomain::Mirror, Interpolation::Linear)
    }),
    kind("Gridded nearest full", 0.1, false, || {
        grid(PhiDomain::Full, Interpolation::Nearest)
    }),
    kind("Gridded linear full", 0.05, false, || {
        grid(PhiDomain::Full, Interpolation::Linear)
    }),
    kind("LayeredTable nearest", 0.3, true, || {
        layered(LayerMode::Nearest)
    }),
    kind("LayeredTable linear", 0.3, true, || {
        layered(LayerMode::Linear)
    }),
    kind("LayeredTable squared", 0.3, true, || {
        layered(LayerMode::SquaredLambda)
    }),
    kind("LayeredTable logarithmic", 0.3, true, || {
        layered(LayerMode::LogLinear)
    }),
    kind("KdNearest", 0.3, true, || {
        Made::Plain(Arc::new(KdNearest::new(&cloud()).unwrap()))
    }),
    kind("ThinPlate", 0.1, true, || {
        Made::Plain(Arc::new(ThinPlate::new(&cloud()).unwrap()))
    }),
    kind("Gridded resampled", 0.1, false, || {
        let cloud = cloud();
        let plate = ThinPlate::new(&cloud).unwrap();
        let resampled = resample(&plate, &Domain::new(&cloud), DIMS);
        linear(resampled.table)
    }),
    kind("RglTable", f64::INFINITY, false, || Made::Rgl(rgl_table())),
];

impl TableKind {
    /// The luminance of the table.
    pub(crate) fn build(&self) -> Case {
        match (self.make)() {
            Made::Plain(table) => luminance(self.name, table),
            Made::Rgl(table) => {
                let mut case = luminance(self.name, Arc::clone(&table) as Arc<dyn Measured>);
                case.own = Some(table);
                case
            }
        }
    }

    /// The model it was made of; files of their own have none.
    pub(crate) fn truth(&self) -> Option<Case> {
        let model = model();
        self.tolerance.is_finite().then(|| {
            Case::new(self.name, move |wi, wo| {
                let f = model.eval(wi, wo);
                (0..3).map(|c| spectrum::LUMINANCE_SRGB[c] * f[c]).sum()
            })
        })
    }
}

fn model() -> Arc<dyn Brdf<3>> {
    parse_model(MODEL).unwrap().built.brdf
}

fn luminance(name: &'static str, table: Arc<dyn Measured>) -> Case {
    let weights = table.basis().luminance_weights();
    let symmetry = table.symmetry();
    let mut case = Case::new(name, move |wi: DVec3, wo: DVec3| {
        let mut out = vec![0.0; weights.len()];
        table.eval_native(wi, wo, &mut out);
        out.iter().zip(&weights).map(|(v, w)| v * w).sum()
    });
    case.symmetry = symmetry;
    case
}

fn gridded(table: HalfDiffTable, interpolation: Interpolation) -> Made {
    Made::Plain(Arc::new(Gridded {
        table: Arc::new(table),
        interpolation,
    }))
}

fn linear(table: HalfDiffTable) -> Made {
    gridded(table, Interpolation::Linear)
}

/// Through the bytes of a MERL file.
fn merl(interpolation: Interpolation) -> Made {
    let dims = DIMS.map(|n| n as u32);
    let file = measure_merl(&*model(), dims, &Instrument::default(), 1).unwrap();
    let (table, _) = HalfDiffTable::from_merl(&file, CellPolicy::AnyNegative).unwrap();
    gridded(table, interpolation)
}

/// A grid of the given azimuth domain.
fn grid(phi: PhiDomain, interpolation: Interpolation) -> Made {
    gridded(gloss_grid(phi), interpolation)
}

/// The model on a grid.
pub(crate) fn gloss_grid(phi: PhiDomain) -> HalfDiffTable {
    let model = model();
    let basis = Basis::Rgb(RgbSpace::srgb());
    HalfDiffTable::from_fn(DIMS, phi, basis, |wi, wo, out| {
        out.copy_from_slice(&model.eval(wi, wo));
        Status::Measured
    })
}

/// Through the rows of a Cornell file.
fn cloud() -> SampleCloud {
    let basis = Basis::Rgb(RgbSpace::srgb());
    let file = measure_astm(&*model(), &basis, "gloss", &Instrument::default(), 1).unwrap();
    SampleCloud::from_astm_as(&file, RgbSpace::srgb()).unwrap()
}

fn layered(mode: LayerMode) -> Made {
    Made::Plain(Arc::new(LayeredTable::new(&cloud(), mode)))
}

/// Nodes of the warps and images of the RGL table.
const SIDE: usize = 12;
/// Its polar angles of incidence.
const INCIDENCES: usize = 4;

/// An RGL file in memory: visible normals and luminance that depend on incidence and are not symmetric, so that
/// a slip in either warp shows.
pub(crate) fn rgl_table() -> Arc<RglTable> {
    let at = |k: usize| k as f64 / (SIDE - 1) as f64;
    let warp = |f: &dyn Fn(f64, f64, f64) -> f64| -> Vec<f32> {
        let nodes = (0..INCIDENCES * SIDE * SIDE).map(|n| {
            let (k, y, x) = (n / (SIDE * SIDE), n / SIDE % SIDE, n % SIDE);
            f(at(x), at(y), k as f64 / INCIDENCES as f64) as f32
        });
        nodes.collect()
    };
    // x = sqrt of the polar angle of the normal, y = its azimuth relative to the viewer
    let vndf = warp(&|x, y, k| {
        (x * (-4.0 * x * x).exp() + 0.02) * (1.0 + (0.5 + 0.4 * k) * (TAU * y).sin())
    });
    let luminance = warp(&|x, y, k| 0.6 + 0.5 * x * (1.0 - k) + 0.3 * y);
    let values = warp(&|x, y, k| 0.3 + 0.2 * x + 0.1 * y * k);
    let rgb: Vec<f32> = values
        .chunks_exact(SIDE * SIDE)
        .flat_map(|slice| [slice, slice, slice].concat())
        .collect();
    let thetas: Vec<f32> = (0..INCIDENCES)
        .map(|k| (FRAC_PI_2 * k as f64 / (INCIDENCES - 1) as f64) as f32)
        .collect();
    let ndf: Vec<f32> = (0..SIDE * SIDE)
        .map(|n| (2.0 * (-6.0 * at(n % SIDE).powi(4)).exp()) as f32)
        .collect();
    let (n, t) = (SIDE as u64, INCIDENCES as u64);
    let bytes = write_tensor(&[
        TensorField::floats("phi_i", &[1], &[0.0]),
        TensorField::floats("theta_i", &[t], &thetas),
        TensorField::floats("sigma", &[2, 2], &[1.0, 0.2, 1.0, 0.2]),
        TensorField::floats("ndf", &[n, n], &ndf),
        TensorField::floats("vndf", &[1, t, n, n], &vndf),
        TensorField::floats("luminance", &[1, t, n, n], &luminance),
        TensorField::floats("rgb", &[1, t, 3, n, n], &rgb),
        TensorField {
            name: "jacobian",
            dtype: Dtype::U8,
            shape: &[1],
            data: vec![1],
        },
    ]);
    let file = RglFile::from_bytes(bytes).unwrap();
    Arc::new(RglTable::new(&file).unwrap())
}
