//! RGL's adaptive measurements: a tensor file with warps, and the typed view of an isotropic one.

use crate::channels::{Channels, check_wavelengths};
use crate::error::{Error, Place};
use crate::file::File;
use crate::format::Format;
use crate::tensor::{self, Dtype, Tensor, TensorFile};

/// An RGL `.bsdf` file whose fields have the dtypes and shapes that the layout asks for.
///
/// The values include the cosine of the sampled direction, and are not all measured: read
/// `docs/formats/rgl.md` before using them.
#[derive(Clone, Debug)]
pub struct RglFile {
    tensors: TensorFile,
    channels: Channels,
}

/// An array of f32, slowest axis first.
#[derive(Clone, Debug, PartialEq)]
pub struct RglArray {
    /// Length of each axis; none is empty.
    pub shape: Vec<usize>,
    /// As many elements as the product of the shape, as they stand in the file.
    pub data: Vec<f32>,
}

/// The fields of an isotropic RGL file, decoded. \[Dupuy2018\]
///
/// Axes: p = [`RglView::phi_i`], t = [`RglView::theta_i`], c = channel, y and x = the grid of a warp or
/// image on the unit square, of its own size each.
#[derive(Clone, Debug, PartialEq)]
pub struct RglView {
    /// Azimuths of incidence in radians, strictly ascending; one or two.
    pub phi_i: Vec<f32>,
    /// Polar angles of incidence in radians, strictly ascending, within \[0, pi/2\].
    pub theta_i: Vec<f32>,
    /// Projected area of the microfacets, `[y, x]`.
    pub sigma: RglArray,
    /// Normal distribution, `[y, x]`.
    pub ndf: RglArray,
    /// Distribution of visible normals, `[p, t, y, x]`.
    pub vndf: RglArray,
    /// Luminance that guides the sampling, `[p, t, y, x]`.
    pub luminance: RglArray,
    /// Values without the microfacet factor, `[p, t, c, y, x]`; negatives occur.
    pub values: RglArray,
    /// What the channels are; RGB means linear sRGB.
    pub channels: Channels,
    /// Whether the values carry the Jacobian of the warp.
    pub jacobian: bool,
    /// Packed bits, most significant first, over `[p, t, y, x]` of the values; what they mean is unclear.
    pub valid: Option<Vec<u8>>,
    /// What was measured, in the words of the file.
    pub description: String,
}

impl RglFile {
    /// Reads a file; takes the buffer over instead of copying it.
    ///
    /// # Errors
    /// If it is not a sound tensor file, or a field lacks, or has another dtype or shape than its
    /// neighbours ask for.
    pub fn from_bytes(bytes: Vec<u8>) -> Result<Self, Error> {
        let tensors = TensorFile::from_bytes(bytes)?;
        let channels = check(&tensors)?;
        Ok(Self { tensors, channels })
    }

    /// All fields by name.
    #[must_use]
    pub fn tensors(&self) -> &TensorFile {
        &self.tensors
    }

    /// What the channels are; RGB means linear sRGB.
    #[must_use]
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// What was measured, in the words of the file; empty if it has none.
    #[must_use]
    pub fn description(&self) -> String {
        let bytes = self.tensors.field("description").map(|t| t.bytes());
        String::from_utf8_lossy(bytes.unwrap_or_default()).into_owned()
    }

    /// True if the file holds at most two azimuths of incidence, the layout's mark of isotropy.
    #[must_use]
    pub fn is_isotropic(&self) -> bool {
        self.tensors
            .field("phi_i")
            .is_none_or(|t| t.shape()[0] <= 2)
    }

    /// The fields of an isotropic file, decoded.
    ///
    /// # Errors
    /// Anisotropic files are unsupported.
    pub fn view(&self) -> Result<RglView, Error> {
        let phi_i = floats(&self.tensors, "phi_i", 1)?;
        if !self.is_isotropic() {
            let expected = "an isotropic file, with at most 2 azimuths";
            let found = format!("{} azimuths", phi_i.shape[0]);
            let place = Place::File;
            return Err(Error::unsupported(place, "phi_i", expected, found));
        }
        let values = if self.channels == Channels::Rgb {
            "rgb"
        } else {
            "spectra"
        };
        let jacobian = require(&self.tensors, "jacobian", Dtype::U8, 1)?;
        Ok(RglView {
            phi_i: phi_i.data,
            theta_i: floats(&self.tensors, "theta_i", 1)?.data,
            sigma: floats(&self.tensors, "sigma", 2)?,
            ndf: floats(&self.tensors, "ndf", 2)?,
            vndf: floats(&self.tensors, "vndf", 4)?,
            luminance: floats(&self.tensors, "luminance", 4)?,
            values: floats(&self.tensors, values, 5)?,
            channels: self.channels.clone(),
            jacobian: jacobian.bytes().first().is_some_and(|&b| b != 0),
            valid: self.tensors.field("valid").map(|t| t.bytes().to_vec()),
            description: self.description(),
        })
    }
}

/// The registry item.
pub(crate) const FORMAT: Format = Format {
    name: "rgl",
    title: "RGL adaptive measurement, tensor file",
    magic: "`tensor_file` and a NUL, and no field named `M`",
    extensions: &["bsdf"],
    detect,
    read,
    writer: None,
    docs: "docs/formats/rgl.md",
};

fn detect(prefix: &[u8], _total_len: u64) -> bool {
    prefix.starts_with(tensor::MAGIC)
}

fn read(bytes: Vec<u8>) -> Result<File, Error> {
    RglFile::from_bytes(bytes).map(File::Rgl)
}

/// Checks every field that the layout knows, one by one.
fn check(tensors: &TensorFile) -> Result<Channels, Error> {
    let phi_i = floats(tensors, "phi_i", 1)?;
    check_ascending(&phi_i.data, "phi_i", -7.0..=7.0)?;
    let theta_i = floats(tensors, "theta_i", 1)?;
    check_ascending(&theta_i.data, "theta_i", 0.0..=1.571)?;
    let incidences = [phi_i.shape[0], theta_i.shape[0]];
    for name in ["sigma", "ndf"] {
        check_grid(require(tensors, name, Dtype::F32, 2)?, &[])?;
    }
    for name in ["vndf", "luminance"] {
        check_grid(require(tensors, name, Dtype::F32, 4)?, &incidences)?;
    }
    let (values, channels) = check_values(tensors, incidences)?;
    let jacobian = require(tensors, "jacobian", Dtype::U8, 1)?;
    check_shape(jacobian, &[1])?;
    if tensors.field("valid").is_some() {
        let valid = require(tensors, "valid", Dtype::U8, 1)?;
        let [.., y, x] = values.shape() else {
            return Ok(channels);
        };
        let bits = incidences.iter().chain([y, x]).product::<usize>();
        check_shape(valid, &[bits.div_ceil(8)])?;
    }
    if tensors.field("description").is_some() {
        require(tensors, "description", Dtype::U8, 1)?;
    }
    Ok(channels)
}

/// Checks `rgb`, or `spectra` and `wavelengths`.
fn check_values(
    tensors: &TensorFile,
    [phis, thetas]: [usize; 2],
) -> Result<(Tensor<'_>, Channels), Error> {
    let (name, channels) = match (tensors.field("rgb"), tensors.field("spectra")) {
        (Some(_), None) => ("rgb", Channels::Rgb),
        (None, Some(_)) => {
            let field = require(tensors, "wavelengths", Dtype::F32, 1)?;
            let nm = field.to_f32().unwrap_or_default();
            let nm: Vec<f64> = nm.into_iter().map(f64::from).collect();
            check_wavelengths(&nm, field.place(), "wavelengths")?;
            ("spectra", Channels::Wavelengths(nm))
        }
        (Some(_), Some(_)) => return Err(which_values("both")),
        (None, None) => return Err(which_values("neither")),
    };
    let values = require(tensors, name, Dtype::F32, 5)?;
    check_grid(values, &[phis, thetas, channels.len()])?;
    Ok((values, channels))
}

fn which_values(found: &str) -> Error {
    Error::invalid(Place::File, "values", "a field `rgb` or `spectra`", found)
}

/// The field of this name, which must have this dtype, this many axes, and no empty one.
fn require<'a>(
    tensors: &'a TensorFile,
    name: &str,
    dtype: Dtype,
    axes: usize,
) -> Result<Tensor<'a>, Error> {
    let Some(field) = tensors.field(name) else {
        let place = Place::File;
        return Err(Error::invalid(place, name, "a field of this name", "none"));
    };
    if field.dtype() != dtype {
        let (expected, found) = (dtype.name(), field.dtype().name());
        return Err(Error::invalid(field.place(), name, expected, found));
    }
    let shape = field.shape();
    // Only a text may be empty.
    if shape.len() != axes || (shape.contains(&0) && name != "description") {
        let expected = format!("a shape of {axes} axes, none empty");
        return Err(Error::invalid(
            field.place(),
            name,
            expected,
            format!("{shape:?}"),
        ));
    }
    Ok(field)
}

fn floats(tensors: &TensorFile, name: &str, axes: usize) -> Result<RglArray, Error> {
    let field = require(tensors, name, Dtype::F32, axes)?;
    Ok(RglArray {
        shape: field.shape().to_vec(),
        data: field.to_f32().unwrap_or_default(),
    })
}

/// The leading axes must have these lengths; the last two are a grid, which takes two points to span.
fn check_grid(field: Tensor<'_>, leading: &[usize]) -> Result<(), Error> {
    let (front, grid) = field.shape().split_at(leading.len());
    if front == leading && grid.iter().all(|&n| n >= 2) {
        return Ok(());
    }
    let mut expected: Vec<String> = leading.iter().map(usize::to_string).collect();
    expected.extend([">=2".into(), ">=2".into()]);
    let expected = format!("shape [{}]", expected.join(", "));
    let found = format!("{:?}", field.shape());
    Err(Error::invalid(field.place(), field.name(), expected, found))
}

fn check_shape(field: Tensor<'_>, expected: &[usize]) -> Result<(), Error> {
    if field.shape() == expected {
        return Ok(());
    }
    let (expected, found) = (
        format!("shape {expected:?}"),
        format!("{:?}", field.shape()),
    );
    Err(Error::invalid(field.place(), field.name(), expected, found))
}

fn check_ascending(
    values: &[f32],
    name: &str,
    range: std::ops::RangeInclusive<f32>,
) -> Result<(), Error> {
    let within = values.iter().all(|v| range.contains(v));
    if within && values.is_sorted_by(|a, b| a < b) {
        return Ok(());
    }
    let (lo, hi) = (range.start(), range.end());
    let expected = format!("ascending radians from {lo} to {hi}");
    let bad = values
        .iter()
        .enumerate()
        .find(|&(i, v)| !range.contains(v) || i.checked_sub(1).is_some_and(|p| values[p] >= *v));
    let found = bad.map_or_else(String::new, |(i, v)| format!("{v} at index {i}"));
    Err(Error::invalid(Place::File, name, expected, found))
}
