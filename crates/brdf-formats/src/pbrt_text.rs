//! The text form in which pbrt-v2 shipped Cornell's spectral data: comments, wavelengths, rows.

use crate::channels::{Channels, check_wavelengths};
use crate::error::{Error, Place, quote};
use crate::file::File;
use crate::format::Format;
use crate::lines::{Line, Lines};
use crate::number;
use crate::rows::{Rows, Separator};
use std::io::{self, Write};

/// A pbrt-v2 text file: wavelengths, and rows of four angles in radians and f_r in 1/sr.
///
/// Writing a file that was read gives the same numbers to the bit, and the same bytes if all its numbers
/// have the same count of decimals (up to 15 digits).
#[derive(Clone, Debug, PartialEq)]
pub struct PbrtTextFile {
    channels: Channels,
    rows: Rows,
}

impl PbrtTextFile {
    /// Reads a file. One row a line; comments only above the rows.
    ///
    /// # Errors
    /// If the wavelengths are fewer than announced or not ascending, a row has too few or too many
    /// columns, a field is not a finite number, or an angle is beyond any in radians. Comments among the
    /// rows are unsupported.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let mut lines = Lines::new(bytes);
        let wavelengths = parse_wavelengths(&mut lines)?;
        let names = names(&wavelengths);
        let rows = Rows::parse(bytes, lines, &names, Separator::Blank)?;
        let channels = Channels::Wavelengths(wavelengths);
        Ok(Self { channels, rows })
    }

    /// A file from comment lines (written with a leading `# `), wavelengths and row-major numbers:
    /// theta_i, phi_i, theta_o, phi_o in radians, then f_r at each wavelength.
    ///
    /// # Errors
    /// If a comment does not fit on its line, there is no whole row, or [`PbrtTextFile::from_bytes`]
    /// would refuse a number.
    pub fn new(comments: &[&str], wavelengths_nm: Vec<f64>, rows: Vec<f64>) -> Result<Self, Error> {
        check_wavelengths(&wavelengths_nm, Place::File, "wavelengths")?;
        let mut head = String::new();
        for comment in comments {
            if comment.chars().any(char::is_control) {
                let (want, found) = ("one line of text", quote(comment.as_bytes()));
                return Err(Error::invalid(Place::File, "comment", want, found));
            }
            head.push_str(&format!("# {comment}\r\n"));
        }
        let count = wavelengths_nm.len();
        let list: Vec<String> = wavelengths_nm.iter().map(f64::to_string).collect();
        let list = list.join(" ");
        head.push_str(&format!(
            "\r\n# num wls\r\n{count}\r\n\r\n# wls\r\n{list}\r\n\r\n\
             # theta i, phi i, theta s, phi_s, spectral sample values\r\n\r\n"
        ));
        let names = names(&wavelengths_nm);
        let rows = Rows::new(head.into_bytes(), rows, &names, Separator::Blank)?;
        let channels = Channels::Wavelengths(wavelengths_nm);
        Ok(Self { channels, rows })
    }

    /// Everything above the first row, verbatim.
    #[must_use]
    pub fn header(&self) -> &[u8] {
        self.rows.preamble()
    }

    /// The comment lines without their `#` and the blanks around.
    pub fn comments(&self) -> impl Iterator<Item = String> + '_ {
        Lines::new(self.header()).filter_map(|line| {
            let text = line.comment()?;
            Some(String::from_utf8_lossy(text).into_owned())
        })
    }

    /// The wavelengths in nm, strictly ascending.
    #[must_use]
    pub fn wavelengths_nm(&self) -> &[f64] {
        match &self.channels {
            Channels::Wavelengths(nm) => nm,
            Channels::Rgb | Channels::Xyz => &[],
        }
    }

    /// The wavelengths, as channels.
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

    /// theta_i, phi_i, theta_o, phi_o of a row in radians.
    ///
    /// # Panics
    /// If `row` is not below [`PbrtTextFile::row_count`].
    #[must_use]
    pub fn angles(&self, row: usize) -> [f64; 4] {
        self.rows.angles(row)
    }

    /// f_r in 1/sr of a row at each wavelength.
    ///
    /// # Panics
    /// If `row` is not below [`PbrtTextFile::row_count`].
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

/// Names of the angle columns in errors; the file has none.
const ANGLES: [&str; 4] = ["theta_i", "phi_i", "theta_o", "phi_o"];

fn names(wavelengths: &[f64]) -> Vec<String> {
    let values = wavelengths.iter().map(|nm| format!("{nm}nm"));
    ANGLES.map(String::from).into_iter().chain(values).collect()
}

/// The registry item.
pub(crate) const FORMAT: Format = Format {
    name: "pbrt-text",
    title: "pbrt-v2 spectral text",
    magic: "a `# num wls` comment, or a count alone on the first line and numbers below",
    extensions: &["brdf"],
    detect,
    read,
    writer: Some(File::write_to),
    docs: "docs/formats/pbrt-text.md",
};

/// A wavelength count alone on the first line, and the usual comment above
/// it or numbers below it.
fn detect(prefix: &[u8], _total_len: u64) -> bool {
    let (comments, data): (Vec<_>, Vec<_>) = Lines::new(prefix)
        .filter(|line| !line.is_blank())
        .take(DETECT_LINES)
        .partition(|line| line.comment().is_some());
    let announces = |text: &[u8]| text.to_ascii_lowercase().starts_with(b"num wls");
    if comments.iter().filter_map(Line::comment).any(announces) {
        return true;
    }
    let [count, wavelengths, ..] = &data[..] else {
        return false;
    };
    let is_number = |word: &[u8]| number::parse(word).is_some();
    parse_count(count.text.trim_ascii()).is_some()
        && wavelengths.words().next().is_some_and(is_number)
}

/// Lines that detection looks at.
const DETECT_LINES: usize = 64;

fn read(bytes: Vec<u8>) -> Result<File, Error> {
    PbrtTextFile::from_bytes(&bytes).map(File::PbrtText)
}

fn parse_count(word: &[u8]) -> Option<usize> {
    let count = std::str::from_utf8(word).ok()?.parse().ok()?;
    (count > 0).then_some(count)
}

/// Takes the lines up to the last wavelength.
fn parse_wavelengths(lines: &mut Lines<'_>) -> Result<Vec<f64>, Error> {
    const COUNT: &str = "wavelength count";
    let mut count = None;
    let mut nm = Vec::new();
    for line in lines.by_ref() {
        let place = Place::Line(line.number);
        if let Some(control) = line.control() {
            let found = format!("byte 0x{control:02x}");
            return Err(Error::invalid(place, "header", "text", found));
        }
        if line.comment().is_some() || line.is_blank() {
            continue;
        }
        let Some(count) = count else {
            let word = line.text.trim_ascii();
            let expected = "a positive count alone on its line";
            let bad = || Error::invalid(place, COUNT, expected, quote(word));
            count = Some(parse_count(word).ok_or_else(bad)?);
            continue;
        };
        take_wavelengths(line, count, &mut nm)?;
        if nm.len() == count {
            check_wavelengths(&nm, place, "wavelengths")?;
            return Ok(nm);
        }
    }
    let place = Place::Line(lines.number().max(1));
    let (field, expected) = match count {
        Some(count) => ("wavelengths", format!("{count} numbers")),
        None => (COUNT, "a positive count".into()),
    };
    Err(Error::invalid(
        place,
        field,
        expected,
        "the end of the file",
    ))
}

/// Adds the wavelengths of a line, which must not be more than `count` in all.
fn take_wavelengths(line: Line<'_>, count: usize, nm: &mut Vec<f64>) -> Result<(), Error> {
    let (place, field) = (Place::Line(line.number), "wavelengths");
    for word in line.words() {
        let number = number::parse(word);
        let bad = || Error::invalid(place, field, "a wavelength in nm", quote(word));
        nm.push(number.ok_or_else(bad)?.value);
    }
    if nm.len() > count {
        let expected = format!("{count} numbers, the last ending its line");
        let found = format!("{} up to here", nm.len());
        return Err(Error::invalid(place, field, expected, found));
    }
    Ok(())
}
