//! Cornell's ASTM E1392-96 text files: a header of `KEY value` lines, then rows of numbers.

use crate::channels::Channels;
use crate::error::{Error, Place, quote};
use crate::file::File;
use crate::format::Format;
use crate::lines::{Line, Lines};
use crate::rows::{Rows, Separator};
use std::io::{self, Write};

/// The angle columns, in the order they must have.
const ANGLES: [&str; 4] = ["theta_i", "phi_i", "theta_s", "phi_s"];

/// An ASTM E1392-96 file: its header, whole, and its rows as they come, in radians.
///
/// Writing a file that was read gives the same numbers to the bit, and the same bytes if all its numbers
/// have the same count of decimals (up to 15 digits), as Cornell's do. RGB is not on BRDF scale:
/// `docs/formats/astm.md`.
#[derive(Clone, Debug, PartialEq)]
pub struct AstmFile {
    columns: Vec<String>,
    channels: Channels,
    rows: Rows,
}

impl AstmFile {
    /// Reads a file.
    ///
    /// # Errors
    /// If the header lacks its `VARS` line, holds bytes that are not text or counts other rows than
    /// there are; if a row has too few or too many columns, a field that is not a finite number, or an
    /// angle beyond any in radians. Columns other than R,G,B, X,Y,Z or `<wavelength>nm` are unsupported.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let mut lines = Lines::new(bytes);
        let header = Header::parse(&mut lines)?;
        let rows = Rows::parse(bytes, lines, &header.columns, Separator::Comma)?;
        if let Some((place, expected)) = header.num_points
            && expected != rows.len() as u64
        {
            let (expected, found) = (rows_text(expected), rows_text(rows.len() as u64));
            return Err(Error::invalid(place, "NUM_POINTS", expected, found));
        }
        Ok(Self {
            columns: header.columns,
            channels: header.channels,
            rows,
        })
    }

    /// A file from header fields, which must not name `NUM_POINTS` or `VARS`, and row-major numbers:
    /// theta_i, phi_i, theta_s, phi_s in radians, then a value per channel.
    ///
    /// ```
    /// # use brdf_formats::{AstmFile, Channels};
    /// let row = vec![0.5, 0.0, 0.25, -1.0, 0.1, 0.2, 0.3];
    /// let file = AstmFile::new(&[("SAMPLE_NAME", "Paper")], Channels::Rgb, row)?;
    /// assert!(file.to_bytes().ends_with(
    ///     b"NUM_POINTS 1\r\nVARS theta_i,phi_i,theta_s,phi_s,R,G,B\r\n\r\n\
    ///       0.500000,0.000000,0.250000,-1.000000,0.100000,0.200000,0.300000\r\n"
    /// ));
    /// # Ok::<(), brdf_formats::Error>(())
    /// ```
    ///
    /// # Errors
    /// If a key or value does not fit on its line, there is no whole row, or [`AstmFile::from_bytes`]
    /// would refuse a number.
    pub fn new(fields: &[(&str, &str)], channels: Channels, rows: Vec<f64>) -> Result<Self, Error> {
        let values = channels.names();
        let channels = Channels::from_names(&values, Place::File)?;
        let columns: Vec<String> = ANGLES.map(String::from).into_iter().chain(values).collect();
        let mut header = String::new();
        for (key, value) in fields {
            check_field(key, value)?;
            header.push_str(&format!("{key} {value}\r\n"));
        }
        let count = rows.len() / columns.len();
        let vars = columns.join(",");
        header.push_str(&format!("NUM_POINTS {count}\r\nVARS {vars}\r\n\r\n"));
        let rows = Rows::new(header.into_bytes(), rows, &columns, Separator::Comma)?;
        Ok(Self {
            columns,
            channels,
            rows,
        })
    }

    /// Everything above the first row, verbatim.
    #[must_use]
    pub fn header(&self) -> &[u8] {
        self.rows.preamble()
    }

    /// The header's lines as `(key, value)`, blank ones left out; bytes that are not UTF-8 are replaced.
    pub fn fields(&self) -> impl Iterator<Item = (String, String)> + '_ {
        let lines = Lines::new(self.header()).filter(|line| !line.is_blank());
        lines.map(|line| {
            let (key, value) = split_key(line.text);
            let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
            (text(key), text(value))
        })
    }

    /// The value of the first header line with this key.
    #[must_use]
    pub fn field(&self, key: &str) -> Option<String> {
        self.fields()
            .find(|(k, _)| k == key)
            .map(|(_, value)| value)
    }

    /// All column names: the four angles, then the values.
    #[must_use]
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The names of the value columns.
    #[must_use]
    pub fn value_columns(&self) -> &[String] {
        &self.columns[ANGLES.len()..]
    }

    /// What the value columns are.
    #[must_use]
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// How many rows there are; at least one.
    #[must_use]
    pub fn row_count(&self) -> usize {
        self.rows.len()
    }

    /// All numbers, row-major, in the file's order.
    #[must_use]
    pub fn rows(&self) -> &[f64] {
        self.rows.values()
    }

    /// theta_i, phi_i, theta_s, phi_s of a row in radians.
    ///
    /// # Panics
    /// If `row` is not below [`AstmFile::row_count`].
    #[must_use]
    pub fn angles(&self, row: usize) -> [f64; 4] {
        self.rows.angles(row)
    }

    /// The values of a row, one a channel.
    ///
    /// # Panics
    /// If `row` is not below [`AstmFile::row_count`].
    #[must_use]
    pub fn values(&self, row: usize) -> &[f64] {
        &self.rows.row(row)[ANGLES.len()..]
    }

    /// The file's bytes.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        self.rows.to_bytes()
    }

    /// Writes the file's bytes.
    ///
    /// # Errors
    /// Whatever the writer returns.
    pub fn write(&self, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
        out.write_all(&self.to_bytes())
    }
}

/// The registry item.
pub(crate) const FORMAT: Format = Format {
    name: "astm",
    title: "Cornell ASTM E1392-96 text",
    magic: "a `VARS` line, or a first line with one of the standard's keys",
    extensions: &["astm"],
    detect,
    read,
    writer: Some(File::write_to),
    docs: "docs/formats/astm.md",
};

/// A `VARS` line, or a first line with a key of the standard.
fn detect(prefix: &[u8], _total_len: u64) -> bool {
    const FIRST: [&[u8]; 5] = [b"LAB_", b"SYSTEM_NAME", b"SAMPLE_", b"MEAS_", b"NUM_POINTS"];
    let mut lines = Lines::new(prefix).filter(|line| !line.is_blank());
    let first = lines.clone().next().map_or(&[][..], |line| line.text);
    FIRST.iter().any(|key| first.starts_with(key))
        || lines.any(|line| split_key(line.text).0 == b"VARS")
}

fn read(bytes: Vec<u8>) -> Result<File, Error> {
    AstmFile::from_bytes(&bytes).map(File::Astm)
}

/// What the header says about the rows.
struct Header {
    columns: Vec<String>,
    channels: Channels,
    num_points: Option<(Place, u64)>,
}

impl Header {
    /// Takes the lines up to and with `VARS`.
    fn parse(lines: &mut Lines<'_>) -> Result<Self, Error> {
        let mut num_points = None;
        for line in lines.by_ref() {
            let place = Place::Line(line.number);
            if let Some(control) = line.control() {
                let found = format!("byte 0x{control:02x}");
                return Err(Error::invalid(place, "header", "text", found));
            }
            match split_key(line.text) {
                (b"NUM_POINTS", _) if num_points.is_some() => {
                    let (want, found) = ("one line of this key", "a second");
                    return Err(Error::invalid(place, "NUM_POINTS", want, found));
                }
                (b"NUM_POINTS", value) => num_points = Some((place, parse_count(value, place)?)),
                (b"VARS", value) => {
                    let (columns, channels) = parse_vars(value, line)?;
                    return Ok(Self {
                        columns,
                        channels,
                        num_points,
                    });
                }
                _ => {}
            }
        }
        let place = Place::Line(lines.number().max(1));
        let expected = "a VARS line that ends the header";
        Err(Error::invalid(
            place,
            "VARS",
            expected,
            "the end of the file",
        ))
    }
}

fn parse_count(value: &[u8], place: Place) -> Result<u64, Error> {
    let text = std::str::from_utf8(value).ok();
    text.and_then(|t| t.parse().ok())
        .ok_or_else(|| Error::invalid(place, "NUM_POINTS", "a row count", quote(value)))
}

fn parse_vars(value: &[u8], line: Line<'_>) -> Result<(Vec<String>, Channels), Error> {
    let place = Place::Line(line.number);
    let Ok(text) = std::str::from_utf8(value) else {
        return Err(Error::invalid(place, "VARS", "column names", quote(value)));
    };
    let columns: Vec<String> = text.split(',').map(|c| c.trim().to_owned()).collect();
    match columns.split_at_checked(ANGLES.len()) {
        Some((angles, values)) if angles == ANGLES => {
            let channels = Channels::from_names(values, place)?;
            Ok((columns, channels))
        }
        _ => {
            let expected = format!("columns that start with {}", ANGLES.join(","));
            Err(Error::unsupported(place, "VARS", expected, quote(value)))
        }
    }
}

fn check_field(key: &str, value: &str) -> Result<(), Error> {
    let control = |text: &str| text.chars().any(char::is_control);
    let key_taken = matches!(key, "" | "NUM_POINTS" | "VARS");
    if key_taken || control(key) || key.contains(char::is_whitespace) {
        let expected = "one word that is not NUM_POINTS or VARS";
        let found = quote(key.as_bytes());
        return Err(Error::invalid(Place::File, "key", expected, found));
    }
    if control(value) {
        let found = quote(value.as_bytes());
        return Err(Error::invalid(Place::File, key, "one line of text", found));
    }
    Ok(())
}

/// Key and value of a header line, without blanks around them.
fn split_key(text: &[u8]) -> (&[u8], &[u8]) {
    let text = text.trim_ascii();
    let end = text.iter().position(u8::is_ascii_whitespace);
    let (key, value) = text.split_at(end.unwrap_or(text.len()));
    (key, value.trim_ascii())
}

fn rows_text(count: u64) -> String {
    format!("{count} row{}", if count == 1 { "" } else { "s" })
}
