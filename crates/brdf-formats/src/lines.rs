//! Lines of a text file with their numbers and places.

/// A line without its end, which may be LF or CR LF.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line<'a> {
    /// From 1.
    pub(crate) number: u64,
    /// Offset of the first byte.
    pub(crate) start: usize,
    pub(crate) text: &'a [u8],
    /// True if the line ends in CR LF.
    pub(crate) crlf: bool,
}

impl Line<'_> {
    pub(crate) fn is_blank(&self) -> bool {
        self.text.trim_ascii().is_empty()
    }

    /// The text after a leading `#`, without blanks around it.
    pub(crate) fn comment(&self) -> Option<&[u8]> {
        let text = self.text.trim_ascii().strip_prefix(b"#")?;
        Some(text.trim_ascii())
    }

    /// The words between blanks.
    pub(crate) fn words(&self) -> impl Iterator<Item = &[u8]> {
        let words = self.text.split(u8::is_ascii_whitespace);
        words.filter(|word| !word.is_empty())
    }

    /// The first byte that no text line holds: a control character other than tab.
    pub(crate) fn control(&self) -> Option<u8> {
        let mut bytes = self.text.iter().copied();
        bytes.find(|&b| b.is_ascii_control() && b != b'\t')
    }
}

/// The lines of `bytes`; a last line without an end counts, an empty rest does not.
#[derive(Clone, Debug)]
pub(crate) struct Lines<'a> {
    bytes: &'a [u8],
    offset: usize,
    number: u64,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            offset: 0,
            number: 0,
        }
    }

    /// The number of the line last handed out, 0 before the first.
    pub(crate) fn number(&self) -> u64 {
        self.number
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = Line<'a>;

    fn next(&mut self) -> Option<Line<'a>> {
        let rest = self.bytes.get(self.offset..).filter(|r| !r.is_empty())?;
        let (line, length) = match rest.iter().position(|&b| b == b'\n') {
            Some(at) => (&rest[..at], at + 1),
            None => (rest, rest.len()),
        };
        let start = self.offset;
        self.offset += length;
        self.number += 1;
        let stripped = line.strip_suffix(b"\r");
        Some(Line {
            number: self.number,
            start,
            text: stripped.unwrap_or(line),
            crlf: stripped.is_some(),
        })
    }
}
