//! Writing is atomic, reading is bounded, searching says where it looked.

use scene_io::{DataDirs, ErrorKind, load, write};
use std::io;
use std::path::{Path, PathBuf};

fn names(folder: &Path) -> Vec<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn a_failed_write_leaves_the_old_content_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.exr");
    write::bytes(&path, b"old").unwrap();
    let error = write::atomically(&path, |w| {
        w.write_all(b"half of the new")?;
        Err(io::Error::from(io::ErrorKind::StorageFull))
    })
    .unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Write);
    assert!(
        error
            .to_string()
            .ends_with("out.exr: cannot write: no space left on the disk")
    );
    assert_eq!(load::bytes(&path, 100).unwrap(), b"old");
    assert_eq!(names(folder.path()), ["out.exr"]);
}

#[test]
fn a_write_replaces_whole_files_only() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out");
    for content in [&b"a longer first version"[..], b"short"] {
        write::bytes(&path, content).unwrap();
        assert_eq!(load::bytes(&path, 100).unwrap(), content);
    }
    assert_eq!(names(folder.path()), ["out"]);
}

#[test]
fn writes_that_cannot_be_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let into_nothing = folder.path().join("no/such/folder/out.exr");
    let error = write::bytes(&into_nothing, b"x").unwrap_err().to_string();
    assert!(
        error.ends_with("cannot write: no such file or folder"),
        "{error}"
    );
    let error = write::bytes(folder.path(), b"x").unwrap_err().to_string();
    assert!(
        error.ends_with("expected a file name, found a folder"),
        "{error}"
    );
}

#[cfg(unix)]
#[test]
fn a_read_only_folder_is_refused_in_words() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let set = |mode| {
        std::fs::set_permissions(folder.path(), std::fs::Permissions::from_mode(mode)).unwrap();
    };
    set(0o555);
    let written = write::bytes(&folder.path().join("out"), b"x");
    set(0o755);
    match written {
        Ok(()) => println!("skipped: this user may write to read-only folders"),
        Err(e) => assert!(
            e.to_string().ends_with("cannot write: permission denied"),
            "{e}"
        ),
    }
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_devices_stay_devices() {
    use std::os::unix::fs::symlink;
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    write::folder(&at("far")).unwrap();
    write::bytes(&at("far/target"), b"old").unwrap();
    symlink(at("far/target"), at("link")).unwrap();
    symlink(at("far/missing"), at("dangling")).unwrap();
    symlink(folder.path(), at("to-folder")).unwrap();
    write::check(&at("link")).unwrap();
    write::bytes(&at("link"), b"new").unwrap();
    assert!(at("link").is_symlink(), "the link was replaced");
    assert_eq!(load::bytes(&at("far/target"), 9).unwrap(), b"new");
    let cases = [
        (PathBuf::from("/dev/null"), "found a pipe or device"),
        (at("dangling"), "found a link to nothing"),
        (at("to-folder"), "found a folder"),
        (at("far"), "found a folder"),
    ];
    for (path, found) in cases {
        for result in [write::bytes(&path, b"x"), write::check(&path)] {
            let error = result.unwrap_err().to_string();
            assert!(error.ends_with(found), "{error}");
        }
    }
    assert!(!Path::new("/dev/null").is_file(), "/dev/null was replaced");
    assert_eq!(names(&at("far")), ["target"]);
}

#[test]
fn a_check_says_what_a_write_would_and_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("out.exr");
    write::check(&path).unwrap();
    assert!(names(folder.path()).is_empty(), "something was left behind");
    write::bytes(&path, b"old").unwrap();
    write::check(&path).unwrap();
    assert_eq!(load::bytes(&path, 9).unwrap(), b"old");
    let error = write::check(&folder.path().join("no/out.exr")).unwrap_err();
    assert!(
        error
            .to_string()
            .ends_with("cannot write: no such file or folder"),
        "{error}"
    );
}

#[test]
fn only_regular_files_of_bounded_size_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("data");
    write::bytes(&path, &[7; 100]).unwrap();
    assert_eq!(load::bytes(&path, 100).unwrap().len(), 100);
    let error = load::bytes(&path, 99).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::TooLarge);
    assert!(
        error
            .to_string()
            .ends_with("expected at most 99 bytes, found 100 bytes")
    );
    let error = load::bytes(folder.path(), 99).unwrap_err().to_string();
    assert!(
        error.ends_with("expected a file, found a folder"),
        "{error}"
    );
    let error = load::text(&path, 100).map(|_| ());
    assert!(error.is_ok(), "bytes of value 7 are text");
    write::bytes(&path, b"ab\xff").unwrap();
    let error = load::text(&path, 100).unwrap_err().to_string();
    assert!(
        error.ends_with("expected UTF-8 text, found another byte at 2"),
        "{error}"
    );
}

#[cfg(unix)]
#[test]
fn devices_are_not_files() {
    let error = load::bytes(Path::new("/dev/zero"), 99)
        .unwrap_err()
        .to_string();
    assert_eq!(error, "/dev/zero: expected a file, found a pipe or device");
}

#[test]
fn files_are_found_beside_the_scene_then_in_the_data_folders() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for name in ["scenes", "data/merl", "data/cornell"] {
        write::folder(&at(name)).unwrap();
    }
    for name in ["scenes/a", "data/a", "data/merl/b", "data/cornell/c"] {
        write::bytes(&at(name), b"").unwrap();
    }
    let dirs = DataDirs::new([at("data")]);
    let find = |name: &str| dirs.find(Path::new(name), &at("scenes"));
    assert_eq!(find("a").unwrap(), at("scenes/a"));
    assert_eq!(find("b").unwrap(), at("data/merl/b"));
    assert_eq!(find("c").unwrap(), at("data/cornell/c"));
    assert_eq!(find(at("data/a").to_str().unwrap()).unwrap(), at("data/a"));
    let error = find("d").unwrap_err();
    assert_eq!(error.kind(), ErrorKind::NotFound);
    assert_eq!(error.path(), Some(Path::new("d")));
    for folder in ["scenes", "data"] {
        let looked = at(folder).display().to_string();
        assert!(error.to_string().contains(&looked), "{error}");
    }
    let nowhere = DataDirs::default().find(Path::new("d"), &PathBuf::new());
    assert_eq!(
        nowhere.unwrap_err().to_string(),
        "d: no such file; looked in the current folder; name data folders with --data DIR or GONIO_DATA"
    );
}
