//! No row of the stress table is red, and docs/numerics.md shows the rows there are.

use std::collections::BTreeSet;
use stress::{Effort, Row, cases, run};

/// What is wrong with the rows that are red.
fn red(rows: &[Row]) -> Vec<String> {
    let red = rows.iter().filter(|r| !r.ok());
    let lines = red.map(|r| {
        let t = &r.tally;
        format!(
            "{}: {:.2e} > {:.0e} ({} nan, {} inf, {} negative) {} {}",
            r.case, t.worst, r.bound, t.nan, t.inf, t.negative, t.place, t.broken
        )
    });
    lines.collect()
}

#[test]
fn no_row_is_red() {
    let red = red(&run(&cases(), "", Effort::Quick));
    assert!(red.is_empty(), "{}", red.join("\n"));
}

/// A finer part of every grid; `gonio stress` runs all of it.
#[test]
fn slow_no_row_is_red_on_a_finer_grid() {
    let red = red(&run(&cases(), "", Effort::Finer));
    assert!(red.is_empty(), "{}", red.join("\n"));
}

#[test]
fn names_are_unique() {
    let all = cases();
    let names: BTreeSet<_> = all.iter().map(|c| &c.name).collect();
    assert_eq!(names.len(), all.len(), "a name twice");
}

/// The page is written by hand but for its table, which `gonio stress --markdown` prints.
#[test]
fn the_page_shows_every_row_with_its_bound() {
    let page = include_str!("../../../../docs/numerics.md");
    let shown: BTreeSet<(&str, &str)> = page
        .lines()
        .filter(|line| line.starts_with("| ") && line.matches('|').count() == 6)
        .map(|line| line.split('|').map(str::trim).collect::<Vec<_>>())
        .filter(|cells| cells[1].contains('/'))
        .map(|cells| (cells[1], cells[3]))
        .collect();
    let all = cases();
    let bounds: Vec<String> = all.iter().map(|c| format!("{:.0e}", c.bound)).collect();
    let wanted: BTreeSet<(&str, &str)> = all
        .iter()
        .zip(&bounds)
        .map(|(c, bound)| (&*c.name, &**bound))
        .collect();
    let missing: Vec<_> = wanted.symmetric_difference(&shown).collect();
    assert!(
        missing.is_empty(),
        "docs/numerics.md and the list of cases differ: {missing:?}; `gonio stress --markdown` prints the table"
    );
    assert!(!page.contains("**red**"), "the page shows a red row");
}
