//! Where files named by a scene or on the command line are looked for.

use crate::error::{Error, ErrorKind};
use std::path::{Path, PathBuf};

/// Folders of measured data, searched after the scene's own.
#[derive(Clone, Debug, Default)]
pub struct DataDirs {
    folders: Vec<PathBuf>,
}

/// Sub-folders searched in each data folder, in this order.
const SUBFOLDERS: [&str; 5] = ["", "merl", "cornell", "cornell-spectral", "rgl"];

impl DataDirs {
    /// Searches `folders` in their order.
    pub fn new(folders: impl IntoIterator<Item = PathBuf>) -> Self {
        Self {
            folders: folders.into_iter().collect(),
        }
    }

    /// The file `name` stands for: absolute paths as they are; others relative to `home` (the folder of
    /// whatever names it), then in every data folder and its sub-folders `merl`, `cornell`,
    /// `cornell-spectral` and `rgl`.
    ///
    /// # Errors
    /// [`ErrorKind::NotFound`] saying where it looked.
    pub fn find(&self, name: &Path, home: &Path) -> Result<PathBuf, Error> {
        let direct = home.join(name); // an absolute name replaces home
        if direct.exists() {
            return Ok(direct);
        }
        let mut looked = vec![display_folder(&direct)];
        if name.is_relative() {
            for folder in &self.folders {
                for sub in SUBFOLDERS {
                    let candidate = folder.join(sub).join(name);
                    if candidate.exists() {
                        return Ok(candidate);
                    }
                }
                looked.push(format!(
                    "{} (and its merl, cornell, cornell-spectral, rgl)",
                    folder.display()
                ));
            }
        }
        let mut message = format!("no such file; looked in {}", looked.join(", "));
        if self.folders.is_empty() {
            message.push_str("; name data folders with --data DIR or GONIO_DATA");
        }
        Err(Error::new(ErrorKind::NotFound, message).in_file(name))
    }
}

fn display_folder(path: &Path) -> String {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.display().to_string(),
        _ => "the current folder".into(),
    }
}
