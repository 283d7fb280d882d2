//! Lossless readers and writers of measured-reflectance files: bytes in, plain structs out.
//!
//! * [`detect`] tells the format from the content, never from a file name; [`FORMATS`] lists them all.
//! * [`read`] gives a [`File`]; each format also has its own reader, for instance
//!   [`MerlFile::from_bytes`], and [`MerlReader`] decodes large MERL files piece by piece, on any number of threads.
//! * Files that can be written come back bit for bit: the writers neither round nor reorder.
//!
//! The structs mirror the file. Nothing here interpolates, converts colour, clamps, rescales or fills;
//! negatives, NaN and "not measured" marks are handed on as they stand. Text formats, where NaN has no
//! place, refuse it. Every allocation is bounded by the size of the input, and no input panics.
//!
//! This crate takes bytes and [`std::io::Read`]; it never opens a path.

mod angles;
mod astm;
mod channels;
mod error;
mod file;
mod format;
mod kaist;
mod lines;
mod merl;
mod merl_reader;
mod number;
mod pbrt_text;
mod rgl;
mod rows;
mod tensor;
mod tensor_write;

pub use astm::AstmFile;
pub use channels::Channels;
pub use error::{Error, ErrorKind, Place};
pub use file::{File, read};
pub use format::{FORMATS, Format, PREFIX, Writer, detect, detect_prefix};
pub use merl::{MERL_SCALE, MerlFile};
pub use merl_reader::{MerlReader, ReadAt};
pub use pbrt_text::PbrtTextFile;
pub use rgl::{RglArray, RglFile, RglView};
pub use tensor::{Dtype, Tensor, TensorFile};
pub use tensor_write::{TensorField, write_tensor};
