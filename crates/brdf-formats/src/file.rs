//! A file of any known format.

use crate::error::{Error, Place, quote};
use crate::format::{FORMATS, Format, detect};
use crate::{AstmFile, MerlFile, PbrtTextFile, RglFile, astm, merl, pbrt_text, rgl};
use std::io::{self, Write};

/// A file of any of the formats with a reader.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub enum File {
    /// MERL isotropic binary.
    Merl(MerlFile),
    /// Cornell ASTM E1392-96 text.
    Astm(AstmFile),
    /// pbrt-v2 spectral text.
    PbrtText(PbrtTextFile),
    /// RGL tensor file.
    Rgl(RglFile),
}

/// Reads a file of whatever format its content shows it to be.
///
/// # Errors
/// If the content is of no known format, or the format's reader refuses it.
pub fn read(bytes: Vec<u8>) -> Result<File, Error> {
    if let Some(format) = detect(&bytes) {
        return (format.read)(bytes);
    }
    let names: Vec<&str> = FORMATS.iter().map(|f| f.name).collect();
    let expected = format!("one of {}", names.join(", "));
    let place = Place::File;
    Err(match bytes.as_slice() {
        [] => Error::invalid(place, "format", expected, "an empty file"),
        _ => Error::unsupported(place, "format", expected, quote(&bytes)),
    })
}

impl File {
    /// The format of the file.
    #[must_use]
    pub fn format(&self) -> &'static Format {
        match self {
            Self::Merl(_) => &merl::FORMAT,
            Self::Astm(_) => &astm::FORMAT,
            Self::PbrtText(_) => &pbrt_text::FORMAT,
            Self::Rgl(_) => &rgl::FORMAT,
        }
    }

    /// Writes the file in its own format; what was read comes back as each format promises.
    ///
    /// # Errors
    /// [`io::ErrorKind::Unsupported`] if the format has no writer, or whatever `out` returns.
    pub fn write(&self, out: &mut (impl Write + ?Sized)) -> io::Result<()> {
        match self {
            Self::Merl(file) => file.write(out),
            Self::Astm(file) => file.write(out),
            Self::PbrtText(file) => file.write(out),
            Self::Rgl(_) => Err(io::Error::new(
                io::ErrorKind::Unsupported,
                "RGL files are read, not written",
            )),
        }
    }

    /// [`File::write`] as the registry's [`crate::Format::writer`].
    pub(crate) fn write_to(&self, out: &mut dyn Write) -> io::Result<()> {
        self.write(out)
    }
}
