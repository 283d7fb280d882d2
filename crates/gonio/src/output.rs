//! What leaves the program: results on stdout, everything else on stderr. A closed pipe is no error, and nothing here
//! panics.

use anyhow::Result;
use std::fmt;
use std::io::{self, ErrorKind, Write};

/// A mistake in what was typed, found after the words were parsed: exit code 2.
#[derive(Debug)]
pub(crate) struct Usage(pub(crate) String);

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Usage {}

/// Writes `text` to stdout. A reader that has seen enough (`gonio info FILE | head -1`) is no error.
pub(crate) fn print(text: &str) -> Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(anyhow::anyhow!("standard output: cannot write: {e}"))
        }
        _ => Ok(()),
    }
}

/// Writes one line to stderr; there is nobody to tell if that fails.
pub(crate) fn say(line: impl fmt::Display) {
    let text = line.to_string().replace('\n', " ");
    let _nobody_to_tell = writeln!(io::stderr(), "{text}");
}
