//! Measurements that are read differently: `Recoloured` answers as what is below it, times its factors.

use brdf::{Measured, direction};
use scene_io::DataDirs;
use scene_io::material::{MaterialOptions, load_measured};
use scene_io::scene::ColourChoice;
use std::path::Path;

#[test]
fn recoloured_answers_are_those_of_the_file_times_the_factors() {
    let Some(folder) = testkit::data_dir_or_skip() else {
        return;
    };
    let data = DataDirs::new([folder]);
    let path = data.find(Path::new("paper_white_rgb.bsdf"), Path::new(""));
    let path = path.unwrap();
    let factors = [2.0, 3.0, 4.0];
    let colour = ColourChoice {
        scale: Some("2,3,4".parse().unwrap()),
        ..ColourChoice::default()
    };
    let said = MaterialOptions {
        colour,
        ..MaterialOptions::default()
    };
    let [plain, said] =
        [MaterialOptions::default(), said].map(|o| load_measured(&path, &o).unwrap());
    let (a, b) = (plain.measured.symmetry(), said.measured.symmetry());
    assert_eq!((a.reciprocal, a.isotropic), (b.reciprocal, b.isotropic));
    for k in 0..100 {
        let u = |s: f64| (0.5 + s * f64::from(k)).fract();
        let wi = direction(1.6 * u(0.819), 0.0);
        let wo = direction(1.6 * u(0.671), 6.0 * u(0.55));
        let (mut a, mut b) = ([0.0; 3], [0.0; 3]);
        let below = plain.measured.eval_native(wi, wo, &mut a);
        assert_eq!(below, said.measured.eval_native(wi, wo, &mut b));
        for c in 0..3 {
            let expected = factors[c] * a[c];
            let error = (b[c] - expected).abs();
            assert!(error <= 1e-12 * expected.abs(), "{b:?} and {a:?}");
        }
    }
}
