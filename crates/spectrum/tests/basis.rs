//! Every basis agrees on white, and on colours that can be told in several.

use spectrum::{Basis, Bins, LUMINANCE_SRGB, RgbSpace, Viewing};
use testkit::assert_close;

fn bases() -> Vec<Basis> {
    let cornell = |n: u16, step: f64| (0..n).map(|k| 400.0 + step * f64::from(k)).collect();
    vec![
        Basis::Rgb(RgbSpace::srgb()),
        Basis::Rgb(RgbSpace::trinitron()),
        Basis::Rgb(RgbSpace::acescg()),
        Basis::Xyz,
        Basis::Bands(cornell(31, 10.0)),
        Basis::Bands(cornell(61, 5.0)),
        Basis::Bands(vec![550.0]),
        Basis::Bins(Bins::visible(8)),
        Basis::Bins(Bins::visible(45)),
        Basis::Bins(Bins::uniform(2, [400.0, 505.0]).expect("ascending")),
    ]
}

/// A reflectance of 1, in the channels of the basis; XYZ is told by its own weights.
fn white(basis: &Basis) -> Vec<f64> {
    match basis {
        Basis::Rgb(space) => vec![space.white_level; 3],
        Basis::Xyz => Viewing::standard().white().to_vec(),
        _ => vec![1.0; basis.len()],
    }
}

fn convert(basis: &Basis, channels: &[f64]) -> [f64; 3] {
    let mut out = [0.0; 3];
    for (row, v) in basis.to_linear_srgb().iter().zip(channels) {
        for c in 0..3 {
            out[c] += row[c] * v;
        }
    }
    out
}

#[test]
fn white_is_one_in_every_basis() {
    for basis in bases() {
        assert_eq!(basis.to_linear_srgb().len(), basis.len());
        for v in convert(&basis, &white(&basis)) {
            assert!((v - 1.0).abs() < 1e-14, "{basis:?}: {v}");
        }
        let weights = basis.luminance_weights();
        let y: f64 = weights.iter().zip(white(&basis)).map(|(w, v)| w * v).sum();
        assert!((y - 1.0).abs() < 1e-12, "{basis:?}: {y}");
    }
}

#[test]
fn srgb_is_left_alone() {
    let rows = Basis::Rgb(RgbSpace::srgb()).to_linear_srgb();
    assert!(
        rows.iter()
            .flatten()
            .zip([1, 0, 0, 0, 1, 0, 0, 0, 1])
            .all(|(v, e)| v.to_bits() == f64::from(e).to_bits())
    );
}

#[test]
fn luminance_is_that_of_the_srgb_result() {
    for basis in bases() {
        let direct = basis.luminance_weights();
        for (row, y) in basis.to_linear_srgb().iter().zip(direct) {
            let via: f64 = row.iter().zip(LUMINANCE_SRGB).map(|(v, w)| v * w).sum();
            // ACEScg is adapted from D60, which moves luminance by a percent of the white's
            assert!((via - y).abs() < 0.02, "{basis:?}: {via}, {y}");
        }
    }
}

#[test]
fn a_saturated_red_is_out_of_gamut_and_stays() {
    let bands: Vec<f64> = (0..31).map(|k| 400.0 + 10.0 * f64::from(k)).collect();
    let red: Vec<f64> = bands
        .iter()
        .map(|nm| f64::from(u8::from(*nm > 640.0)))
        .collect();
    let [r, g, b] = convert(&Basis::Bands(bands), &red);
    assert!(r > 0.05 && g < 0.0 && b.abs() < 0.01, "{r} {g} {b}");
}

/// The channels of `target` for channels of `from`.
fn to(from: &Basis, target: &Basis, channels: &[f64]) -> Vec<f64> {
    let rows = from.rows_to(target);
    assert_eq!(rows.len(), from.len(), "a row for each channel");
    (0..target.len())
        .map(|c| rows.iter().zip(channels).map(|(row, v)| row[c] * v).sum())
        .collect()
}

#[test]
fn white_stays_white_from_any_basis_to_any() {
    for a in bases() {
        for b in bases() {
            let found = to(&a, &b, &white(&a));
            for (f, e) in found.iter().zip(white(&b)) {
                // nine digits of the linear basis
                assert_close(*f, e, 1e-8, &format!("{a:?} to {b:?}"));
            }
        }
    }
}

#[test]
fn colours_survive_the_way_through_bands_and_back() {
    let colours = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-0.1, 0.4, 3.0]];
    for space in [
        Basis::Rgb(RgbSpace::srgb()),
        Basis::Rgb(RgbSpace::rec2020()),
        Basis::Xyz,
    ] {
        // the basis' own bands lose nothing
        let bands = Basis::Bands((0..81).map(|k| 380.0 + 5.0 * f64::from(k)).collect());
        for colour in colours {
            let back = to(&bands, &space, &to(&space, &bands, &colour));
            for c in 0..3 {
                // nine digits of the basis, times 3
                assert_close(back[c], colour[c], 1e-8, "round trip");
            }
        }
    }
}

#[test]
fn bands_become_their_means() {
    let bands = Basis::Bands(vec![400.0, 500.0, 600.0]);
    let bins = Basis::Bins(Bins::new(vec![380.0, 400.0, 450.0, 600.0]).unwrap());
    let means = to(&bands, &bins, &[0.2, 0.8, 0.4]);
    // flat, a quarter of the way up on average, 0.5..0.8..0.4 by trapezia
    for (found, expected) in means
        .iter()
        .zip([0.2, 0.35, (50.0 * 0.65 + 100.0 * 0.6) / 150.0])
    {
        assert_close(*found, expected, 1e-14, "mean");
    }
    let at = bands.at(425.0);
    for (found, expected) in at.iter().zip([0.75, 0.25, 0.0]) {
        assert_close(*found, expected, 1e-15, "hat");
    }
}

#[test]
fn names_tell_wavelengths() {
    assert_eq!(Basis::Bins(Bins::visible(8)).names()[0], "380-422.5nm");
    assert_eq!(
        Basis::Bins(Bins::visible(45)).names()[1],
        "387.556-395.111nm"
    );
    assert_eq!(Basis::Bands(vec![412.5]).names(), ["412.5nm"]);
}

#[test]
fn degenerate_spaces_say_so_and_empty_bases_are_empty() {
    let mut space = RgbSpace::srgb();
    space.primaries = [[0.3, 0.3]; 3];
    let basis = Basis::Rgb(space);
    assert!(basis.to_linear_srgb().iter().flatten().all(|v| v.is_nan()));
    assert!(basis.luminance_weights().iter().all(|v| v.is_nan()));
    let none = Basis::Bands(Vec::new());
    assert!(none.to_linear_srgb().is_empty() && none.luminance_weights().is_empty());
}
