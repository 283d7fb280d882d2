//! The stress table has no red row.

use stress::{Effort, Row, cases, run};

fn red(rows: &[Row]) -> Vec<String> {
    let lines = rows.iter().filter(|r| !r.ok()).map(|r| {
        let t = &r.tally;
        format!(
            "{}: {:.2e} > {:.0e} ({} nan, {} inf, {} negative) {} {}",
            r.case, t.worst, r.bound, t.nan, t.inf, t.negative, t.place, t.broken
        )
    });
    lines.collect()
}

#[test]
fn no_red_row() {
    let red = red(&run(&cases(), "", Effort::Quick));
    assert!(red.is_empty(), "{}", red.join("\n"));
}

#[test]
fn slow_no_red_row() {
    let red = red(&run(&cases(), "", Effort::Full));
    assert!(red.is_empty(), "{}", red.join("\n"));
}
