//! `--error-map`: where the picture errs.

use anyhow::Result;
use plot::{HeatMap, Scale};
use std::path::Path;
use tracer::Film;

/// Longest side of the map, pixels.
const SIDE: u32 = 1000;

/// Writes the relative standard error of each pixel: the root of its summed variances over the root of its summed
/// squared values; grey where the pixel is black or its error unknown.
pub(super) fn write<const N: usize>(path: &Path, film: &Film<N>) -> Result<()> {
    let moments = film.moments();
    let relative = |(mean, variance): (&[f64; N], &[f64; N])| {
        let square: f64 = mean.iter().map(|m| m * m).sum();
        (variance.iter().sum::<f64>() / square).sqrt()
    };
    let top_down: Vec<f64> = (moments.mean.iter().zip(&moments.variance))
        .map(relative)
        .collect();
    let columns = film.width() as usize;
    let map = HeatMap {
        title: "relative standard error".into(),
        x: ("x / pixels".into(), 0.0, f64::from(film.width())),
        y: ("y / pixels".into(), 0.0, f64::from(film.height())),
        columns,
        values: top_down.chunks(columns).rev().flatten().copied().collect(),
        scale: Scale::Log,
    };
    let longest = film.width().max(film.height());
    let side = |n: u32| (SIDE * n / longest).max(SIDE / 4) + SIDE / 5;
    let svg = map.svg((side(film.width()), side(film.height())))?;
    let png = plot::png(&svg, 1.0)?;
    Ok(scene_io::write::bytes(path, &png)?)
}
