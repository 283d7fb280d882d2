//! The table of an isotropic RGL file, seen from the viewer.
//!
//! The file parametrises by one *known* direction and samples the other; its values include the cosine of the
//! sampled one. The known direction is the viewer's `wo` here, the sampled one the light's `wi`.

use crate::rgl::image::Image;
use crate::rgl::lanes::{LaneValues, Parts, RglLanes};
use crate::rgl::slices::{Incidences, Slices};
use crate::rgl::warp::Warp;
use brdf::{Brdf, DirectionSample, DirectionSampler, LANES, Lanes3};
use brdf::{Measured, SampleLanes, Status, Symmetry};
use brdf_formats::{Channels, Error, RglArray, RglFile};
use glam::{DVec2, DVec3};
use pulp::{Simd, WithSimd};
use spectrum::{Basis, RgbSpace};
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2, PI, TAU};
use std::sync::Arc;

/// An RGL measurement [Dupuy2018]. Not reciprocal; negative channels (colours out of gamut) are kept.
#[derive(Clone, Debug)]
pub struct RglTable {
    basis: Basis,
    incidences: Incidences,
    sigma: Image,
    ndf: Image,
    vndf: Warp,
    luminance: Warp,
    values: Image,
    /// Whether values are to be multiplied by D / (4 sigma).
    microfacet_factor: bool,
    /// For packets; needs a single azimuth of incidence.
    lanes: Option<RglLanes>,
}

/// Below this cosine of `wi`, f_r is held: values that include the cosine say nothing there.
const MIN_COS: f64 = 1e-6;

/// A pair of directions in the coordinates of the file.
struct Query {
    slices: Slices,
    /// Polar and azimuthal coordinate of the half vector in the unit square.
    u_m: [f64; 2],
    u_known: [f64; 2],
    m: DVec3,
}

impl RglTable {
    /// # Errors
    /// Anisotropic files are unsupported.
    pub fn new(file: &RglFile) -> Result<Self, Error> {
        let view = file.view()?;
        let basis = match view.channels {
            Channels::Wavelengths(nm) => Basis::Bands(nm),
            Channels::Xyz => Basis::Xyz,
            _ => Basis::Rgb(RgbSpace::srgb()),
        };
        let mut table = Self {
            basis,
            incidences: Incidences::new(&view.phi_i, &view.theta_i),
            sigma: image(view.sigma),
            ndf: image(view.ndf),
            vndf: warp(view.vndf),
            luminance: warp(view.luminance),
            values: image(view.values),
            microfacet_factor: view.jacobian,
            lanes: None,
        };
        table.lanes = (table.incidences.isotropic()).then(|| {
            RglLanes::new(&Parts {
                theta: table.incidences.theta(),
                sigma: &table.sigma,
                ndf: &table.ndf,
                vndf: &table.vndf,
                luminance: &table.luminance,
                microfacet_factor: table.microfacet_factor,
            })
        });
        Ok(table)
    }

    /// f_r(wi, wo) cos(theta_i), as the file stores it: well-defined down to the horizon. Zero below it.
    pub fn eval_f_cos(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) {
        out.fill(0.0);
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return;
        }
        let query = self.query(wi, wo);
        let (uniform, _) = self.vndf.invert(query.u_m, &query.slices);
        let at = self.values.place(uniform);
        let factor = if self.microfacet_factor {
            self.ndf.eval(0, self.ndf.place(query.u_m))
                / (4.0 * self.sigma.eval(0, self.sigma.place(query.u_known)))
        } else {
            1.0
        };
        let channels = self.basis.len();
        for (c, o) in out.iter_mut().enumerate().take(channels) {
            let value = factor * self.values.blend(&query.slices, channels, c, at);
            *o = if value.is_finite() { value } else { 0.0 };
        }
    }

    /// The share of samples that fall below the horizon for this `wo`, from `n * n` midpoints: the file's own
    /// sampling loses them, and its density integrates to 1 minus this.
    #[must_use]
    pub fn waste(&self, wo: DVec3, n: u32) -> f64 {
        let lost = (0..n * n).filter(|k| {
            let u = DVec2::new(f64::from(k % n) + 0.5, f64::from(k / n) + 0.5) / f64::from(n);
            self.sample(wo, u).is_none()
        });
        lost.count() as f64 / f64::from(n * n)
    }

    fn query(&self, wi: DVec3, wo: DVec3) -> Query {
        let m = (wi + wo).normalize_or(DVec3::Z);
        let (theta, phi) = (elevation(wo), wo.y.atan2(wo.x));
        let turn = m.y.atan2(m.x) - phi;
        let u_phi = turn / TAU + 0.5;
        Query {
            slices: self.incidences.around(phi, theta),
            u_m: [(elevation(m) * FRAC_2_PI).sqrt(), u_phi - u_phi.floor()],
            u_known: [(theta * FRAC_2_PI).sqrt(), phi / TAU + 0.5],
            m,
        }
    }
}

/// Density of the reflected direction per density of the half vector on the unit square.
fn jacobian(u_m: f64, m: DVec3, known: DVec3) -> f64 {
    let warp = 2.0 * PI * PI * u_m * m.x.hypot(m.y);
    warp.max(1e-6) * 4.0 * known.dot(m)
}

/// Polar angle, precise near 0.
fn elevation(v: DVec3) -> f64 {
    let chord = DVec3::new(v.x, v.y, v.z - 1.0).length();
    2.0 * (0.5 * chord).min(1.0).asin()
}

fn image(array: RglArray) -> Image {
    let [.., ny, nx] = array.shape[..] else {
        return Image::new(2, 2, vec![0.0; 4]);
    };
    Image::new(nx, ny, array.data)
}

fn warp(array: RglArray) -> Warp {
    let [.., ny, nx] = array.shape[..] else {
        return Warp::new(2, 2, vec![1.0; 4]);
    };
    Warp::new(nx, ny, array.data)
}

impl Measured for RglTable {
    fn basis(&self) -> &Basis {
        &self.basis
    }

    fn eval_native(&self, wi: DVec3, wo: DVec3, out: &mut [f64]) -> Status {
        assert_eq!(out.len(), self.basis.len(), "one output a channel");
        self.eval_f_cos(wi, wo, out);
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return Status::Filled;
        }
        for o in out {
            *o /= wi.z.max(MIN_COS);
        }
        Status::Interpolated
    }

    fn symmetry(&self) -> Symmetry {
        Symmetry {
            isotropic: self.incidences.isotropic(),
            reciprocal: false,
        }
    }

    fn table_bytes(&self) -> usize {
        DirectionSampler::bytes(self)
    }
}

/// The file's own sampling: luminance, then visible normals. `None` also where the sampled normal
/// reflects below the horizon ([`RglTable::waste`]).
impl DirectionSampler for RglTable {
    fn sample(&self, wo: DVec3, u: DVec2) -> Option<DirectionSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let phi = wo.y.atan2(wo.x);
        let slices = self.incidences.around(phi, elevation(wo));
        // the file's order of coordinates: the first number drives the rows
        let (uniform, luminance) = self.luminance.sample([u.y, u.x], &slices);
        let (u_m, vndf) = self.vndf.sample(uniform, &slices);
        let theta_m = u_m[0] * u_m[0] * FRAC_PI_2;
        let m = brdf::direction(theta_m, (2.0 * u_m[1] - 1.0) * PI + phi);
        let wi = (2.0 * wo.dot(m) * m - wo).normalize_or(DVec3::ZERO);
        let pdf = vndf * luminance / jacobian(u_m[0], m, wo);
        (wi.z > 0.0 && pdf > 0.0 && pdf.is_finite()).then_some(DirectionSample { wi, pdf })
    }

    fn pdf(&self, wi: DVec3, wo: DVec3) -> f64 {
        if wi.z <= 0.0 || wo.z <= 0.0 {
            return 0.0;
        }
        let query = self.query(wi, wo);
        let (uniform, vndf) = self.vndf.invert(query.u_m, &query.slices);
        let pdf =
            vndf * self.luminance.pdf(uniform, &query.slices) / jacobian(query.u_m[0], query.m, wo);
        if pdf.is_finite() { pdf } else { 0.0 }
    }

    fn bytes(&self) -> usize {
        let warps = self.vndf.bytes() + self.luminance.bytes();
        let images = self.sigma.bytes() + self.ndf.bytes() + self.values.bytes();
        let lanes = self.lanes.as_ref().map_or(0, RglLanes::bytes);
        warps + images + lanes + self.incidences.count() * size_of::<f64>()
    }

    #[inline(always)]
    fn sample_lanes(&self, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
        match &self.lanes {
            Some(lanes) => lanes.sample(wo, u),
            None => sample_each(self, wo, u),
        }
    }

    #[inline(always)]
    fn pdf_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
        match &self.lanes {
            Some(lanes) => lanes.pdf(wi, wo),
            None => pdf_each(self, wi, wo),
        }
    }
}

/// An RGL table of exactly `N` channels: 3 for the RGB files.
#[derive(Clone, Debug)]
pub struct RglN<const N: usize> {
    table: Arc<RglTable>,
    values: Arc<LaneValues<N>>,
}

impl<const N: usize> RglN<N> {
    /// `None` if the table does not have `N` channels.
    #[must_use]
    pub fn new(table: Arc<RglTable>) -> Option<Self> {
        let values = (table.basis.len() == N).then(|| Arc::new(LaneValues::new(&table.values)))?;
        Some(Self { table, values })
    }
}

impl<const N: usize> Brdf<N> for RglN<N> {
    fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; N] {
        let mut out = [0.0; N];
        self.table.eval_native(wi, wo, &mut out);
        out
    }

    fn symmetry(&self) -> Symmetry {
        Measured::symmetry(&*self.table)
    }

    fn table_bytes(&self) -> usize {
        self.table.bytes() + self.values.bytes()
    }

    /// Chooses the instruction set for itself, since it costs more than that and may be called through a pointer.
    fn eval_lanes(&self, wi: &Lanes3, wo: &Lanes3) -> [[f32; LANES]; N] {
        match &self.table.lanes {
            Some(lanes) => brdf::arch().dispatch(EvalLanes {
                lanes,
                values: &self.values,
                wi,
                wo,
            }),
            None => {
                let mut out = [[0.0; LANES]; N];
                for k in 0..LANES {
                    let f = self.eval(wi.get(k).as_dvec3(), wo.get(k).as_dvec3());
                    (0..N).for_each(|c| out[c][k] = f[c] as f32);
                }
                out
            }
        }
    }
}

struct EvalLanes<'a, const N: usize> {
    lanes: &'a RglLanes,
    values: &'a LaneValues<N>,
    wi: &'a Lanes3,
    wo: &'a Lanes3,
}

impl<const N: usize> WithSimd for EvalLanes<'_, N> {
    type Output = [[f32; LANES]; N];

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let min_cos = MIN_COS as f32;
        self.lanes.eval(self.values, min_cos, self.wi, self.wo)
    }
}

fn sample_each(table: &RglTable, wo: &Lanes3, u: &[[f32; LANES]; 2]) -> SampleLanes {
    let mut out = SampleLanes {
        wi: Lanes3::ZERO,
        pdf: [0.0; LANES],
    };
    for k in 0..LANES {
        let u = DVec2::new(f64::from(u[0][k]), f64::from(u[1][k]));
        if let Some(s) = table.sample(wo.get(k).as_dvec3(), u) {
            out.wi.set(k, s.wi.as_vec3());
            out.pdf[k] = s.pdf as f32;
        }
    }
    out
}

fn pdf_each(table: &RglTable, wi: &Lanes3, wo: &Lanes3) -> [f32; LANES] {
    std::array::from_fn(|k| table.pdf(wi.get(k).as_dvec3(), wo.get(k).as_dvec3()) as f32)
}
