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

/// Spectra and RGB of both materials, row by row.
fn both() -> Option<(Vec<f64>, Rows, Rows)> {
    let (mut all_spectra, mut all_rgb, mut bands) = (Rows::new(), Rows::new(), Vec::new());
    for name in MATERIALS {
        let (nm, spectra, rgb) = material(name)?;
        all_spectra.extend(spectra.into_iter().map(|r| r[4..].to_vec()));
        all_rgb.extend(rgb.into_iter().map(|r| r[4..].to_vec()));
        bands = nm;
    }
    Some((bands, all_spectra, all_rgb))
}

/// The matrix from bands to R, G, B that comes nearest to all rows: normal equations, solved again for what is left.
fn derive(spectra: &Rows, rgb: &Rows) -> Vec<[f64; 3]> {
    let n = spectra[0].len();
    let mut normal = vec![vec![0.0; n]; n];
    for row in spectra {
        for i in 0..n {
            for j in 0..n {
                normal[i][j] += row[i] * row[j];
            }
        }
    }
    let lower = cholesky(normal);
    let mut weights = vec![[0.0; 3]; n];
    for _ in 0..3 {
        for c in 0..3 {
            let mut right = vec![0.0; n];
            for (row, value) in spectra.iter().zip(rgb) {
                let left = value[c] - apply(&weights, row)[c];
                (0..n).for_each(|i| right[i] += row[i] * left);
            }
            for (w, step) in weights.iter_mut().zip(solve(&lower, right)) {
                w[c] += step;
            }
        }
    }
    weights
}

/// L of L L^T = a.
fn cholesky(mut a: Rows) -> Rows {
    for i in 0..a.len() {
        for j in 0..=i {
            let sum: f64 = (0..j).map(|k| a[i][k] * a[j][k]).sum();
            let rest = a[i][j] - sum;
            a[i][j] = if i == j { rest.sqrt() } else { rest / a[j][j] };
        }
    }
    a
}

/// x of L L^T x = b.
fn solve(lower: &Rows, mut b: Vec<f64>) -> Vec<f64> {
    let n = b.len();
    for i in 0..n {
        let sum: f64 = (0..i).map(|k| lower[i][k] * b[k]).sum();
        b[i] = (b[i] - sum) / lower[i][i];
    }
    for i in (0..n).rev() {
        let sum: f64 = (i + 1..n).map(|k| lower[k][i] * b[k]).sum();
        b[i] = (b[i] - sum) / lower[i][i];
    }
    b
}

/// The files print six decimals: a value is right to half of the last.
const HALF_DIGIT: f64 = 0.5e-6;

#[test]
fn spectra_give_the_rgb_file_through_the_derived_matrix() {
    let Some((nm, spectra, rgb)) = both() else {
        return;
    };
    let weights = derive(&spectra, &rgb);
    let mut worst = [0.0_f64; 3];
    for (spectrum, row) in spectra.iter().zip(&rgb) {
        let found = apply(&weights, spectrum);
        (0..3).for_each(|c| worst[c] = worst[c].max((found[c] - row[c]).abs()));
    }
    println!("largest residual of R, G, B over all rows: {worst:?}");
    for c in 0..3 {
        // no row is off by more than its digits allow: those of R, G or B and, through the matrix, of 31 bands
        let digits = HALF_DIGIT * (1.0 + weights.iter().map(|w| w[c].abs()).sum::<f64>());
        assert!(worst[c] <= digits && digits < 1e-6, "{worst:?}, {digits}");
    }
    // and it is no free invention: D65, CIE 1931 and Trinitron primaries say the same but for the noise of a regression
    // whose columns, neighbouring bands of smooth spectra, are nearly dependent
    let from_xyz = RgbSpace::trinitron().from_xyz().unwrap();
    for (row, physical) in weights.iter().zip(point_weights(&nm)) {
        let physical = transform(&from_xyz, physical);
        for c in 0..3 {
            assert!((physical[c] - row[c]).abs() < 1e-3, "{row:?}: {physical:?}");
        }
    }
}

#[test]
fn a_matrix_derived_from_one_half_of_the_rows_gives_the_other() {
    let Some((_, spectra, rgb)) = both() else {
        return;
    };
    let half = |rows: &Rows, parity: usize| -> Rows {
        rows.iter().skip(parity).step_by(2).cloned().collect()
    };
    for parity in [0, 1] {
        let weights = derive(&half(&spectra, parity), &half(&rgb, parity));
        let (mut worst, mut count) = (0.0_f64, 0);
        for (spectrum, row) in half(&spectra, 1 - parity)
            .iter()
            .zip(half(&rgb, 1 - parity))
        {
            // rows up to 1: the few peaks beyond, up to 38, lie far outside of what the other half tells
            if row.iter().all(|v| *v <= 1.0) {
                let found = apply(&weights, spectrum);
                (0..3).for_each(|c| worst = worst.max((found[c] - row[c]).abs()));
                count += 1;
            }
        }
        println!("{count} rows of the other half, largest residual {worst:.2e}");
        assert!(count > 1300 && worst <= 1e-5, "{count} rows: {worst:e}");
    }
}
