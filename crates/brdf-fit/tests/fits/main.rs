//! Fits and their exports.

#[cfg(test)]
mod common;
#[cfg(test)]
mod conformance;
#[cfg(test)]
mod coverage;
#[cfg(test)]
mod exports;
#[cfg(test)]
mod known;
