//! A program that renders in RGB and knows nothing else: see `cargo xtask inner-loop`.

#![expect(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "an example reports to whoever runs it"
)]

#[path = "inner_loop/scene.rs"]
mod scene;

use spectrum::Samples;
use tracer::Fixed;

fn main() {
    println!(
        "rgb {}",
        scene::relative_error::<3, 3, _>(Fixed, Samples([30.0; 3]))
    );
}
