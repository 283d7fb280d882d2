//! Broken input of every kind: one line that says which file, where, what was expected and what was found; exit code 1
//! (2 for bad usage); nothing left behind.

#![expect(clippy::too_many_lines, reason = "tables of broken input")]

mod merl;
mod pictures;
mod scenes;
mod tensor;
mod text;
mod usage;

use crate::program::Bench;

/// A command line, its exit code and what its one line of error must say.
type Case = (&'static str, i32, &'static [&'static str]);

const SPHERE: &str = r#"(form: Sphere(center: (0, 1, 0), radius: 1), material: "m")"#;

/// Writes `content` with `from` replaced by `to`, which must occur.
fn swapped(bench: &Bench, name: &str, content: &str, from: &str, to: &str) {
    assert!(content.contains(from), "{name}: {from}");
    bench.write(name, content.replacen(from, to, 1));
}

fn check(bench: &Bench, cases: &[Case]) {
    let before = bench.files();
    let mut wrong = Vec::new();
    for (line, code, fragments) in cases {
        let run = bench.run(line);
        let mut problems = Vec::new();
        if run.code != *code {
            problems.push(format!("exit code {} instead of {code}", run.code));
        }
        if run.err.lines().count() != 1 || !run.err.starts_with("gonio: ") {
            problems.push("expected one line from gonio".into());
        }
        problems.extend(
            (fragments.iter())
                .filter(|f| !run.err.contains(**f))
                .map(|f| format!("does not say {f:?}")),
        );
        if !run.out.is_empty() {
            problems.push(format!("stdout: {}", run.out));
        }
        if bench.files() != before {
            problems.push(format!("left behind: {:?}", bench.files()));
        }
        if !problems.is_empty() {
            wrong.push(format!(
                "gonio {line}\n    {}\n    {}",
                run.err.trim(),
                problems.join("\n    ")
            ));
        }
    }
    assert!(
        wrong.is_empty(),
        "{} of {}:\n{}",
        wrong.len(),
        cases.len(),
        wrong.join("\n")
    );
}
