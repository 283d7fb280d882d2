//! Laying a scene over its bases and filling in defaults.

use super::checked::{Depth, FieldOfView, Point, SampleCount, Side, plain};
use super::names::{GamutName, PointsName, SamplerName, SpectrumName};
use super::schema::{
    CameraDoc, ExposureSpec, FilmDoc, FilterSpec, FormSpec, LightSpec, MaterialSpec, RenderDoc,
    SceneDoc, ShapeSpec,
};
use super::{check, parse};
use crate::error::{Error, ErrorKind};
use crate::load;
use spectrum::Bins;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What 8, 16 and 45 bins divide unless a scene says otherwise: of the ranges tried, the one that leaves Cornell's
/// paints and smooth reflectances alike the least colour difference in 8 (docs/spectral.md).
const RANGE_NM: [f64; 2] = [410.0, 690.0];

/// Bases of bases beyond this are taken for a circle.
const MAX_BASES: usize = 8;

/// A checked scene: every field has its value, every name means something. Files are not opened yet.
#[derive(Clone, Debug)]
pub struct SceneFile {
    /// Where it came from; empty for the embedded default.
    pub path: PathBuf,
    /// One line on what it shows.
    pub about: String,
    /// The camera.
    pub camera: CameraSpec,
    /// The film.
    pub film: FilmSpec,
    /// How to render.
    pub render: RenderSpec,
    /// The material that `--material FILE` replaces.
    pub main_material: Option<String>,
    /// Materials by name.
    pub materials: BTreeMap<String, MaterialSpec>,
    /// Surfaces.
    pub shapes: Vec<ShapeSpec>,
    /// Lights that are not surfaces.
    pub lights: Vec<LightSpec>,
}

/// A pinhole camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraSpec {
    /// Where it stands.
    pub position: [f64; 3],
    /// The point in the middle of the image.
    pub target: [f64; 3],
    /// Up in the image.
    pub up: [f64; 3],
    /// Full vertical field of view, degrees.
    pub fov_y_deg: f64,
}

/// The film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmSpec {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Reconstruction filter.
    pub filter: FilterSpec,
    /// Brightness of the PNG.
    pub exposure: ExposureSpec,
    /// How the PNG shows colours out of gamut.
    pub gamut: GamutName,
}

/// How to render.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSpec {
    /// Samples a pixel.
    pub spp: u32,
    /// Scattering vertices of a path.
    pub depth: u32,
    /// Scattering vertices from which on weak paths end by chance; `None`: never.
    pub roulette: Option<u32>,
    /// Seed of every random decision.
    pub seed: u64,
    /// What the channels are.
    pub spectrum: SpectrumName,
    /// The range that fixed bins divide, nm; the outermost go on beyond it.
    pub range_nm: [f64; 2],
    /// Edges of the bins, nm, ascending, in place of the range: for the mode that has as many bins, 8, 16 or 45.
    pub edges_nm: Option<Vec<f64>>,
    /// For materials that name none themselves.
    pub sampler: SamplerName,
    /// Point set.
    pub points: PointsName,
}

impl RenderSpec {
    /// The bins of the mode that has `count` of them.
    ///
    /// # Errors
    /// If the range or the edges are none.
    pub fn bins(&self, count: usize) -> Result<Bins, Error> {
        let (bins, field) = match &self.edges_nm {
            Some(edges) if edges.len() == count + 1 => (Bins::new(edges.clone()), "edges_nm"),
            _ => (Bins::uniform(count, self.range_nm), "range_nm"),
        };
        bins.map_err(|e| {
            Error::invalid(e.to_string())
                .in_field(field)
                .in_field("render")
        })
    }
}

impl SceneFile {
    /// Reads and checks a scene and its bases.
    ///
    /// # Errors
    /// Unreadable or malformed files, values out of range, names that mean nothing.
    pub fn load(path: &Path) -> Result<Self, Error> {
        let doc = load_doc(path, 0)?;
        Self::from_doc(doc, path).map_err(|e| e.in_file(path))
    }

    /// Reads and checks a scene held in memory; `home` is the folder its relative paths start from,
    /// and `path` the name its errors carry.
    ///
    /// # Errors
    /// As [`Self::load`].
    pub fn from_text(text: &str, path: &Path, home: &Path) -> Result<Self, Error> {
        let doc = parse_at(text, home).map_err(|e| e.in_file(path))?;
        let doc = over_base(doc, home, 0).map_err(|e| e.in_file(path))?;
        Self::from_doc(doc, path).map_err(|e| e.in_file(path))
    }

    /// Checks what no single field shows, as loading does; for scenes that were changed since.
    ///
    /// # Errors
    /// Says which field contradicts which.
    pub fn check(&self) -> Result<(), Error> {
        check::scene(self)
    }

    fn from_doc(doc: SceneDoc, path: &Path) -> Result<Self, Error> {
        let scene = Self {
            path: path.to_owned(),
            about: doc.about.unwrap_or_default(),
            camera: camera(doc.camera)?,
            film: film(doc.film),
            render: render(doc.render),
            main_material: doc.main_material,
            materials: doc.materials.0,
            shapes: doc.shapes.unwrap_or_default(),
            lights: doc.lights.unwrap_or_default(),
        };
        check::scene(&scene)?;
        Ok(scene)
    }
}

fn load_doc(path: &Path, depth: usize) -> Result<SceneDoc, Error> {
    let text = load::text(path, load::MAX_SCENE_BYTES)?;
    let home = path.parent().unwrap_or(Path::new(""));
    let doc = parse_at(&text, home).map_err(|e| e.in_file(path))?;
    over_base(doc, home, depth).map_err(|e| e.in_file(path))
}

fn parse_at(text: &str, home: &Path) -> Result<SceneDoc, Error> {
    let mut doc = parse::parse(text)?;
    for material in doc.materials.0.values_mut() {
        if let MaterialSpec::File(file) = material {
            file.home = home.to_owned();
        }
    }
    for shape in doc.shapes.iter_mut().flatten() {
        if let FormSpec::Mesh { home: at, .. } = &mut shape.form {
            *at = home.to_owned();
        }
    }
    for light in doc.lights.iter_mut().flatten() {
        if let LightSpec::Image { home: at, .. } = light {
            *at = home.to_owned();
        }
    }
    Ok(doc)
}

/// Camera, film and render field by field, materials by name; shapes and lights as whole lists.
fn over_base(doc: SceneDoc, home: &Path, depth: usize) -> Result<SceneDoc, Error> {
    let Some(base) = &doc.base else {
        return Ok(doc);
    };
    if depth == MAX_BASES {
        let message =
            format!("expected at most {MAX_BASES} bases above one another, found more (a circle?)");
        return Err(Error::invalid(message).in_field("base"));
    }
    let path = home.join(base);
    let under = load_doc(&path, depth + 1).map_err(|e| match e.kind() {
        ErrorKind::NotFound if e.path() == Some(&path) => {
            let message = format!("no such file: {}", path.display());
            Error::new(ErrorKind::NotFound, message).in_field("base")
        }
        _ => e,
    })?;
    let mut materials = under.materials;
    materials.0.extend(doc.materials.0);
    let (camera, film, render) = (under.camera, under.film, under.render);
    Ok(SceneDoc {
        about: doc.about.or(under.about),
        base: None,
        camera: CameraDoc {
            position: doc.camera.position.or(camera.position),
            target: doc.camera.target.or(camera.target),
            up: doc.camera.up.or(camera.up),
            fov_y_deg: doc.camera.fov_y_deg.or(camera.fov_y_deg),
        },
        film: FilmDoc {
            width: doc.film.width.or(film.width),
            height: doc.film.height.or(film.height),
            filter: doc.film.filter.or(film.filter),
            exposure: doc.film.exposure.or(film.exposure),
            gamut: doc.film.gamut.or(film.gamut),
        },
        render: RenderDoc {
            spp: doc.render.spp.or(render.spp),
            depth: doc.render.depth.or(render.depth),
            roulette: doc.render.roulette.or(render.roulette),
            seed: doc.render.seed.or(render.seed),
            spectrum: doc.render.spectrum.or(render.spectrum),
            range_nm: doc.render.range_nm.or(render.range_nm),
            edges_nm: doc.render.edges_nm.or(render.edges_nm),
            sampler: doc.render.sampler.or(render.sampler),
            points: doc.render.points.or(render.points),
        },
        main_material: doc.main_material.or(under.main_material),
        materials,
        shapes: doc.shapes.or(under.shapes),
        lights: doc.lights.or(under.lights),
    })
}

fn camera(doc: CameraDoc) -> Result<CameraSpec, Error> {
    let required = |p: Option<Point>, name: &str| {
        p.map(plain).ok_or_else(|| {
            Error::invalid("expected a point (x, y, z), found nothing")
                .in_field(name)
                .in_field("camera")
        })
    };
    Ok(CameraSpec {
        position: required(doc.position, "position")?,
        target: required(doc.target, "target")?,
        up: doc.up.map_or([0.0, 1.0, 0.0], plain),
        fov_y_deg: doc.fov_y_deg.unwrap_or(FieldOfView(35.0)).0,
    })
}

fn film(doc: FilmDoc) -> FilmSpec {
    FilmSpec {
        width: doc.width.unwrap_or(Side(640)).0,
        height: doc.height.unwrap_or(Side(480)).0,
        filter: doc.filter.unwrap_or(FilterSpec::Box),
        exposure: doc.exposure.unwrap_or(ExposureSpec::Auto),
        gamut: doc.gamut.unwrap_or(GamutName::Clip),
    }
}

fn render(doc: RenderDoc) -> RenderSpec {
    RenderSpec {
        spp: doc.spp.unwrap_or(SampleCount(64)).0,
        depth: doc.depth.unwrap_or(Depth(5)).0,
        roulette: doc.roulette.map(|d| d.0),
        seed: doc.seed.unwrap_or(0),
        spectrum: doc.spectrum.unwrap_or(SpectrumName::Rgb),
        range_nm: doc.range_nm.map_or(RANGE_NM, |(from, to)| [from.0, to.0]),
        edges_nm: doc.edges_nm.map(|e| e.iter().map(|nm| nm.0).collect()),
        sampler: doc.sampler.unwrap_or(SamplerName::Auto),
        points: doc.points.unwrap_or(PointsName::Sobol),
    }
}
