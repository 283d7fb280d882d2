//! Which instruction set everything wide runs with.

use pulp::Arch;
use std::sync::OnceLock;

/// The widest instruction set of this machine; none beyond what every machine has where the environment variable
/// `GONIO_NARROW` is set.
///
/// Asked once a process. The variable is there to compare pictures across machines on one of them: no step is fused for
/// any set, so that they are the same but for what a compiler may reorder.
#[must_use]
pub fn arch() -> Arch {
    static ARCH: OnceLock<Arch> = OnceLock::new();
    let narrow = || std::env::var_os("GONIO_NARROW").is_some();
    *ARCH.get_or_init(|| if narrow() { Arch::Scalar } else { Arch::new() })
}

/// Its name: `x86-64-v4`, `x86-64-v3`, `neon`, or `plain` for what every machine of its kind has.
#[must_use]
pub fn instructions() -> &'static str {
    match arch() {
        Arch::Scalar => "plain",
        #[cfg(target_arch = "x86_64")]
        Arch::V3(_) => "x86-64-v3",
        #[cfg(target_arch = "x86_64")]
        Arch::V4(_) => "x86-64-v4",
        #[cfg(target_arch = "aarch64")]
        Arch::Neon(_) => "neon",
        #[cfg_attr(
            target_arch = "aarch64",
            expect(unreachable_patterns, reason = "no other sets there")
        )]
        _ => "wide",
    }
}
