//! Where measured files for tests lie, if anywhere.

use std::path::PathBuf;

/// The folder named by the environment variable `GONIO_DATA`; `None` if it is unset or empty.
#[must_use]
pub fn data_dir() -> Option<PathBuf> {
    std::env::var_os("GONIO_DATA")
        .filter(|v| !v.is_empty())
        .map(PathBuf::from)
}

/// [`data_dir`], printing `skipped: GONIO_DATA is not set` if there is none.
#[must_use]
#[expect(clippy::print_stderr, reason = "a skipped test must say so")]
pub fn data_dir_or_skip() -> Option<PathBuf> {
    let dir = data_dir();
    if dir.is_none() {
        eprintln!("skipped: GONIO_DATA is not set");
    }
    dir
}

/// The bytes of a file below [`data_dir`]; `None`, after printing one `skipped:` line, if the variable or the
/// file is missing.
#[must_use]
#[expect(clippy::print_stderr, reason = "a skipped test must say so")]
#[expect(
    clippy::disallowed_methods,
    reason = "tests read measured files directly"
)]
pub fn read_data(path: &str) -> Option<Vec<u8>> {
    let bytes = std::fs::read(data_dir_or_skip()?.join(path)).ok();
    if bytes.is_none() {
        eprintln!("skipped: {path} is not in GONIO_DATA");
    }
    bytes
}
