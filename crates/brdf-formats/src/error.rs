//! What went wrong in a file: where, in which field, what was expected and what was found.

use std::fmt::{self, Display};
use std::io;

/// A file that can't be read (or values that no file of the format can hold), as one clear line.
///
/// ```
/// let error = brdf_formats::read(b"VARS theta_i,phi_i,theta_s,phi_s,R,G,B\n0,0,zero,0,1,1,1\n".to_vec())
///     .unwrap_err();
/// assert_eq!(error.to_string(), "line 2: theta_s: expected a finite number, found `zero`");
/// assert_eq!(error.kind(), brdf_formats::ErrorKind::Invalid);
/// ```
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub struct Error(Box<Report>);

#[derive(Debug, thiserror::Error)]
#[error("{place}: {field}: expected {expected}, found {found}{}", kind.remark())]
struct Report {
    kind: ErrorKind,
    place: Place,
    field: String,
    expected: String,
    found: String,
    source: Option<io::Error>,
}

/// What an [`Error`] says about the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The file is broken.
    Invalid,
    /// The file may well be sound, but no reader here takes it.
    Unsupported,
    /// The bytes could not be read; [`std::error::Error::source`] says why.
    Io,
}

impl ErrorKind {
    fn remark(self) -> &'static str {
        match self {
            Self::Unsupported => " (not supported)",
            Self::Invalid | Self::Io => "",
        }
    }
}

/// Where in a file, or in the values handed to a constructor, an [`Error`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Place {
    /// The file as a whole.
    File,
    /// An offset in bytes from the start of a binary file.
    Byte(u64),
    /// A line of a text file, from 1.
    Line(u64),
    /// A row of the values handed to a constructor, from 0.
    Row(u64),
}

impl Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File => write!(f, "file"),
            Self::Byte(n) => write!(f, "byte {n}"),
            Self::Line(n) => write!(f, "line {n}"),
            Self::Row(n) => write!(f, "row {n}"),
        }
    }
}

impl Error {
    /// Whether the file is broken, or only foreign.
    #[must_use]
    pub fn kind(&self) -> ErrorKind {
        self.0.kind
    }

    /// Where the problem is.
    #[must_use]
    pub fn place(&self) -> Place {
        self.0.place
    }

    /// The field the problem is in, by the file's own name for it.
    #[must_use]
    pub fn field(&self) -> &str {
        &self.0.field
    }

    /// What the reader expected there.
    #[must_use]
    pub fn expected(&self) -> &str {
        &self.0.expected
    }

    /// What it found instead; text of the file is quoted, escaped and cut short.
    #[must_use]
    pub fn found(&self) -> &str {
        &self.0.found
    }

    pub(crate) fn invalid(
        place: Place,
        field: impl Display,
        expected: impl Display,
        found: impl Display,
    ) -> Self {
        Self::new(ErrorKind::Invalid, place, (field, expected, found), None)
    }

    pub(crate) fn unsupported(
        place: Place,
        field: impl Display,
        expected: impl Display,
        found: impl Display,
    ) -> Self {
        let what = (field, expected, found);
        Self::new(ErrorKind::Unsupported, place, what, None)
    }

    pub(crate) fn io(place: Place, field: impl Display, source: io::Error) -> Self {
        let what = (field, "readable bytes", source.to_string());
        Self::new(ErrorKind::Io, place, what, Some(source))
    }

    fn new(
        kind: ErrorKind,
        place: Place,
        (field, expected, found): (impl Display, impl Display, impl Display),
        source: Option<io::Error>,
    ) -> Self {
        Self(Box::new(Report {
            kind,
            place,
            field: field.to_string(),
            expected: expected.to_string(),
            found: found.to_string(),
            source,
        }))
    }
}

/// Bytes of a file quoted into an error: printable, on one line, at most [`QUOTE`] characters.
pub(crate) fn quote(bytes: &[u8]) -> String {
    let head = &bytes[..bytes.len().min(QUOTE * 4)];
    let text = String::from_utf8_lossy(head);
    let mut quoted = String::from("`");
    for (i, c) in text.chars().enumerate() {
        if i == QUOTE {
            quoted.push('…');
            break;
        }
        match c {
            '`' => quoted.push('\''),
            c if c.is_control() => quoted.extend(c.escape_default()),
            c => quoted.push(c),
        }
    }
    quoted.push('`');
    quoted
}

const QUOTE: usize = 40;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quotes_are_one_short_printable_line() {
        assert_eq!(quote(b"a\nb`\0"), "`a\\nb'\\u{0}`");
        assert_eq!(quote(&[0xff; 3]), "`\u{fffd}\u{fffd}\u{fffd}`");
        assert_eq!(quote(&[b'x'; 99]).chars().count(), QUOTE + 3);
    }

    #[test]
    fn an_unsupported_file_is_said_to_be_so() {
        let e = Error::unsupported(Place::Byte(7), "dtype", "f32", "f16");
        assert_eq!(
            e.to_string(),
            "byte 7: dtype: expected f32, found f16 (not supported)"
        );
    }
}
