//! Cornell and pbrt text.

use super::{check, swapped};
use crate::fixtures::{astm_rgb, pbrt_text};
use crate::program::Bench;

#[test]
fn text_files() {
    let bench = Bench::new();
    let astm = String::from_utf8(astm_rgb()).unwrap();
    bench.write("sound.astm", &astm);
    let first = astm.lines().position(|l| l.is_empty()).unwrap() + 2;
    let row = astm.lines().nth(first - 1).unwrap().to_owned();
    let at = |line: &str| swapped(&bench, "x", &astm, &row, line);
    at(&row);
    let with_row = |name: &str, new: &str| swapped(&bench, name, &astm, &row, new);
    bench.write("truncated.astm", &astm[..astm.len() - 30]);
    with_row("nan.astm", &row.replacen("0.", "nan", 1));
    with_row("words.astm", "one,two,three,four,5,6,7");
    with_row("narrow.astm", "0.174533,0.000000,0.1,0.0,0.1,0.1");
    with_row("wide.astm", &format!("{row},1"));
    with_row("degrees.astm", "10,0,45,0,0.1,0.1,0.1");
    with_row("binary.astm", "\u{0}\u{1}\u{2}");
    let vars = "VARS theta_i,phi_i,theta_s,phi_s,R,G,B";
    swapped(&bench, "no-vars.astm", &astm, vars, "REMARK none");
    swapped(
        &bench,
        "other-vars.astm",
        &astm,
        vars,
        "VARS phi_i,theta_i,theta_s,phi_s,R,G,B",
    );
    swapped(
        &bench,
        "odd-columns.astm",
        &astm,
        vars,
        "VARS theta_i,phi_i,theta_s,phi_s,R,G,Q",
    );
    swapped(&bench, "count.astm", &astm, "NUM_POINTS ", "NUM_POINTS 1");
    bench.write("no-rows.astm", format!("{vars}\n"));
    let text = pbrt_text();
    bench.write("sound.brdf", &text);
    bench.write("truncated.brdf", &text[..text.len() - 12]);
    swapped(
        &bench,
        "descending.brdf",
        &text,
        "400 550 700",
        "400 700 550",
    );
    swapped(&bench, "count.brdf", &text, "\n3\n", "\n4\n");
    swapped(&bench, "nan.brdf", &text, "0.02 0.05", "0.02 nan");
    swapped(&bench, "missing.brdf", &text, "0.02 0.05", "0.05");
    swapped(&bench, "degrees.brdf", &text, "0.174533", "10.0");
    bench.write("head.brdf", "# a comment\n\n3\n\n400 550 700\n\n");
    for sound in ["sound.astm", "sound.brdf"] {
        assert_eq!(bench.run(&format!("info {sound}")).code, 0, "{sound}");
    }
    check(
        &bench,
        &[
            (
                "info truncated.astm",
                1,
                &["truncated.astm: line ", "expected", "found"],
            ),
            (
                "info nan.astm",
                1,
                &["nan.astm: line ", "expected a finite number", "found `nan"],
            ),
            (
                "info words.astm",
                1,
                &[
                    "words.astm: line ",
                    "theta_i: expected a finite number",
                    "found `one`",
                ],
            ),
            (
                "info narrow.astm",
                1,
                &[
                    "narrow.astm: line ",
                    "expected 7 comma-separated numbers",
                    "found 6",
                ],
            ),
            (
                "info wide.astm",
                1,
                &[
                    "wide.astm: line ",
                    "expected 7 comma-separated numbers",
                    "found 8",
                ],
            ),
            (
                "info degrees.astm",
                1,
                &[
                    "degrees.astm: line ",
                    "theta_i: expected",
                    "radians",
                    "found",
                ],
            ),
            (
                "info binary.astm",
                1,
                &["binary.astm: line ", "expected", "found"],
            ),
            (
                "info no-vars.astm",
                1,
                &[
                    "no-vars.astm: line ",
                    "expected a VARS line",
                    "found the end of the file",
                ],
            ),
            (
                "info other-vars.astm",
                1,
                &[
                    "other-vars.astm: line ",
                    "VARS: expected columns that start with theta_i",
                    "found",
                ],
            ),
            (
                "info odd-columns.astm",
                1,
                &["odd-columns.astm: line ", "expected", "found"],
            ),
            (
                "info count.astm",
                1,
                &["count.astm: line ", "NUM_POINTS: expected", "rows, found"],
            ),
            (
                "info no-rows.astm",
                1,
                &["no-rows.astm: ", "expected", "found"],
            ),
            (
                "info truncated.brdf",
                1,
                &["truncated.brdf: line ", "expected", "found"],
            ),
            (
                "info descending.brdf",
                1,
                &["descending.brdf: line ", "expected", "found"],
            ),
            (
                "info count.brdf",
                1,
                &["count.brdf: line ", "expected", "found"],
            ),
            (
                "info nan.brdf",
                1,
                &["nan.brdf: line ", "expected a finite number", "found `nan`"],
            ),
            (
                "info missing.brdf",
                1,
                &["missing.brdf: line ", "expected", "found"],
            ),
            (
                "info degrees.brdf",
                1,
                &["degrees.brdf: line ", "radians", "found"],
            ),
            ("info head.brdf", 1, &["head.brdf: ", "expected", "found"]),
            (
                "convert nan.astm a.brdf",
                1,
                &["nan.astm: line ", "expected a finite number"],
            ),
            (
                "convert sound.astm a.brdf",
                1,
                &["sound.astm: ", "expected rows of spectra", "found"],
            ),
            (
                "render --material words.astm -o a.exr",
                1,
                &["words.astm: ", "line ", "expected a finite number"],
            ),
        ],
    );
}
