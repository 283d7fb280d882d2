//! `gonio samplers`: keys, verdicts, refusals, figures known on paper.

use crate::program::Bench;
use serde_json::Value;

fn method<'a>(value: &'a Value, name: &str) -> &'a Value {
    let methods = value["methods"].as_array().unwrap();
    methods.iter().find(|m| m["name"] == name).unwrap()
}

#[test]
fn cosine_and_uniform_on_lambert_are_as_theory_says() {
    let value =
        Bench::new().json("samplers lambert:kd=0.5 --methods cosine,uniform,native --seconds 0.5");
    let number = |name: &str, key: &str| method(&value, name)[key].as_f64().unwrap();
    // w = 2 cos with cos uniform: 4/3 - 1
    let z =
        (number("uniform", "rel_var_mean") - 1.0 / 3.0) / number("uniform", "rel_var_mean_error");
    assert!(z.abs() < 4.0, "{z}");
    for name in ["cosine", "native"] {
        assert!(number(name, "rel_var_worst") < 1e-20, "{name}");
    }
    assert!(
        value["colour_floor"].as_f64().unwrap() < 1e-9,
        "one shape for all channels: {value}"
    );
    for m in value["methods"].as_array().unwrap() {
        assert_eq!(m["chi_square_ok"], true, "{m}");
        assert_eq!(m["rel_var"].as_object().unwrap().len(), 7, "{m}");
        assert!(
            (m["tries_per_sample"].as_f64().unwrap() - 1.0).abs() < 1e-12,
            "{m}"
        );
        for key in [
            "bytes",
            "build_ms",
            "sample_ns",
            "pdf_ns",
            "max_weight_ratio",
            "wasted",
        ] {
            assert!(m[key].is_number(), "{key}: {m}");
        }
    }
}

#[test]
fn tables_beat_the_cosine_on_gloss_and_colour_has_a_floor() {
    let value = Bench::new()
        .json("samplers cook-torrance:m=0.2,ks=0.5,kd=0.1/0.2/0.4 --methods hvt-tiny,cosine,rejection --seconds 0.3");
    let number = |name: &str, key: &str| method(&value, name)[key].as_f64().unwrap();
    assert!(
        number("hvt-tiny", "rel_var_mean") < 0.1 * number("cosine", "rel_var_mean"),
        "{value}"
    );
    assert!(number("rejection", "tries_per_sample") > 1.5, "{value}");
    assert_eq!(
        method(&value, "rejection")["keeps_stratification"],
        false,
        "{value}"
    );
    let floor = value["colour_floor"].as_f64().unwrap();
    assert!(
        floor > 1e-3 && floor < 1.0,
        "three mixtures of one lobe and a cosine: {floor}"
    );
}

#[test]
fn what_does_not_go_together_is_refused() {
    let bench = Bench::new();
    bench.write("m.binary", crate::fixtures::merl([6, 6, 12], |_| 1.0));
    for (line, code, said) in [
        ("samplers", 2, "FILE|MODEL"),
        ("samplers none.binary", 1, "none.binary"),
        ("samplers m.binary --methods native", 1, "\"native\""),
        ("samplers m.binary --methods hvd", 2, "\"hvd\""),
        ("samplers m.binary --seconds -3", 2, "--seconds"),
        ("samplers ggx:alpha=many", 1, "alpha"),
    ] {
        let run = bench.run(line);
        assert_eq!(run.code, code, "gonio {line}: {}", run.err);
        assert!(run.err.contains(said), "gonio {line}: {}", run.err);
        assert_eq!(run.err.lines().count(), 1, "gonio {line}: {}", run.err);
    }
}
