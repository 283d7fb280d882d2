//! The sigmoid uplift: round trip, smoothness, energy.

use spectrum::matrix::transform;
use spectrum::{
    Basis, Illuminant, Observer, SigmoidFit, SigmoidFitter, Viewing, table_srgb_from_xyz,
};
use testkit::assert_close;

/// Colours of a grid of `n`^3 over the sRGB cube, edges included.
fn cube(n: usize) -> impl Iterator<Item = [f64; 3]> {
    let at = move |k: usize| k as f64 / (n - 1) as f64;
    (0..n * n * n).map(move |q| [q / (n * n), q / n % n, q % n].map(at))
}

#[test]
fn round_trip_over_the_cube() {
    let (fitter, viewing) = (SigmoidFitter::new(), Viewing::standard());
    let matrix = table_srgb_from_xyz(&viewing);
    let mut worst = 0.0_f64;
    for rgb in cube(9) {
        let spectrum = fitter.fit(rgb).sigmoid.spectrum();
        assert!(
            spectrum.values().iter().all(|v| (0.0..=1.0).contains(v)),
            "energy: {rgb:?}"
        );
        // by exact integrals, not by the solver's own weights
        let found = transform(&matrix, viewing.xyz(&spectrum));
        for c in 0..3 {
            worst = worst.max((found[c] - rgb[c]).abs());
        }
    }
    println!("worst of 9^3 colours: {worst:.1e}");
    // the solver stops at 1e-9; the issue asks for 1e-3
    assert!(worst < 2e-9, "{worst:e}");
}

#[test]
fn slow_round_trip_over_a_dense_cube() {
    let fitter = SigmoidFitter::new();
    let fits: Vec<SigmoidFit> = cube(33).map(|rgb| fitter.fit(rgb)).collect();
    let worst = fits.iter().fold(0.0, |m, f| f64::max(m, f.error));
    let steps = fits.iter().map(|f| f.steps).max();
    println!("worst of 33^3 colours: {worst:.1e}, at most {steps:?} steps");
    assert!(worst < 2e-9, "{worst:e}");
}

/// Wavelengths, and how much of the sum X + Y + Z of white each is.
fn visible() -> (Vec<f64>, Vec<f64>) {
    let nm: Vec<f64> = (0..69).map(|k| 380.0 + 5.0 * f64::from(k)).collect();
    let weights = Basis::Bands(nm.clone()).xyz_weights(&Viewing::standard());
    let total: f64 = weights.iter().flatten().sum();
    let parts = weights.iter().map(|w| w.iter().sum::<f64>() / total);
    (nm, parts.collect())
}

/// The mean difference of two colours' reflectances, by how much is seen of each wavelength.
fn distance(fitter: &SigmoidFitter, a: [f64; 3], b: [f64; 3], eye: &(Vec<f64>, Vec<f64>)) -> f64 {
    let [a, b] = [a, b].map(|rgb| fitter.fit(rgb).sigmoid);
    let terms = eye.0.iter().zip(&eye.1);
    terms
        .map(|(nm, part)| (a.at(*nm) - b.at(*nm)).abs() * part)
        .sum()
}

#[test]
fn neighbouring_colours_have_neighbouring_spectra() {
    let fitter = SigmoidFitter::new();
    let eye = visible();
    let step = 1.0 / 8.0;
    let mut edges = Vec::new();
    for rgb in cube(9) {
        for c in (0..3).filter(|c| rgb[*c] + step < 1.0 + 1e-9) {
            let mut next = rgb;
            next[c] += step;
            edges.push((distance(&fitter, rgb, next, &eye), rgb, next));
        }
    }
    edges.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!(
        "largest {:.4}, median {:.4}",
        edges[0].0,
        edges[edges.len() / 2].0
    );
    // measured 1.4 steps at most, at the edges of the cube, where spectra become steps
    assert!(edges[0].0 < 2.0 * step, "{:?}", edges[0]);
    // no jump: along the worst edges, an eighth of the way is near an eighth of the distance
    for (whole, from, to) in edges.iter().take(40) {
        let at = |k: u8| -> [f64; 3] {
            let u = f64::from(k) / 8.0;
            std::array::from_fn(|c| from[c] + u * (to[c] - from[c]))
        };
        for k in 0..8 {
            let part = distance(&fitter, at(k), at(k + 1), &eye);
            // a jump would leave one part as long as the whole
            assert!(
                part < 0.5 * whole,
                "{from:?} to {to:?}, part {k}: {part} of {whole}"
            );
        }
    }
}

#[test]
fn unbounded_colours_scale() {
    let fitter = SigmoidFitter::new();
    let (viewing, rgb) = (Viewing::standard(), [7.0, 0.5, 0.02]);
    let fit = fitter.fit_unbounded(rgb);
    assert_close(fit.scale, 14.0, 0.0, "twice the largest");
    let spectrum = fit.sigmoid.spectrum().scaled(fit.scale);
    let found = transform(&table_srgb_from_xyz(&viewing), viewing.xyz(&spectrum));
    for c in 0..3 {
        assert_close(found[c], rgb[c], 2e-8, "14 times the solver's 1e-9");
    }
    assert_close(fitter.fit_unbounded([0.0; 3]).scale, 0.0, 0.0, "black");
}

#[test]
fn colours_out_of_reach_say_so() {
    let fitter = SigmoidFitter::new();
    for rgb in [[1.2, 1.0, 1.0], [0.9, -0.3, 0.0], [f64::NAN, 0.1, 0.1]] {
        let fit = fitter.fit(rgb);
        assert!(fit.error > 1e-3 || fit.error.is_nan(), "{rgb:?}: {fit:?}");
    }
}

#[test]
fn emission_has_the_colour_of_its_rgb() {
    let fitter = SigmoidFitter::new();
    let observer = Observer::CIE_1931;
    let (eye, range) = (observer.spectra(), observer.range_nm());
    let y = eye[1].integral(range);
    let rgb = [0.4, 2.0, 1.0];
    let light = fitter.emission(rgb, &Illuminant::D65.spectrum());
    let xyz = eye.map(|cmf| spectrum::Spectrum::integral_of_product([&light, &cmf], range) / y);
    let found = transform(&table_srgb_from_xyz(&Viewing::standard()), xyz);
    for c in 0..3 {
        // light times reflectance is taken as linear within a nm
        assert_close(found[c], rgb[c], 1e-4, "emission");
    }
}
