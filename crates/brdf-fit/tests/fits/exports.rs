//! Texts for other programs say what the fit says.

use crate::common::{Sum, of_model};
use brdf::{Brdf, direction};
use brdf_fit::export::{MetalMix, Model3, Shadowing, exports};
use brdf_fit::{FitData, Metric, error_of, family, fit};

const DIMS: [usize; 3] = [16, 16, 24];

#[test]
fn texts_carry_the_numbers() {
    let samples = of_model("ward:alpha=0.2,ks=0.1,kd=0.3/0.2/0.1", DIMS);
    let data = FitData::new(samples.clone(), Metric::Ngan);
    let ward = fit(&*family("ward", 1).unwrap(), &data).unwrap();
    let ggx = fit(&*family("ggx", 1).unwrap(), &data).unwrap();
    let abg = fit(&*family("abg", 1).unwrap(), &data).unwrap();
    let all = exports(&ward, (&ggx, &abg), &samples).unwrap();
    let targets: Vec<_> = all.iter().map(|e| e.target).collect();
    assert_eq!(targets, ["scene", "mitsuba", "pbrt", "glsl", "abg"]);
    assert!(
        all[0]
            .text
            .contains(&format!("Model(model: \"{}\")", ward.parts[0].text)),
        "{}",
        all[0].text
    );
    // 0.3/pi, 0.2/pi, 0.1/pi
    assert!(
        all[3]
            .text
            .contains("vec3(0.0954930, 0.0636620, 0.0318310)"),
        "{}",
        all[3].text
    );
    assert!(
        all[3].text.contains("ward(tan2, 0.2000000)"),
        "{}",
        all[3].text
    );
    for export in &all {
        assert!(
            export.error.is_finite() && export.error >= ward.error * 0.999,
            "{export:?}"
        );
    }
    // a renderer without the model is told so, and its own error is another
    assert!(
        all[2].model.contains("GGX") && all[2].error > ward.error,
        "{:?}",
        all[2]
    );
}

#[test]
fn a_metal_is_exported_to_renderers_almost_as_it_is() {
    // k of a metal of index 1 + ik that reflects 0.8, 0.6, 0.4
    let k = [0.8_f64, 0.6, 0.4]
        .map(|r| (2.0 * (r / (1.0 - r)).sqrt()).to_string())
        .join("/");
    let text = format!("ggx:alpha=0.3,n=1,k={k},ks=1,kd=0");
    let samples = of_model(&text, DIMS);
    let data = FitData::new(samples.clone(), Metric::Ngan);
    let ggx = fit(&*family("ggx", 1).unwrap(), &data).unwrap();
    let (mix, error) = MetalMix::nearest(&ggx, &samples, Metric::Ngan, Shadowing::Correlated);
    let black = error_of(
        &*brdf_models::parse_model("lambert:kd=0").unwrap().built.brdf,
        &samples,
        Metric::Ngan,
    );
    // three channels share the fit's dielectric Fresnel curve, which is no metal's: 6 % of the data remain
    assert!(error < 0.1 * black, "{mix:?}: {error} of {black}");
}

#[test]
fn separable_masking_is_darker() {
    let mix = |shadowing| MetalMix {
        amount: 0.5,
        diffuse: [0.2; 3],
        reflectance: [0.5; 3],
        alpha: 0.6,
        shadowing,
    };
    let (wi, wo) = (direction(1.2, 0.0), direction(1.0, 3.0));
    let (a, b) = (
        mix(Shadowing::Correlated).eval(wi, wo)[0],
        mix(Shadowing::Separable).eval(wi, wo)[0],
    );
    assert!(b < a, "{a} {b}");
}

#[test]
fn parts_are_read_back() {
    let samples = of_model("ggx:alpha=0.4,f0=0.3,ks=0.5,kd=0.2", DIMS);
    let data = FitData::new(samples, Metric::Ngan);
    let two = fit(&*family("ward", 2).unwrap(), &data).unwrap();
    let (model, sum) = (Model3::new(&two.parts).unwrap(), Sum::of(&two));
    let (wi, wo) = (direction(0.5, 0.1), direction(0.9, 2.0));
    assert_eq!(
        model.eval(wi, wo).map(f64::to_bits),
        sum.eval(wi, wo).map(f64::to_bits)
    );
}

/// The numbers of the exported table, a row a channel: wavelength, A, B, g, lambert, TIS.
fn abg_rows(text: &str) -> Vec<Vec<f64>> {
    let lines = text.lines().filter(|l| !l.starts_with('#'));
    let row = |l: &str| l.split(' ').skip(1).map(|n| n.parse().unwrap()).collect();
    lines.map(row).collect()
}

/// The error of the exported table, read as another program would, and the one it was exported with.
fn abg_there_and_back(text: &str) -> (Vec<Vec<f64>>, f64, f64) {
    let samples = of_model(text, DIMS);
    let data = FitData::new(samples.clone(), Metric::Log);
    let [ggx, abg] = ["ggx", "abg"].map(|n| fit(&*family(n, 1).unwrap(), &data).unwrap());
    let all = exports(&abg, (&ggx, &abg), &samples).unwrap();
    let export = all.iter().find(|e| e.target == "abg").unwrap();
    let rows = abg_rows(&export.text);
    let column = |k: usize| -> [f64; 3] { std::array::from_fn(|c| rows[c][k]) };
    let model = brdf_models::Abg {
        a: column(1),
        b: rows[0][2],
        g: rows[0][3],
        diffuse: column(4),
    };
    let read = error_of(&model, &samples, Metric::Log);
    (rows, read, export.error)
}

#[test]
fn abg_numbers_are_read_back() {
    let (rows, ..) = abg_there_and_back("abg:a=0.02/0.015/0.01,b=0.01,g=2,kd=0.02/0.01/0");
    for (row, (a, kd)) in (rows.iter()).zip([(0.02, 0.02), (0.015, 0.01), (0.01, 0.0)]) {
        // at normal incidence and g = 2: pi A ln(1 + 1/B)
        let tis = std::f64::consts::PI * a * (1.0_f64 / 0.01).ln_1p();
        for (k, expected, error) in [
            (1, a, 1e-6),
            (2, 0.01, 1e-6),
            (3, 2.0, 1e-6),
            (4, kd, 1e-6),
            // the lattice of the integral
            (5, tis, 5e-4),
        ] {
            let off = (row[k] - expected).abs();
            assert!(off < error * expected + 1e-9, "{row:?}: {k} {expected}");
        }
    }
    // a polished surface by another theory: the table is the fit, to its nine digits
    let (rows, read, fitted) = abg_there_and_back("k-correlation:sigma=10,b=10,s=2.5,lambda=rgb");
    assert!(
        (read / fitted - 1.0).abs() < 1e-6,
        "{rows:?}: {read} {fitted}"
    );
}
