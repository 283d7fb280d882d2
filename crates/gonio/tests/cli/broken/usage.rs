//! Bad usage, and outputs that cannot be written.

use super::{Case, check};
use crate::fixtures::merl;
use crate::program::Bench;

#[test]
fn stress() {
    let bench = Bench::new();
    let run = bench.run("stress --quick --only angles/half");
    assert!(
        run.code == 0 && run.out.contains("1 rows, 0 red"),
        "{}{}",
        run.out,
        run.err
    );
    check(
        &bench,
        &[
            ("stress --only nonsense", 1, &["--only nonsense: no row"]),
            ("stress --timing --quick", 2, &["--timing", "--quick"]),
            ("stress --markdown --json", 2, &["--markdown", "--json"]),
        ],
    );
}

#[test]
fn usage_and_outputs() {
    let bench = Bench::new();
    bench.write("m.binary", merl([6, 6, 12], |k| 1.0 + k as f64));
    bench.write(
        "d.csv",
        "theta_i,phi_i,theta_o,phi_o\n10,0,20,180\n10,0,95,180\n",
    );
    bench.write("text.csv", "ten,zero,twenty,zero\n");
    std::fs::create_dir(bench.path("folder.exr")).unwrap();
    std::fs::create_dir(bench.path("folder.svg")).unwrap();
    let mut cases: Vec<Case> = vec![
        ("frobnicate", 2, &["frobnicate"]),
        ("eval m.binary --theta-i 10", 2, &["--theta-o"]),
        (
            "eval m.binary --theta-i 91 --theta-o 0",
            2,
            &["'91'", "--theta-i", "expected degrees from the normal"],
        ),
        (
            "eval m.binary --theta-i nan --theta-o 0",
            2,
            &["'nan'", "expected degrees"],
        ),
        (
            "eval m.binary --theta-i 1 --theta-o 1 --interpolation cubic",
            2,
            &[
                "--interpolation",
                "expected an interpolation",
                "found \"cubic\"",
            ],
        ),
        (
            "eval m.binary --batch d.csv",
            1,
            &[
                "d.csv:3: expected theta from 0 to 90",
                "found \"10,0,95,180\"",
            ],
        ),
        (
            "eval m.binary --batch text.csv",
            1,
            &[
                "text.csv:1: expected theta_i,phi_i,theta_o,phi_o",
                "found \"ten",
            ],
        ),
        (
            "eval m.binary --batch gone.csv",
            1,
            &["gone.csv: cannot read: no such file"],
        ),
        (
            "plot m.binary -o a.gif",
            2,
            &[
                "a.gif",
                "expected an output ending in .svg or .png",
                "found",
            ],
        ),
        (
            "plot m.binary -o a",
            2,
            &["expected an output ending in .svg or .png"],
        ),
        ("plot m.binary", 2, &["--output"]),
        (
            "plot m.binary m.binary --kind slice -o a.svg",
            2,
            &["expected one file for a slice", "found 2"],
        ),
        (
            "plot m.binary -o gone/a.svg",
            1,
            &["gone/a.svg: cannot write: no such file or folder"],
        ),
        (
            "plot m.binary -o folder.svg",
            1,
            &["folder.svg: cannot write: expected a file name, found a folder"],
        ),
        (
            "convert m.binary a.bsdf",
            2,
            &[
                "a.bsdf: expected an output ending in .binary",
                "found \"bsdf\"",
            ],
        ),
        (
            "convert m.binary gone/a.astm",
            1,
            &["gone/a.astm: cannot write"],
        ),
        (
            "convert m.binary a.brdf",
            1,
            &["m.binary: expected rows of spectra", "found"],
        ),
        (
            "mix m.binary:1 m.binary:1 -o a.astm",
            1,
            &["a.astm: expected an output ending in .binary"],
        ),
        (
            "mix m.binary:1 m.binary -o a.binary",
            2,
            &["m.binary: expected FILE:WEIGHT", "found no colon"],
        ),
        (
            "mix m.binary:1 m.binary:many -o a.binary",
            2,
            &["expected FILE:WEIGHT", "found \"many\""],
        ),
        (
            "mix m.binary:1 m.binary:inf -o a.binary",
            2,
            &["expected FILE:WEIGHT", "found \"inf\""],
        ),
        ("mix m.binary:1 -o a.binary", 2, &["2 values required"]),
        ("measure ggx", 2, &["expected an output"]),
        (
            "measure ggx -o a.txt",
            2,
            &["a.txt: expected an output ending in .binary"],
        ),
        (
            "measure glass -o a.binary",
            1,
            &["`glass`", "known are lambert"],
        ),
        (
            "measure ggx:alpha=9 -o a.binary",
            1,
            &["`ggx`", "`alpha`", "9 is outside"],
        ),
        (
            "measure ggx:alpha=x -o a.binary",
            1,
            &["`ggx`", "`alpha`", "`x`"],
        ),
        (
            "measure ggx:roughness=1 -o a.binary",
            1,
            &["`ggx`", "`roughness`"],
        ),
        (
            "measure ggx --noise -1 -o a.binary",
            2,
            &["--noise", "expected a number, 0 or more"],
        ),
        ("measure ggx --blind-spot 900 -o a.astm", 1, &["blind"]),
        (
            "measure ggx -o gone/a.astm",
            1,
            &["gone/a.astm: cannot write"],
        ),
        (
            "render -o a.png",
            2,
            &["a.png", "expected an output ending in .exr"],
        ),
        (
            "render -o gone/a.exr",
            1,
            &["gone/a.exr: cannot write: no such file or folder"],
        ),
        (
            "render -o folder.exr",
            1,
            &["folder.exr: cannot write: expected a file name, found a folder"],
        ),
        (
            "render --sampler best",
            2,
            &["--sampler", "expected a sampler", "found \"best\""],
        ),
        ("render --size 0x9", 2, &["--size", "expected WIDTHxHEIGHT"]),
        ("render --spp 0", 2, &["--spp", "0"]),
        ("render --threads 0", 2, &["--threads", "0"]),
        (
            "render --material gone.binary",
            1,
            &["gone.binary: ", "no such file"],
        ),
        (
            "render --interpolation squared-lambda --material m.binary",
            1,
            &[
                "m.binary",
                "expected an interpolation",
                "found \"squared-lambda\"",
            ],
        ),
    ];
    if cfg!(target_os = "linux") {
        cases.push(("render -o /proc/a.exr", 1, &["/proc/a.exr: cannot write"]));
        cases.push((
            "measure ggx -o /dev/full",
            2,
            &["/dev/full: expected an output ending in"],
        ));
        cases.push((
            "info /dev/zero",
            1,
            &["/dev/zero: expected a file, found a pipe or device"],
        ));
    }
    check(&bench, &cases);
}
