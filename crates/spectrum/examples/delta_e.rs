//! Prints how wrong fixed bins are: CIEDE2000 of 400 reflectances against 1 nm, by light, bins and bounces
//! (`docs/colour.md`). `cargo run --release -p spectrum --example delta_e`

#![expect(clippy::print_stdout, reason = "a table for people")]

use spectrum::{
    Basis, Bins, Illuminant, Observer, Sigmoid, SigmoidFitter, Spectrum, Viewing, ciede2000,
    lab_from_xyz,
};

const COUNT: usize = 400;

/// Sigmoids of colours that fill the sRGB cube evenly: the golden ratio's sequence in three dimensions [Roberts2018].
fn reflectances() -> Vec<Sigmoid> {
    let fitter = SigmoidFitter::new();
    let g = 1.220_744_084_605_759_5_f64;
    (1..=COUNT)
        .map(|k| {
            let rgb = [1, 2, 3].map(|d| (0.5 + k as f64 / g.powi(d)).fract());
            fitter.fit(rgb).sigmoid
        })
        .collect()
}

/// Mean and 95th percentile.
fn summary(mut differences: Vec<f64>) -> String {
    differences.sort_by(f64::total_cmp);
    let mean = differences.iter().sum::<f64>() / COUNT as f64;
    format!("{mean:.3}/{:.3}", differences[COUNT * 95 / 100])
}

/// What a renderer would say the colour is after some bounces, given weights and values of its channels.
fn colour(weights: &[[f64; 3]], values: &[f64], bounces: i32) -> [f64; 3] {
    std::array::from_fn(|c| {
        weights
            .iter()
            .zip(values)
            .map(|(w, v)| w[c] * v.powi(bounces))
            .sum()
    })
}

/// Light times colour-matching functions at the middles: what not to do.
fn naive_weights(middles: &[f64], viewing: &Viewing) -> Vec<[f64; 3]> {
    let products: Vec<[f64; 3]> = middles
        .iter()
        .map(|nm| {
            Observer::CIE_1931
                .at(*nm)
                .map(|v| v * viewing.light().at(*nm))
        })
        .collect();
    let y: f64 = products.iter().map(|p| p[1]).sum();
    products.into_iter().map(|p| p.map(|v| v / y)).collect()
}

/// Differences of 1 and of 3 bounces with exact weights and means, and of 1 bounce sampled at the middles.
fn row(bins: &Bins, viewing: &Viewing, sigmoids: &[Sigmoid]) -> [String; 3] {
    let middles: Vec<f64> = bins.centres_nm().collect();
    let exact = Basis::Bins(bins.clone()).xyz_weights(viewing);
    let naive = naive_weights(&middles, viewing);
    let white = viewing.white();
    let mut differences = [Vec::new(), Vec::new(), Vec::new()];
    for sigmoid in sigmoids {
        let fine = sigmoid.spectrum();
        let means = bins.means(&fine);
        let points: Vec<f64> = middles.iter().map(|nm| sigmoid.at(*nm)).collect();
        let found = [
            (colour(&exact, &means, 1), 1),
            (colour(&exact, &means, 3), 3),
            (colour(&naive, &points, 1), 1),
        ];
        for (out, (xyz, bounces)) in differences.iter_mut().zip(found) {
            let truth: Spectrum = fine.map(|_, v| v.powi(bounces));
            let lab = |xyz| lab_from_xyz(xyz, white);
            out.push(ciede2000(lab(viewing.xyz(&truth)), lab(xyz)));
        }
    }
    differences.map(summary)
}

fn main() {
    let sigmoids = reflectances();
    let uniform = |n, from, to| Bins::uniform(n, [from, to]);
    let bins = [
        uniform(3, 380.0, 720.0),
        uniform(8, 380.0, 720.0),
        uniform(8, 400.0, 700.0),
        uniform(16, 380.0, 720.0),
        uniform(31, 395.0, 705.0),
        uniform(45, 380.0, 720.0),
        uniform(45, 380.0, 780.0),
        uniform(65, 380.0, 720.0),
        uniform(65, 377.5, 702.5),
    ];
    println!("mean/95 % CIEDE2000 of {COUNT} sigmoid reflectances against 1 nm");
    println!("light  bins              1 bounce     3 bounces    1 bounce, at the middles");
    for light in [Illuminant::D65, Illuminant::A, Illuminant::F11] {
        let viewing = Viewing::new(&light.spectrum(), &Observer::CIE_1931);
        for bins in bins.iter().flatten() {
            let edges = bins.edges_nm();
            let [one, three, naive] = row(bins, &viewing, &sigmoids);
            let range = format!("{}-{}", edges[0], edges[bins.len()]);
            println!(
                "{light:<5} {:>3} {range:<12} {one:>13} {three:>13} {naive:>13}",
                bins.len()
            );
        }
    }
}
