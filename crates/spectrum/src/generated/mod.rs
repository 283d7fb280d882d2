//! Tables of numbers with their sources, written by `cargo xtask codegen`.

#[rustfmt::skip]
pub(crate) mod cie_1931_2deg;
#[rustfmt::skip]
pub(crate) mod cie_1964_10deg;
#[rustfmt::skip]
#[expect(clippy::approx_constant, reason = "0.318 is a measured power")]
pub(crate) mod illuminants;
#[rustfmt::skip]
pub(crate) mod linear_uplift;
