//! Spectral pictures in EXR: one channel a bin beside R, G and B, its wavelength in its name.
//!
//! Names follow the layout of [Fichet2021] for emissive images: `S0.550,5nm`, with a comma in the number since a dot
//! parts layers. The attribute `gonio.edges_nm` keeps the edges of bins, which names cannot.

use super::exr_read;
use super::exr_write;
use super::picture::Picture;
use crate::error::Error;
use crate::load;
use exr::prelude::{AnyChannel, AttributeValue, FlatSamples, Text};
use std::path::Path;

/// Spectral radiance, plane by plane.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectralPicture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// The middle of each bin, or the band, nm; ascending.
    pub lambda_nm: Vec<f64>,
    /// Edges of the bins, nm, one more than planes; empty for bands.
    pub edges_nm: Vec<f64>,
    /// Mean spectral radiance of each bin, row after row; its integral over wavelength times y is the luminance.
    pub planes: Vec<Vec<f32>>,
}

/// Channel names begin so.
const PREFIX: &str = "S0.";
/// Name of the attribute with the edges.
const EDGES: &str = "gonio.edges_nm";

impl SpectralPicture {
    fn check(&self) -> Result<(), Error> {
        let pixels = self.width.saturating_mul(self.height);
        let counts = self.planes.len() == self.lambda_nm.len() && !self.planes.is_empty();
        if !counts || self.planes.iter().any(|p| p.len() != pixels) {
            return Err(Error::invalid(format!(
                "expected a plane of {pixels} pixels for each of {} wavelengths, found {}",
                self.lambda_nm.len(),
                self.planes.len()
            )));
        }
        let ascending = |nm: &[f64]| nm.windows(2).all(|w| w[0] < w[1]);
        if !ascending(&self.lambda_nm) || !ascending(&self.edges_nm) {
            return Err(Error::invalid(
                "expected ascending wavelengths, found others",
            ));
        }
        Ok(())
    }
}

/// Writes `picture` as [`super::write_exr`] does, with the planes of `spectral` beside it.
///
/// # Errors
/// If the counts contradict each other, or the file cannot be written.
pub fn write_spectral_exr(
    path: &Path,
    picture: &Picture,
    spectral: &SpectralPicture,
) -> Result<(), Error> {
    spectral.check().map_err(|e| e.in_file(path))?;
    if (picture.width, picture.height) != (spectral.width, spectral.height) {
        return Err(Error::invalid("expected planes of the picture's size").in_file(path));
    }
    let channels = (spectral.lambda_nm.iter().zip(&spectral.planes)).map(|(nm, plane)| {
        let name = format!("{PREFIX}{}nm", nm.to_string().replace('.', ","));
        AnyChannel::new(Text::from(name.as_str()), FlatSamples::F32(plane.clone()))
    });
    let edges: Vec<String> = spectral.edges_nm.iter().map(f64::to_string).collect();
    let text = AttributeValue::Text(Text::from(edges.join(" ").as_str()));
    let attribute = (!edges.is_empty()).then_some((EDGES, text));
    exr_write::write(path, picture, channels, attribute)
}

/// Reads the spectral planes of a picture of the same layout, ours or another program's.
///
/// # Errors
/// Unreadable or broken files, no spectral channels.
pub fn read_spectral_exr(path: &Path) -> Result<SpectralPicture, Error> {
    let bytes = load::bytes(path, exr_read::MAX_BYTES)?;
    read(&bytes).map_err(|e| e.in_file(path))
}

fn read(bytes: &[u8]) -> Result<SpectralPicture, Error> {
    let image = exr_read::decode(bytes)?;
    for layer in &image.layer_data {
        let mut planes: Vec<(f64, Vec<f32>)> = Vec::new();
        for channel in &layer.channel_data.list {
            if let Some(nm) = wavelength(&channel.name.to_string()) {
                planes.push((nm, channel.sample_data.values_as_f32().collect()));
            }
        }
        if planes.is_empty() {
            continue;
        }
        planes.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (lambda_nm, planes): (Vec<f64>, Vec<Vec<f32>>) = planes.into_iter().unzip();
        let edges_nm = match layer.attributes.other.get(&Text::from(EDGES)) {
            Some(AttributeValue::Text(text)) => edges(&text.to_string(), planes.len())?,
            _ => Vec::new(),
        };
        let picture = SpectralPicture {
            width: layer.size.width(),
            height: layer.size.height(),
            lambda_nm,
            edges_nm,
            planes,
        };
        return picture.check().map(|()| picture);
    }
    Err(Error::invalid(
        "expected channels named like S0.550nm, found none",
    ))
}

/// The nm in `S0.550,5nm`; `None` for other names.
fn wavelength(name: &str) -> Option<f64> {
    let number = name.strip_prefix(PREFIX)?.strip_suffix("nm")?;
    let nm: f64 = number.replace(',', ".").parse().ok()?;
    (nm > 0.0 && nm.is_finite()).then_some(nm)
}

fn edges(text: &str, planes: usize) -> Result<Vec<f64>, Error> {
    let numbers: Result<Vec<f64>, _> = text.split(' ').map(str::parse).collect();
    let expected = || {
        format!(
            "expected {} numbers in {EDGES}, found \"{text}\"",
            planes + 1
        )
    };
    let edges = numbers.map_err(|_| Error::invalid(expected()))?;
    if edges.len() == planes + 1 {
        Ok(edges)
    } else {
        Err(Error::invalid(expected()))
    }
}
