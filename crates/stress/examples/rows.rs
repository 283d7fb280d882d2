//! scratch
use stress::*;
fn main() {
    let pat = std::env::args().nth(1).unwrap_or_default();
    let e = if std::env::args().nth(2).is_some() {
        Effort::Quick
    } else {
        Effort::Full
    };
    let t = std::time::Instant::now();
    for r in run(&cases(), &pat, e) {
        let t = &r.tally;
        println!(
            "{} {:40} {:9.2e} / {:6.0e} n {} nan {} inf {} neg {} den {}",
            if r.ok() { "  " } else { "**" },
            r.case,
            t.worst,
            r.bound,
            t.count,
            t.nan,
            t.inf,
            t.negative,
            t.denormal
        );
        if !r.ok() || std::env::args().nth(3).is_some() {
            println!("        worst {}", t.place);
            if !t.broken.is_empty() {
                println!("        broken {}", t.broken);
            }
        }
    }
    println!("{:?}", t.elapsed());
}
