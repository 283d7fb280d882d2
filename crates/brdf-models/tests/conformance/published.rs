//! Published parameters of measured materials: Bagher's and Loew's, 100 MERL materials each.

use brdf::{Brdf, direction};
use brdf_models::{MODELS, ModelInfo, ParsedModel, build_model};
use std::collections::HashMap;

/// Rows of a table by the name of the material, columns by their heading.
type Table = Vec<(String, HashMap<String, f64>)>;

fn table(name: &str) -> Option<Table> {
    let bytes = testkit::read_data(&format!("fits/{name}.csv"))?;
    let text = String::from_utf8(bytes).expect("a text");
    let mut lines = text.lines();
    let head: Vec<_> = lines.next()?.split(',').collect();
    let row = |line: &str| {
        let cells: Vec<_> = line.split(',').collect();
        let numbers = head.iter().zip(&cells[..]);
        let numbers = numbers.filter_map(|(h, c)| Some(((*h).to_owned(), c.parse().ok()?)));
        (cells[0].to_owned(), numbers.collect())
    };
    Some(lines.map(row).collect())
}

fn info(name: &str) -> &'static ModelInfo {
    MODELS.iter().find(|m| m.name == name).expect("listed")
}

fn rgb(row: &HashMap<String, f64>, name: &str) -> [f64; 3] {
    ["r", "g", "b"].map(|c| row[&format!("{name}_{c}")])
}

fn sgd(row: &HashMap<String, f64>) -> ParsedModel<3> {
    let same = [
        "alpha", "p", "f0", "f1", "kap", "lambda", "c", "k", "theta0",
    ];
    let mut values: Vec<_> = same.iter().map(|n| (*n, rgb(row, n))).collect();
    values.extend([("kd", rgb(row, "rhoD")), ("ks", rgb(row, "rhoS"))]);
    let values: Vec<_> = values.iter().map(|(n, v)| (*n, &v[..])).collect();
    build_model(info("sgd"), &values).expect("published parameters are in range")
}

fn abc(row: &HashMap<String, f64>) -> ParsedModel<3> {
    let values = [("a", rgb(row, "A")), ("kd", rgb(row, "kD"))];
    let mut values: Vec<_> = values.iter().map(|(n, v)| (*n, &v[..])).collect();
    let [b, c, n] = ["B", "C", "ior"].map(|k| [row[k]]);
    values.extend([("b", &b[..]), ("c", &c[..]), ("n", &n[..])]);
    build_model(info("abc"), &values).expect("published parameters are in range")
}

/// RMS of ln(1 + f cos) over the plane of incidence away from the horizon, the sum of the channels.
fn distance(a: &dyn Brdf<3>, b: &dyn Brdf<3>) -> f64 {
    let (mut sum, mut n) = (0.0, 0);
    for ti in [10.0_f64, 30.0, 50.0] {
        for to in (-70..=70).step_by(4) {
            let wi = direction(ti.to_radians(), 0.0);
            let wo = direction(f64::from(to).to_radians(), std::f64::consts::PI);
            let ln = |m: &dyn Brdf<3>| (m.eval(wi, wo).iter().sum::<f64>() * wi.z).ln_1p();
            sum += (ln(a) - ln(b)).powi(2);
            n += 1;
        }
    }
    (sum / f64::from(n)).sqrt()
}

#[test]
fn two_fits_to_the_same_materials_agree() {
    let (Some(bagher), Some(loew)) = (table("sgd_bagher2012"), table("abc_low2012")) else {
        return;
    };
    assert_eq!((bagher.len(), loew.len()), (100, 100));
    let loew: HashMap<_, _> = loew.iter().map(|(name, row)| (name, abc(row))).collect();
    let (mut own, mut other) = (Vec::new(), Vec::new());
    for (k, (name, row)) in bagher.iter().enumerate() {
        let sgd = sgd(row);
        let Some(same) = loew.get(name) else {
            continue;
        };
        own.push(distance(&*sgd.built.brdf, &*same.built.brdf));
        // a material far from it in the alphabet, for scale
        let stranger = &bagher[(k + 50) % 100].0;
        if let Some(stranger) = loew.get(stranger) {
            other.push(distance(&*sgd.built.brdf, &*stranger.built.brdf));
        }
    }
    own.sort_by(f64::total_cmp);
    other.sort_by(f64::total_cmp);
    let (own, other) = (own[own.len() / 2], other[other.len() / 2]);
    println!(
        "median distance of ln(1 + f cos): {own:.4} to the same material, {other:.4} to another"
    );
    // two forms fitted to the same data, with metrics of their own: closer by far than two materials
    assert!(own < 0.25 * other, "{own} {other}");
}
