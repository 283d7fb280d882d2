//! Cornell's materials are published as spectra and as RGB: the one must give the other.

use spectrum::matrix::transform;
use spectrum::{Basis, Illuminant, Observer, RgbSpace};

/// Lines of numbers.
type Rows = Vec<Vec<f64>>;

const MATERIALS: [&str; 2] = ["garnet_red", "krylon_blue"];

fn read(path: &str) -> Option<String> {
    testkit::read_data(path).map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
}

/// Both files of a material, rows in the same order: wavelengths, spectra, RGB; angles before each.
fn material(name: &str) -> Option<(Vec<f64>, Rows, Rows)> {
    let (nm, spectra) = spectra(&read(&format!("cornell-spectral/{name}.brdf"))?);
    let rgb = rgb(&read(&format!("cornell/{name}_RGB.astm"))?);
    Some((nm, spectra, rgb))
}

fn numbers(text: &str) -> impl Iterator<Item = f64> {
    text.split([' ', ',', '\n', '\r'])
        .filter_map(|t| t.parse().ok())
}

/// Rows of the pbrt-v2 text form: wavelengths, and angles with a spectrum each.
fn spectra(text: &str) -> (Vec<f64>, Rows) {
    let body: String = text
        .lines()
        .filter(|l| !l.starts_with('#'))
        .map(|l| format!("{l}\n"))
        .collect();
    let mut values = numbers(&body);
    let n = values.next().unwrap_or(0.0) as usize;
    let nm: Vec<f64> = values.by_ref().take(n).collect();
    let all: Vec<f64> = values.collect();
    (nm, all.chunks(4 + n).map(<[f64]>::to_vec).collect())
}

/// Rows of the ASTM form after the header: angles and RGB.
fn rgb(text: &str) -> Rows {
    let (_, body) = text.split_once("theta_s,phi_s,R,G,B").unwrap_or_default();
    let all: Vec<f64> = numbers(body).collect();
    all.chunks(7).map(<[f64]>::to_vec).collect()
}

/// XYZ weights as Cornell took them: the product of the tables at each band, no integration in between.
fn point_weights(nm: &[f64]) -> Vec<[f64; 3]> {
    let light = Illuminant::D65.spectrum();
    let products: Vec<[f64; 3]> = nm
        .iter()
        .map(|l| Observer::CIE_1931.at(*l).map(|v| v * light.at(*l)))
        .collect();
    let y: f64 = products.iter().map(|p| p[1]).sum();
    products.into_iter().map(|p| p.map(|v| v / y)).collect()
}

fn apply(weights: &[[f64; 3]], values: &[f64]) -> [f64; 3] {
    let add = |s: [f64; 3], (w, v): (&[f64; 3], &f64)| std::array::from_fn(|c| s[c] + w[c] * v);
    weights.iter().zip(values).fold([0.0; 3], add)
}

#[test]
fn spectra_give_the_rgb_file_through_the_trinitron_space() {
    let from_xyz = RgbSpace::trinitron().from_xyz().unwrap();
    for name in MATERIALS {
        let Some((nm, spectra, rgb)) = material(name) else {
            return;
        };
        assert_eq!((spectra.len(), rgb.len()), (1439, 1439), "{name}");
        let weights = point_weights(&nm);
        for (spectrum, row) in spectra.iter().zip(&rgb) {
            assert_eq!(spectrum[..4], row[..4], "rows have the same order");
            let found = transform(&from_xyz, apply(&weights, &spectrum[4..]));
            // 1e-5 for values up to 1; peaks of up to 24 are printed with six decimals of 66 summed bands
            let size = row[4..].iter().fold(1.0, |m, v| f64::max(m, *v));
            for c in 0..3 {
                let error = (found[c] - row[4 + c]).abs();
                assert!(error <= 1e-5 * size, "{name} {row:?}: {found:?}");
            }
        }
    }
}

#[test]
fn both_files_mean_the_same_linear_srgb() {
    let from_rgb = Basis::Rgb(RgbSpace::trinitron()).to_linear_srgb();
    for name in MATERIALS {
        let Some((nm, spectra, rgb)) = material(name) else {
            return;
        };
        let from_bands = Basis::Bands(nm).to_linear_srgb();
        let (mut difference, mut size) = (0.0, 0.0);
        for (spectrum, row) in spectra.iter().zip(&rgb) {
            let a = apply(&from_bands, &spectrum[4..]);
            let b = apply(&from_rgb, &row[4..]);
            for c in 0..3 {
                difference += (a[c] - b[c]).abs();
                size += a[c].abs();
            }
        }
        println!("{name}: mean relative difference {:.5}", difference / size);
        // integration between the bands against point sums: the files' own difference
        assert!(difference / size < 5e-3, "{name}: {}", difference / size);
    }
}

/// Rows of the matrix found by least squares: wavelength, then R, G, B.
fn derived() -> Option<Rows> {
    let csv = read("cornell/derived_spectral31_to_RGB_matrix.csv")?;
    let lines = csv.lines().filter(|l| !l.starts_with('#'));
    Some(lines.map(|l| numbers(l).collect()).collect())
}

#[test]
fn spectra_give_the_rgb_file_through_the_derived_matrix() {
    let Some(rows) = derived() else {
        return;
    };
    let weights: Vec<[f64; 3]> = rows.iter().map(|r| [r[1], r[2], r[3]]).collect();
    for name in MATERIALS {
        let Some((_, spectra, rgb)) = material(name) else {
            return;
        };
        let (mut worst, mut squares, mut count) = (0.0_f64, 0.0, 0.0);
        for (spectrum, row) in spectra.iter().zip(&rgb) {
            let found = apply(&weights, &spectrum[4..]);
            let size = row[4..].iter().fold(1.0, |m, v| f64::max(m, *v));
            for c in 0..3 {
                let error = (found[c] - row[4 + c]).abs() / size;
                worst = worst.max(error);
                squares += error * error;
                count += 1.0;
            }
        }
        println!(
            "{name}: worst {worst:.2e}, rms {:.2e}",
            f64::sqrt(squares / count)
        );
        // six digits of matrix and files; relative where a peak is above 1
        assert!(worst <= 1e-5, "{name}: {worst:e}");
    }
}

#[test]
fn the_regression_of_both_files_is_this_matrix() {
    let Some(rows) = derived() else {
        return;
    };
    let nm: Vec<f64> = rows.iter().map(|r| r[0]).collect();
    let from_xyz = RgbSpace::trinitron().from_xyz().unwrap();
    for (row, weights) in rows.iter().zip(point_weights(&nm)) {
        let found = transform(&from_xyz, weights);
        for c in 0..3 {
            // its own noise: neighbouring bands of smooth spectra are nearly dependent
            assert!((found[c] - row[1 + c]).abs() < 1e-3, "{row:?}: {found:?}");
        }
    }
}
