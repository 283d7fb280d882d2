//! Model texts: what they give, what they refuse and how they say it.

use crate::cases::all;
use brdf_models::{parse_model, parse_model_n};
use glam::DVec3;

#[test]
fn the_echo_gives_the_same_model() {
    for model in all() {
        let again = parse_model(&model.to_string()).unwrap();
        assert_eq!(again.values, model.values, "{model}");
        let (wi, wo) = (DVec3::new(0.6, 0.0, 0.8), DVec3::new(-0.48, 0.36, 0.8));
        assert_eq!(
            again.built.brdf.eval(wi, wo).map(f64::to_bits),
            model.built.brdf.eval(wi, wo).map(f64::to_bits),
            "{model}"
        );
    }
}

#[test]
fn defaults_are_filled_in() {
    let echo = |text| parse_model(text).unwrap().to_string();
    assert_eq!(echo("lambert"), "lambert:kd=0.5");
    assert_eq!(
        echo(" ggx: alpha = 0.2 "),
        "ggx:alpha=0.2,alpha_x=0.2,alpha_y=0.2,f0=1,ks=1,kd=0"
    );
    assert_eq!(
        echo("ggx:k=2,alpha_y=0.5"),
        "ggx:alpha=0.1,alpha_x=0.1,alpha_y=0.5,k=2,ks=1,kd=0"
    );
    assert_eq!(
        echo("ggx:index=CU"),
        "ggx:alpha=0.1,alpha_x=0.1,alpha_y=0.1,index=cu,ks=1,kd=0"
    );
    assert_eq!(
        echo("ward-gmd:kd=0.1/0.2/0.3"),
        "ward-gmd:alpha=0.15,alpha_x=0.15,alpha_y=0.15,ks=0.5,kd=0.1/0.2/0.3"
    );
}

#[test]
fn lobes_are_numbered() {
    let echo = |text| parse_model(text).unwrap().to_string();
    assert_eq!(
        echo("lafortune:n2=8,kd=0.1,cx2=0.5"),
        "lafortune:ks=0.5,n=50,cx=-1,cy=-1,cz=1,ks2=0.5,n2=8,cx2=0.5,cy2=0.5,cz2=1,kd=0.1"
    );
    assert_eq!(
        parse_model("lafortune:ks64=0")
            .unwrap()
            .values
            .iter()
            .count(),
        64 * 5 + 1
    );
    for text in [
        "lafortune:n1=3",
        "lafortune:n02=3",
        "lafortune:kd2=0.1",
        "lafortune:n65=1",
        "ggx:alpha2=0.1",
    ] {
        let error = parse_model(text).unwrap_err().to_string();
        assert!(error.contains("has no parameter"), "`{text}`: {error}");
    }
}

#[test]
fn errors_say_place_expected_and_found() {
    let cases = [
        (
            "lambrt",
            "unknown model `lambrt`; known are lambert, phong, lewis,",
        ),
        ("", "unknown model ``"),
        (
            "lambert:ks=1",
            "model `lambert` has no parameter `ks`; it takes kd",
        ),
        (
            "lambert:kd",
            "model `lambert`: expected `parameter=value`, found `kd`",
        ),
        (
            "lambert:kd=red",
            "model `lambert`, parameter `kd`: expected a number, found `red`",
        ),
        ("lambert:kd=nan", "expected a number, found `nan`"),
        ("lambert:kd=", "expected a number, found ``"),
        (
            "lambert:kd=1.5",
            "model `lambert`, parameter `kd`: 1.5 is outside 0 ... 1",
        ),
        ("lambert:kd=-0.1", "-0.1 is outside 0 ... 1"),
        (
            "lambert:kd=0.1/0.2",
            "expected one value or 3, found 2 values",
        ),
        ("lambert:kd=0.1,kd=0.2", "parameter `kd` is given twice"),
        ("ggx:alpha=0", "0 is outside 0.0001 ... 1"),
        (
            "ggx:alpha=0.1/0.2/0.3",
            "expected one value, found 3 values",
        ),
        (
            "ggx:f0=0.04,n=1.5",
            "model `ggx`: give either `f0` or `n`, not both",
        ),
        (
            "ggx:k=1,f0=0.04",
            "model `ggx`: give either `k` or `f0`, not both",
        ),
        ("ggx:n=xx", "expected a number, found `xx`"),
        ("he:lambda=xx", "expected a number or rgb, found `xx`"),
        (
            "ggx:index=xx",
            "model `ggx`, parameter `index`: expected one of ag, al, au, cr, cu, fe, ni, ti, bk7",
        ),
        ("ggx:index=cu/au", "found `cu/au`"),
        (
            "ggx:index=cu,k=1",
            "model `ggx`: give either `index` or `k`, not both",
        ),
    ];
    for (text, expected) in cases {
        let error = parse_model(text).unwrap_err().to_string();
        assert!(error.contains(expected), "`{text}`: {error}");
        assert!(
            !error.contains('\n'),
            "`{text}`: {error:?} is more than one line"
        );
    }
}

#[test]
fn any_number_of_channels() {
    let eight = parse_model_n::<8>("lambert:kd=0/0.1/0.2/0.3/0.4/0.5/0.6/0.7").unwrap();
    let f = eight.built.brdf.eval(DVec3::Z, DVec3::Z);
    assert!((f[7] * std::f64::consts::PI - 0.7).abs() < 1e-15, "{f:?}");
    let error = parse_model_n::<8>("ggx:index=cu").unwrap_err().to_string();
    assert!(error.contains("known in RGB alone"), "{error}");
    assert!(
        parse_model_n::<8>("lambert:kd=0.1/0.2/0.3").is_err(),
        "three values for eight channels"
    );
}
