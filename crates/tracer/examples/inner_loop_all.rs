//! A program that renders in RGB and in every spectral mode: see `cargo xtask inner-loop`.

#![expect(
    clippy::print_stdout,
    clippy::unwrap_used,
    reason = "an example reports to whoever runs it"
)]

#[path = "inner_loop/scene.rs"]
mod scene;

use brdf::{HERO, ROTATIONS};
use scene::relative_error;
use spectrum::Samples;
use std::sync::Arc;
use tracer::{Fixed, Hero, HeroEmission};

fn fixed<const N: usize>() -> f64 {
    relative_error::<N, N, _>(Fixed, Samples([30.0; N]))
}

fn main() {
    println!("rgb {}", fixed::<3>());
    println!("8 {}", fixed::<8>());
    println!("16 {}", fixed::<16>());
    println!("31 {}", fixed::<31>());
    println!("45 {}", fixed::<45>());
    println!("65 {}", fixed::<65>());
    let weights = Arc::new([[[1.0 / HERO as f32; 3]; HERO]; ROTATIONS]);
    let intensity = HeroEmission::Table(Arc::new([[30.0; HERO]; ROTATIONS]));
    println!(
        "hero {}",
        relative_error::<HERO, 3, _>(Hero::new(weights), intensity)
    );
}
