//! Running the program in a folder of its own.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// A temporary folder the program runs in, away from the user's data and caches.
pub(crate) struct Bench {
    folder: tempfile::TempDir,
}

/// What a run left on its streams.
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        scene_io::write::bytes(&self.path(name), content.as_ref()).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        scene_io::load::bytes(&self.path(name), 1 << 30).unwrap()
    }

    pub(crate) fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_gonio"));
        command
            .args(line.split_whitespace())
            .current_dir(self.folder.path())
            .env_remove("GONIO_DATA")
            .env("GONIO_CACHE", self.path(".cache"))
            .stdin(Stdio::null());
        command
    }

    /// Runs a command line, split at blanks.
    pub(crate) fn run(&self, line: &str) -> Run {
        let output = self.command(line).output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        Run {
            code: output.status.code().unwrap_or(-1),
            out: text(output.stdout),
            err: text(output.stderr),
        }
    }

    /// Runs a command line that must succeed; its stdout.
    pub(crate) fn text(&self, line: &str) -> String {
        let run = self.run(line);
        assert_eq!(run.code, 0, "gonio {line}: {}", run.err);
        run.out
    }

    /// Runs a command line with `--json`, which must succeed and print one object on one line.
    pub(crate) fn json(&self, line: &str) -> serde_json::Value {
        let out = self.text(&format!("{line} --json"));
        assert_eq!(out.lines().count(), 1, "gonio {line}: {out}");
        let value: serde_json::Value = serde_json::from_str(&out).unwrap();
        assert!(value.is_object(), "gonio {line}: {out}");
        value
    }

    /// Every file below the folder but the cache.
    pub(crate) fn files(&self) -> BTreeSet<PathBuf> {
        fn walk(folder: &Path, found: &mut BTreeSet<PathBuf>) {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() && !path.ends_with(".cache") {
                    walk(&path, found);
                }
                found.insert(path);
            }
        }
        let mut found = BTreeSet::new();
        walk(self.folder.path(), &mut found);
        found.remove(&self.path(".cache"));
        found
    }
}

/// A file of this repository.
pub(crate) fn repository(path: &str) -> String {
    format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"))
}

/// The numbers of a JSON array.
pub(crate) fn numbers(value: &serde_json::Value) -> Vec<f64> {
    let array = value.as_array().unwrap();
    array.iter().map(|v| v.as_f64().unwrap()).collect()
}
