//! Fits of data whose truth is known.

use crate::common::{Sum, measured, of_model, truth};
use brdf_fit::{FitData, FitError, Metric, Pair, Samples, error_of, families, family, fit};
use glam::DVec3;

/// A text for every family, and its values under the names a fit gives them.
pub(crate) const TRUTHS: &[(&str, &str)] = &[
    ("lambert", "lambert:kd=0.5/0.3/0.1"),
    ("phong", "phong:n=30,ks=0.2/0.2/0.1,kd=0.3/0.2/0.1"),
    ("lewis", "lewis:n=40,ks=0.2/0.2/0.1,kd=0.3/0.2/0.1"),
    (
        "blinn-phong",
        "blinn-phong:n=120,ks=0.1/0.2/0.3,kd=0.3/0.2/0.1",
    ),
    ("ward", "ward:alpha=0.2,ks=0.1/0.05/0.02,kd=0.3/0.2/0.1"),
    (
        "ward-cheap",
        "ward-cheap:alpha=0.2,ks=0.1/0.05/0.02,kd=0.3/0.2/0.1",
    ),
    (
        "ward-duer",
        "ward-duer:alpha=0.15,ks=0.1/0.05/0.02,kd=0.3/0.2/0.1",
    ),
    (
        "ward-gmd",
        "ward-gmd:alpha=0.15,ks=0.1/0.05/0.02,kd=0.3/0.2/0.1",
    ),
    (
        "cook-torrance",
        "cook-torrance:m=0.2,f0=0.06,ks=0.8,kd=0.3/0.2/0.1",
    ),
    (
        "ggx",
        "ggx:alpha=0.2,f0=0.3,ks=0.8/0.6/0.4,kd=0.03/0.02/0.01",
    ),
    ("oren-nayar", "oren-nayar:sigma=0.4,kd=0.7/0.4/0.2"),
    ("eon", "eon:r=0.6,kd=0.7/0.4/0.2"),
    (
        "lafortune",
        "lafortune:ks=0.2/0.15/0.1,n=25,cx=-1,cz=0.8,kd=0.3/0.2/0.1",
    ),
    (
        "ashikhmin-lobe",
        "ashikhmin-lobe:n=60,f0=0.2,ks=0.9/0.6/0.3,kd=0.3/0.2/0.1",
    ),
    (
        "cook-torrance-smith",
        "cook-torrance-smith:m=0.2,f0=0.06,ks=0.8,kd=0.3/0.2/0.1",
    ),
    (
        "he",
        "he:sigma=0.3,tau=3,f0=0.1,mirror=0,ks=0.9/0.6/0.3,kd=0.3/0.2/0.1",
    ),
    ("abc", "abc:a=5/4/3,b=100,c=1.5,n=1.6,kd=0.3/0.2/0.1"),
    ("abg", "abg:a=0.02/0.015/0.01,b=0.01,g=2,kd=0.3/0.2/0.1"),
    (
        "harvey-shack",
        "harvey-shack:b0=2/1/0.5,l=0.1,s=-2.5,kd=0.3/0.2/0.1",
    ),
    // with b=2 the peak of the lobe is a quarter of the diffuse part, four times the noise of one cell: of 32 fits to 960
    // cells 7 end at the least slope, 2.001, and 2 at the largest, and ks, a factor of (s - 2) b^2, takes up the difference
    (
        "k-correlation",
        "k-correlation:b=6,s=3,ks=0.9/0.6/0.3,kd=0.3/0.2/0.1",
    ),
    (
        "koenderink-2",
        "koenderink:kd=0.6/0.4/0.2,a=0.1,a2=-0.05,a3=0.08,a4=0.02",
    ),
];

#[test]
fn every_family_has_a_truth() {
    for name in families() {
        assert!(TRUTHS.iter().any(|(n, _)| *n == name), "{name}");
    }
}

#[test]
fn data_without_noise_give_the_parameters_back() {
    for (name, text) in TRUTHS.iter().filter(|(name, _)| *name != "he") {
        gives_back(name, text);
    }
}

#[test]
fn slow_he_gives_its_parameters_back() {
    let (name, text) = TRUTHS.iter().find(|(name, _)| *name == "he").unwrap();
    gives_back(name, text);
}

fn gives_back(name: &str, text: &str) {
    let data = FitData::new(measured(text, [12, 12, 20], 0.0, 0), Metric::Ngan);
    let fit = fit(&*family(name, 1).unwrap(), &data).unwrap();
    for estimate in &fit.estimates {
        let expected = truth(text, estimate);
        // the table holds single precision: 6e-8 of every value, more of what little depends on a parameter
        assert!(
            (estimate.value - expected).abs() < 2e-5 * expected.abs() + 1e-7,
            "{text}: {estimate:?}, expected {expected}"
        );
    }
}

#[test]
fn every_metric_gives_the_parameters_back() {
    let (name, text) = TRUTHS[4];
    for metric in Metric::ALL {
        let data = FitData::new(measured(text, [10, 10, 16], 0.0, 0), metric);
        let fit = fit(&*family(name, 1).unwrap(), &data).unwrap();
        for estimate in &fit.estimates {
            let expected = truth(text, estimate);
            assert!(
                (estimate.value - expected).abs() < 1e-5 * expected,
                "{metric}: {estimate:?}, expected {expected}"
            );
        }
    }
}

#[test]
fn each_metric_is_smallest_where_it_was_minimised() {
    // a model that cannot fit: the metrics disagree about what matters
    let samples = of_model("ggx:alpha=0.3,f0=0.5,ks=0.6,kd=0.1", [14, 14, 28]);
    let family = family("ward", 1).unwrap();
    let fits: Vec<_> = (Metric::ALL.into_iter())
        .map(|metric| fit(&*family, &FitData::new(samples.clone(), metric)).unwrap())
        .collect();
    for own in &fits {
        for other in &fits {
            let error = error_of(&Sum::of(other), &samples, own.metric);
            assert!(
                own.error <= error * (1.0 + 1e-9),
                "{}: {} by its own fit, {error} by that of {}",
                own.metric,
                own.error,
                other.metric
            );
        }
    }
}

#[test]
fn the_text_of_a_fit_is_the_fit() {
    for (name, text) in TRUTHS.iter().filter(|(name, _)| *name != "he") {
        let samples = of_model(text, [6, 6, 8]);
        let data = FitData::new(samples.clone(), Metric::CubeRoot);
        // one family of several lobes stands for all
        for lobes in if *name == "ward" { 1..=2 } else { 1..=1 } {
            let fit = fit(&*family(name, lobes).unwrap(), &data).unwrap();
            let error = error_of(&Sum::of(&fit), &samples, Metric::CubeRoot);
            // EON and Oren-Nayar: interpolation in the albedo; small errors: rounding of cube roots
            assert!(
                (error - fit.error).abs() < 1e-6 * error + 1e-8,
                "{:?}: {error} {}",
                fit.parts,
                fit.error
            );
        }
    }
}

#[test]
fn two_lobes_are_told_apart() {
    let text = "lafortune:ks=0.2,n=8,cx=-0.9,cz=1,ks2=0.1,n2=200,cx2=-1,cz2=1,kd=0.2";
    let data = FitData::new(of_model(text, [24, 20, 40]), Metric::Ngan);
    let two = fit(&*family("lafortune", 2).unwrap(), &data).unwrap();
    let one = fit(&*family("lafortune", 1).unwrap(), &data).unwrap();
    assert!(two.error < 1e-4 * one.error, "{} {}", two.error, one.error);
    let mut exponents = [two.shape[0], two.shape[2]];
    exponents.sort_by(f64::total_cmp);
    assert!(
        (exponents[0] - 8.0).abs() < 1e-2 && (exponents[1] - 200.0).abs() < 1e-1,
        "{exponents:?}"
    );
}

#[test]
fn threads_do_not_change_a_bit() {
    let data = FitData::new(measured(TRUTHS[4].1, [20, 20, 30], 0.05, 3), Metric::Log);
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        let fit = pool
            .install(|| fit(&*family("ward", 1).unwrap(), &data))
            .unwrap();
        (
            fit.error.to_bits(),
            fit.parts,
            format!("{:?}", fit.estimates),
        )
    };
    assert_eq!(with(1), with(4), "one thread and four");
}

#[test]
fn errors_of_constants_follow_by_hand() {
    let samples = Samples::on_grid([90, 90, 90], 1, |_, _, out| {
        out[0] = 1.0;
        true
    });
    struct Product;
    impl brdf::Brdf<1> for Product {
        fn eval(&self, wi: DVec3, wo: DVec3) -> [f64; 1] {
            [wi.z * wo.z]
        }
    }
    let lambert = brdf_models::parse_model_n::<1>("lambert:kd=1")
        .unwrap()
        .built
        .brdf;
    let rho = std::f64::consts::FRAC_1_PI;
    // means over the hemisphere: of ci^2 1/3; of (..)^2 under 2 ci dci by Simpson's rule
    let simpson = |f: &dyn Fn(f64) -> f64| {
        let g = |c: f64| 2.0 * c * f(c) * f(c);
        (0..1000)
            .map(|k| {
                let a = f64::from(k) / 1000.0;
                (g(a) + 4.0 * g(a + 0.0005) + g(a + 0.001)) / 6000.0
            })
            .sum::<f64>()
    };
    let cases = [
        (Metric::Ngan, (1.0 - rho) / 3.0_f64.sqrt()),
        (
            Metric::Log,
            simpson(&|c| ((1.0 + c) / (1.0 + rho * c)).ln()),
        ),
        (
            Metric::CubeRoot,
            simpson(&|c| c.cbrt() - (rho * c).cbrt()).sqrt(),
        ),
        // proportional: a perfect proposal
        (Metric::RelVar, 0.0),
    ];
    for (metric, expected) in cases {
        let error = error_of(&*lambert, &samples, metric);
        // cells cut by the horizon
        assert!(
            (error - expected).abs() < 5e-3 * expected + 1e-12,
            "{metric}: {error} {expected}"
        );
    }
    // (integral dwi dwo)(integral (ci co)^2 dwi dwo)/pi^4 - 1 = 4 pi^2 (2 pi/3)^2/pi^4 - 1
    let error = error_of(&Product, &samples, Metric::RelVar);
    assert!((error - 7.0 / 9.0).abs() < 1e-2, "{error}");
}

#[test]
fn what_cannot_be_fitted_is_refused_in_one_line() {
    let message = |e: FitError| e.to_string();
    assert!(
        message(family("wart", 1).err().unwrap())
            .starts_with("no model `wart` to fit; those that can be fitted are lambert,"),
        "name"
    );
    assert_eq!(
        message(family("ward", 4).err().unwrap()),
        "model `ward`: expected 1 to 3 lobes, found 4"
    );
    assert_eq!(
        message(family("eon", 2).err().unwrap()),
        "model `eon`: expected one lobe, found 2"
    );
    let ward = family("ward", 1).unwrap();
    let black = Samples::on_grid([10, 10, 10], 3, |_, _, _| true);
    let refused = fit(&*ward, &FitData::new(black, Metric::Ngan));
    assert_eq!(
        message(refused.err().unwrap()),
        "expected positive reflectance, found none"
    );
    let mut few = Samples::new(1);
    let pair = Pair {
        wi: DVec3::Z,
        wo: DVec3::Z,
        weight: 1.0,
    };
    few.push(pair, &[1.0]);
    let refused = fit(&*ward, &FitData::new(few, Metric::Ngan));
    assert_eq!(
        message(refused.err().unwrap()),
        "expected at least 3 measurements above the horizon, found 1"
    );
}
