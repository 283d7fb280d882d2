//! EXR in: any file with R, G, B (or Y) channels, ours or another program's.

use super::MAX_PIXELS;
use super::picture::{Metadata, Picture};
use crate::error::{Error, ErrorKind};
use crate::load;
use exr::meta::MetaData;
use exr::prelude::{
    AnyChannels, AttributeValue, FlatImage, FlatSamples, Layer, ReadChannels, ReadLayers, Text,
};
use std::io::Cursor;
use std::path::Path;

/// Largest EXR file, bytes: 2 GiB.
pub(super) const MAX_BYTES: u64 = 2 << 30;
/// Most channels over all layers: 65 bands, a colour and its variance leave room.
const MAX_CHANNELS: usize = 128;

/// Reads the first layer that holds an RGB (or grey, Y) picture; alpha and other channels are ignored.
///
/// # Errors
/// Unreadable or broken files, deep data, pictures beyond [`MAX_PIXELS`], no colour channels.
pub fn read_exr(path: &Path) -> Result<Picture, Error> {
    let bytes = load::bytes(path, MAX_BYTES)?;
    read_exr_bytes(&bytes).map_err(|e| e.in_file(path))
}

/// [`read_exr`] from memory.
///
/// # Errors
/// As [`read_exr`].
pub fn read_exr_bytes(bytes: &[u8]) -> Result<Picture, Error> {
    let image = decode(bytes)?;
    image
        .layer_data
        .iter()
        .find_map(picture)
        .unwrap_or_else(|| {
            Err(Error::invalid(
                "expected channels R, G, B or Y, found none of them",
            ))
        })
}

/// All layers and channels.
pub(super) fn decode(bytes: &[u8]) -> Result<FlatImage, Error> {
    // The header is checked before anything is allocated by its numbers.
    let meta = MetaData::read_from_buffered(Cursor::new(bytes), false).map_err(|e| broken(&e))?;
    check_size(&meta)?;
    exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| broken(&e))
}

fn check_size(meta: &MetaData) -> Result<(), Error> {
    let channels: usize = meta.headers.iter().map(|h| h.channels.list.len()).sum();
    if channels > MAX_CHANNELS {
        let message = format!("expected at most {MAX_CHANNELS} channels, found {channels}");
        return Err(Error::new(ErrorKind::TooLarge, message));
    }
    for header in &meta.headers {
        if header.deep {
            return Err(Error::unsupported("deep EXR images are not supported"));
        }
        let (w, h) = (header.layer_size.width(), header.layer_size.height());
        if w.checked_mul(h).is_none_or(|n| n == 0 || n > MAX_PIXELS) {
            let message = format!("expected 1 to {MAX_PIXELS} pixels, found {w} x {h}");
            return Err(Error::new(ErrorKind::TooLarge, message));
        }
    }
    Ok(())
}

fn broken(e: &exr::error::Error) -> Error {
    match e {
        exr::error::Error::NotSupported(what) => Error::unsupported(format!("EXR: {what}")),
        exr::error::Error::Invalid(what) => Error::invalid(format!("broken EXR file: {what}")),
        other => Error::invalid(format!("broken EXR file: {other}")),
    }
}

/// The picture of one layer, or `None` if it has no colour.
fn picture(layer: &Layer<AnyChannels<FlatSamples>>) -> Option<Result<Picture, Error>> {
    let list = &layer.channel_data.list;
    let plane = |name: &str| {
        list.iter()
            .find(|c| c.name.eq(name))
            .map(|c| &c.sample_data)
    };
    let triple = |names: [&str; 3]| -> Option<Vec<[f32; 3]>> {
        let [r, g, b] = names.map(plane);
        let (r, g, b) = (r?.values_as_f32(), g?.values_as_f32(), b?.values_as_f32());
        Some(r.zip(g.zip(b)).map(|(r, (g, b))| [r, g, b]).collect())
    };
    let pixels = triple(["R", "G", "B"]).or_else(|| triple(["Y"; 3]))?;
    let picture = Picture {
        width: layer.size.width(),
        height: layer.size.height(),
        pixels,
        variance: triple(["variance.R", "variance.G", "variance.B"]),
        metadata: metadata(&layer.attributes.other),
    };
    Some(picture.check().map(|()| picture))
}

fn metadata(other: &std::collections::HashMap<Text, AttributeValue>) -> Metadata {
    let get = |name: &str| other.get(&Text::from(name));
    let text = |name: &str| match get(name) {
        Some(AttributeValue::Text(t)) => Some(t.to_string()),
        _ => None,
    };
    Metadata {
        scene: text("gonio.scene"),
        seed: text("gonio.seed").and_then(|t| t.parse().ok()),
        spp: text("gonio.spp").and_then(|t| t.parse().ok()),
        seconds: match get("gonio.seconds") {
            Some(AttributeValue::F64(v)) => Some(*v),
            _ => None,
        },
        version: text("gonio.version"),
        sampler: text("gonio.sampler"),
    }
}
