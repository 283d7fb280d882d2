//! Rows of numbers in a text file, and the layout that lets them be written back byte for byte.

use crate::angles;
use crate::error::{Error, Place, quote};
use crate::lines::{Line, Lines};
use crate::number;

/// What stands between two numbers of a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Separator {
    Comma,
    Blank,
}

/// A text file's numbers, row-major: four angles in radians, then the values; all finite.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Rows {
    width: usize,
    values: Vec<f64>,
    /// What the file has above the first row, verbatim.
    preamble: Vec<u8>,
    layout: Layout,
}

/// How the rows were printed, as far as it is uniform.
#[derive(Clone, Debug, PartialEq)]
struct Layout {
    separator: Separator,
    crlf: bool,
    /// Decimals of every number, if they all have the same.
    decimals: Option<u8>,
    /// Line ends and blanks after the last number.
    tail: Vec<u8>,
}

impl Rows {
    /// Reads the rows of `bytes` that follow the lines already taken; one column a name.
    pub(crate) fn parse(
        bytes: &[u8],
        lines: Lines<'_>,
        names: &[String],
        separator: Separator,
    ) -> Result<Self, Error> {
        let mut body = Body::new(names, separator);
        for line in lines {
            body.take(line)?;
        }
        let Some(ends) = body.ends else {
            let place = Place::Line(Lines::new(bytes).last().map_or(1, |l| l.number));
            let (want, found) = ("at least one row", "the end of the file");
            return Err(Error::invalid(place, "rows", want, found));
        };
        Ok(Self {
            width: names.len(),
            values: body.values,
            preamble: bytes[..ends.first].to_vec(),
            layout: Layout {
                separator,
                crlf: ends.crlf,
                decimals: body.decimals,
                tail: bytes[ends.last..].to_vec(),
            },
        })
    }

    /// Rows made in memory, to be written below `preamble` with CR LF and, where exact, 6 decimals.
    pub(crate) fn new(
        preamble: Vec<u8>,
        values: Vec<f64>,
        names: &[String],
        separator: Separator,
    ) -> Result<Self, Error> {
        let width = names.len();
        if values.is_empty() || !values.len().is_multiple_of(width) {
            let expected = format!("at least one row of {width} numbers");
            let found = format!("{} numbers", values.len());
            return Err(Error::invalid(Place::File, "rows", expected, found));
        }
        for (i, row) in values.chunks_exact(width).enumerate() {
            let place = Place::Row(i as u64);
            if let Some(bad) = row.iter().position(|v| !v.is_finite()) {
                return Err(Error::invalid(place, &names[bad], FINITE, row[bad]));
            }
            angles::check(row, names, place)?;
        }
        Ok(Self {
            width,
            values,
            preamble,
            layout: Layout {
                separator,
                crlf: true,
                decimals: Some(6),
                tail: b"\r\n".to_vec(),
            },
        })
    }

    pub(crate) fn preamble(&self) -> &[u8] {
        &self.preamble
    }

    pub(crate) fn len(&self) -> usize {
        self.values.len() / self.width
    }

    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    pub(crate) fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.width..][..self.width]
    }

    pub(crate) fn angles(&self, row: usize) -> [f64; 4] {
        let row = self.row(row);
        [row[0], row[1], row[2], row[3]]
    }

    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let mut out = self.preamble.clone();
        let (line_end, separator) = (
            if self.layout.crlf { "\r\n" } else { "\n" },
            match self.layout.separator {
                Separator::Comma => b',',
                Separator::Blank => b' ',
            },
        );
        for (i, row) in self.values.chunks_exact(self.width).enumerate() {
            if i > 0 {
                out.extend(line_end.as_bytes());
            }
            for (j, &value) in row.iter().enumerate() {
                if j > 0 {
                    out.push(separator);
                }
                number::write(&mut out, value, self.layout.decimals);
            }
        }
        out.extend(&self.layout.tail);
        out
    }
}

const FINITE: &str = "a finite number";

/// The rows while they are being read.
struct Body<'a> {
    names: &'a [String],
    separator: Separator,
    values: Vec<f64>,
    decimals: Option<u8>,
    ends: Option<Ends>,
}

/// Where the rows lie in the file.
struct Ends {
    /// Start of the first row.
    first: usize,
    /// End of the last row, before its line end.
    last: usize,
    /// Whether the first row ends in CR LF.
    crlf: bool,
}

impl<'a> Body<'a> {
    fn new(names: &'a [String], separator: Separator) -> Self {
        Self {
            names,
            separator,
            values: Vec::new(),
            decimals: None,
            ends: None,
        }
    }

    fn take(&mut self, line: Line<'_>) -> Result<(), Error> {
        if line.is_blank() || self.is_comment(line)? {
            return Ok(());
        }
        let last = line.start + line.text.len();
        match &mut self.ends {
            Some(ends) => ends.last = last,
            None => {
                self.ends = Some(Ends {
                    first: line.start,
                    last,
                    crlf: line.crlf,
                });
            }
        }
        self.take_row(line)
    }

    /// Comments belong above the rows, where they are kept.
    fn is_comment(&self, line: Line<'_>) -> Result<bool, Error> {
        if self.separator == Separator::Comma || line.comment().is_none() {
            return Ok(false);
        }
        if self.ends.is_none() {
            return Ok(true);
        }
        let place = Place::Line(line.number);
        let (want, found) = ("comments above the rows only", quote(line.text));
        Err(Error::unsupported(place, "comment", want, found))
    }

    fn take_row(&mut self, line: Line<'_>) -> Result<(), Error> {
        let place = Place::Line(line.number);
        let start = self.values.len();
        for (i, field) in self.fields(line.text).enumerate() {
            let Some(name) = self.names.get(i) else {
                return Err(self.wrong_count(line));
            };
            let Some(number) = number::parse(field) else {
                return Err(Error::invalid(place, name, FINITE, quote(field)));
            };
            if self.values.is_empty() {
                self.decimals = number.decimals;
            } else if self.decimals != number.decimals {
                self.decimals = None;
            }
            self.values.push(number.value);
        }
        let row = &self.values[start..];
        if row.len() != self.names.len() {
            return Err(self.wrong_count(line));
        }
        angles::check(row, self.names, place)
    }

    fn fields<'t>(&self, text: &'t [u8]) -> Fields<'t> {
        Fields {
            rest: Some(text),
            separator: self.separator,
        }
    }

    fn wrong_count(&self, line: Line<'_>) -> Error {
        let kind = match self.separator {
            Separator::Comma => "comma-separated",
            Separator::Blank => "blank-separated",
        };
        let expected = format!("{} {kind} numbers", self.names.len());
        let found = self.fields(line.text).count();
        Error::invalid(Place::Line(line.number), "row", expected, found)
    }
}

/// The fields of a row, without blanks around them.
struct Fields<'a> {
    rest: Option<&'a [u8]>,
    separator: Separator,
}

impl<'a> Iterator for Fields<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let (rest, end) = match self.separator {
            Separator::Comma => {
                let rest = self.rest?;
                (rest, rest.iter().position(|&b| b == b','))
            }
            Separator::Blank => {
                let rest = self.rest?.trim_ascii_start();
                (rest, rest.iter().position(u8::is_ascii_whitespace))
            }
        };
        let field = &rest[..end.unwrap_or(rest.len())];
        self.rest = end.map(|at| &rest[at + 1..]);
        let done = self.separator == Separator::Blank && field.is_empty();
        (!done).then(|| field.trim_ascii())
    }
}
