//! Tables written by `cargo xtask codegen`.

#[rustfmt::skip]
#[expect(clippy::approx_constant, reason = "3.14 is a measured index")]
pub(crate) mod substances;
