//! Tables of numbers with their sources, written by `codegen/export_cie.py`.

pub(crate) mod cie_1931_2deg;
pub(crate) mod cie_1964_10deg;
pub(crate) mod illuminants;
