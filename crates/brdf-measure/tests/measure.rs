//! What the virtual instrument writes is what the model says, and its flaws are what they claim.

use brdf::{Brdf, HalfDiff, direction};
use brdf_formats::{AstmFile, MERL_SCALE, MerlFile};
use brdf_measure::{
    Bracketing, Instrument, MERL_DIMS, cornell_directions, measure_astm, measure_merl,
};
use brdf_models::{Lambert, parse_model, parse_model_n};
use spectrum::{Basis, RgbSpace};
use std::f64::consts::{FRAC_1_PI, FRAC_PI_2, PI};

const SMALL: [u32; 3] = [12, 10, 16];
const GREY: Lambert<3> = Lambert { albedo: [0.5; 3] };

/// Centre of a cell, written down a second time.
fn centre(dims: [u32; 3], cell: usize) -> HalfDiff {
    let [n_h, n_d, n_p] = dims.map(|n| n as usize);
    let at = |k: usize, n: usize| (k as f64 + 0.5) / n as f64;
    HalfDiff {
        theta_h: at(cell / (n_d * n_p), n_h).powi(2) * FRAC_PI_2,
        theta_d: at(cell / n_p % n_d, n_d) * FRAC_PI_2,
        phi_d: at(cell % n_p, n_p) * PI,
    }
}

#[test]
fn merl_cells_hold_the_model() {
    let model = parse_model("ward-gmd:alpha=0.2,ks=0.3,kd=0.4/0.2/0.1").unwrap();
    let brdf = &*model.built.brdf;
    let file = measure_merl(brdf, SMALL, &Instrument::default(), 0).unwrap();
    let mut above = 0;
    for cell in 0..file.cells() {
        let (wi, wo) = centre(SMALL, cell).directions();
        if wi.z.min(wo.z) <= 1e-9 {
            continue;
        }
        above += 1;
        let f = brdf.eval(wi, wo);
        for c in 0..3 {
            let value = file.value(c, cell) * MERL_SCALE[c];
            assert!(
                (value / f[c] - 1.0).abs() < 1e-12,
                "cell {cell}: {value} {}",
                f[c]
            );
        }
    }
    assert!(above > file.cells() / 2, "{above} cells above the horizon");
}

#[test]
fn merl_mask_has_a_margin_of_one_bin() {
    let file = measure_merl(&GREY, SMALL, &Instrument::default(), 0).unwrap();
    let [n_h, n_d, n_p] = SMALL.map(|n| n as usize);
    let index = |h: usize, d: usize, p: usize| p + n_p * (d + n_d * h);
    let above = |cell| {
        let (wi, wo) = centre(SMALL, cell).directions();
        wi.z.min(wo.z) > 0.0
    };
    let near = |k: usize, n: usize| k.saturating_sub(1)..(k + 2).min(n);
    let mut missing = 0;
    for (h, d, p) in (0..file.cells()).map(|c| (c / (n_d * n_p), c / n_p % n_d, c % n_p)) {
        let expected = near(h, n_h).any(|h| {
            near(d, n_d).any(|d| {
                [p + n_p - 1, p, p + 1]
                    .iter()
                    .any(|p| above(index(h, d, p % n_p)))
            })
        });
        let value = file.value(0, index(h, d, p)) * MERL_SCALE[0];
        if expected {
            assert!(
                (value - 0.5 * FRAC_1_PI).abs() < 1e-12,
                "({h}, {d}, {p}) holds {value}"
            );
        } else {
            missing += 1;
            assert_eq!(
                file.value(0, index(h, d, p)).to_bits(),
                (-1.0_f64).to_bits(),
                "({h}, {d}, {p})"
            );
        }
    }
    assert!(missing > 0, "no cell is missing");
}

#[test]
fn merl_layout_is_the_published_one() {
    let file = measure_merl(&GREY, MERL_DIMS, &Instrument::default(), 0).unwrap();
    assert_eq!(
        file.to_bytes().len(),
        34_992_012,
        "size of a published file"
    );
    assert!(MerlFile::from_bytes(file.to_bytes()).is_ok(), "reads back");
}

#[test]
fn same_seed_same_bits_whatever_the_threads() {
    let noisy = Instrument {
        noise: 0.05,
        bracketing: Some(Bracketing::MERL),
        ..Instrument::default()
    };
    let make = |threads, seed| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| measure_merl(&GREY, SMALL, &noisy, seed).unwrap().to_bytes())
    };
    assert_eq!(make(1, 7), make(3, 7), "threads must not matter");
    assert_ne!(make(1, 7), make(1, 8), "the seed must");
}

#[test]
fn noise_has_its_moments() {
    let sigma = 0.2;
    let noisy = Instrument {
        noise: sigma,
        ..Instrument::default()
    };
    let file = measure_merl(&GREY, [30, 30, 60], &noisy, 3).unwrap();
    let mut ratios = Vec::new();
    for c in 0..3 {
        ratios.extend(
            file.plane(c)
                .filter(|v| *v > 0.0)
                .map(|v| v * MERL_SCALE[c] / (0.5 * FRAC_1_PI)),
        );
    }
    let n = ratios.len() as f64;
    let mean = ratios.iter().sum::<f64>() / n;
    let log_mean = ratios.iter().map(|r| r.ln()).sum::<f64>() / n;
    let log_variance = ratios
        .iter()
        .map(|r| (r.ln() - log_mean).powi(2))
        .sum::<f64>()
        / n;
    // five standard errors
    assert!(
        (mean - 1.0).abs() < 5.0 * sigma * 1.02 / n.sqrt(),
        "mean {mean} of {n}"
    );
    assert!(
        (log_variance / (sigma * sigma) - 1.0).abs() < 5.0 * (2.0 / n).sqrt(),
        "variance {log_variance}"
    );
}

#[test]
fn bracketing_is_coarse_but_close() {
    let camera = Instrument {
        bracketing: Some(Bracketing::MERL),
        ..Instrument::default()
    };
    let exact = measure_merl(&GREY, SMALL, &Instrument::default(), 0).unwrap();
    let read = measure_merl(&GREY, SMALL, &camera, 0).unwrap();
    // half a code of 1023 / 2^1.11 where f cos is above the longest exposure's full scale
    let ratios: Vec<f64> = exact
        .plane(0)
        .zip(read.plane(0))
        .filter(|(a, _)| *a > 0.0)
        .map(|(a, b)| b / a)
        .collect();
    let far = ratios
        .iter()
        .filter(|r| (*r - 1.0).abs() > 0.5 / (1023.0 / 2.17))
        .count();
    assert!(
        far < ratios.len() / 20,
        "{far} of {} off by more than half a code",
        ratios.len()
    );
    assert!(
        ratios.iter().any(|r| (r - 1.0).abs() > 1e-5),
        "nothing was quantised"
    );
}

#[test]
fn impossible_requests_are_refused() {
    let refused = |i: Instrument| measure_merl(&GREY, SMALL, &i, 0).unwrap_err().to_string();
    let e = refused(Instrument {
        noise: -1.0,
        ..Instrument::default()
    });
    assert_eq!(e, "instrument: noise is -1, expected 0 to 10");
    let e = refused(Instrument {
        noise: f64::NAN,
        ..Instrument::default()
    });
    assert!(e.contains("noise is NaN"), "{e}");
    let b = Bracketing {
        bits: 0,
        ..Bracketing::MERL
    };
    let e = refused(Instrument {
        bracketing: Some(b),
        ..Instrument::default()
    });
    assert!(e.contains("bits is 0"), "{e}");
    assert!(
        measure_merl(&GREY, [0, 1, 1], &Instrument::default(), 0).is_err(),
        "no cells"
    );
    let bands = Basis::Bands(vec![500.0, 600.0]);
    let e = measure_astm(&GREY, &bands, "grey", &Instrument::default(), 0).unwrap_err();
    assert_eq!(
        e.to_string(),
        "the file is to have 2 channels, the reflectance has 3"
    );
}

#[test]
fn astm_rows_hold_the_model() {
    let model = parse_model("cook-torrance:m=0.2,f0=0.05,ks=0.6,kd=0.4/0.2/0.1").unwrap();
    let srgb = Basis::Rgb(RgbSpace::srgb());
    let file = measure_astm(
        &*model.built.brdf,
        &srgb,
        &model.to_string(),
        &Instrument::default(),
        0,
    )
    .unwrap();
    assert_eq!(file.row_count(), 1520, "8 incidences of 190 directions");
    for row in 0..file.row_count() {
        let [ti, pi, ts, ps] = file.angles(row);
        let f = model.built.brdf.eval(direction(ti, pi), direction(ts, ps));
        for c in 0..3 {
            // six decimals, and the colour matrices' own rounding
            assert!(
                (file.values(row)[c] - f[c]).abs() < 5.01e-7,
                "row {row}: {} {}",
                file.values(row)[c],
                f[c]
            );
        }
    }
    let again = AstmFile::from_bytes(&file.to_bytes()).unwrap();
    assert_eq!(again.rows(), file.rows(), "six decimals hold the rows");
    assert_eq!(
        again.field("SAMPLE_NAME"),
        Some(model.to_string()),
        "the header names the model"
    );
    assert!(
        again
            .field("LAB_COMMENTS")
            .unwrap()
            .contains("not measured"),
        "the header is honest"
    );
}

#[test]
fn astm_takes_bands_and_xyz() {
    let bands: Vec<f64> = (0..31).map(|k| f64::from(400 + 10 * k)).collect();
    let model = parse_model_n::<31>("lambert:kd=0.3").unwrap();
    let file = measure_astm(
        &*model.built.brdf,
        &Basis::Bands(bands),
        "grey",
        &Instrument::default(),
        0,
    )
    .unwrap();
    assert_eq!(file.value_columns()[30], "700nm", "columns are the bands");
    assert!(
        (file.values(5)[17] - 0.3 * FRAC_1_PI).abs() < 1e-6,
        "{}",
        file.values(5)[17]
    );
    let file = measure_astm(&GREY, &Basis::Xyz, "grey", &Instrument::default(), 0).unwrap();
    assert!(
        (file.values(0)[1] - 0.5 * FRAC_1_PI).abs() < 1e-6,
        "Y of grey is its f"
    );
}

#[test]
fn cornell_grid_is_the_published_one() {
    let all = cornell_directions(0.0);
    assert_eq!(all.len(), 1520, "8 incidences of 190 directions");
    let seen = cornell_directions(Instrument::CORNELL_BLIND_SPOT_DEG);
    assert_eq!(seen.len(), 1440, "a published file and one more");
    let Some(dir) = testkit::data_dir_or_skip() else {
        return;
    };
    let Ok(bytes) = read(&dir.join("cornell/garnet_red_RGB.astm")) else {
        println!("skipped: no Cornell file");
        return;
    };
    let file = AstmFile::from_bytes(&bytes).unwrap();
    assert_eq!(file.row_count(), 1439, "published rows");
    for row in 0..file.row_count() {
        let a = file.angles(row);
        let close = |b: &&[f64; 4]| (0..4).all(|k| (a[k] - b[k]).abs() < 1.1e-5);
        assert!(
            seen.iter().find(close).is_some(),
            "row {row}: {a:?} is not on the grid"
        );
    }
}

#[expect(
    clippy::disallowed_methods,
    reason = "a test that compares with real data"
)]
fn read(path: &std::path::Path) -> std::io::Result<Vec<u8>> {
    std::fs::read(path)
}
