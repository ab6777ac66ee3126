//! Files that are whole or not there: written beside, synchronised, renamed.

use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// A file or folder that can't be changed.
#[derive(Debug, Error)]
#[error("cannot {doing} {path}: {why}", path = path.display())]
pub(super) struct FileError {
    doing: &'static str,
    path: PathBuf,
    pub(super) why: io::Error,
}

/// A converter of the system's errors about a path.
pub(super) fn failed(doing: &'static str, path: &Path) -> impl FnOnce(io::Error) -> FileError {
    move |why| FileError {
        doing,
        path: path.to_path_buf(),
        why,
    }
}

/// Writes a file and waits until it is on the disk.
///
/// # Errors
/// The file can't be written.
pub(super) fn write(path: &Path, contents: &[u8]) -> Result<(), FileError> {
    let written = File::create(path).and_then(|mut file| {
        file.write_all(contents)?;
        file.sync_all()
    });
    written.map_err(failed("write", path))
}

/// Replaces a file by these contents; until they are whole, the former ones stay. A link keeps
/// its place: its target is replaced.
///
/// # Errors
/// The file can't be written; it is then as before.
pub(super) fn replace(path: &Path, contents: &[u8]) -> Result<(), FileError> {
    let real = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    let beside = beside(&real);
    let replaced = write(&beside, contents).and_then(|()| {
        if let Ok(former) = fs::metadata(&real) {
            fs::set_permissions(&beside, former.permissions()).map_err(failed("write", &beside))?;
        }
        fs::rename(&beside, &real).map_err(failed("write", &real))
    });
    if replaced.is_err() {
        let _ = fs::remove_file(&beside);
    }
    replaced?;
    sync_folder(real.parent().unwrap_or(Path::new(".")))
}

/// Name of a file while it is written.
fn beside(path: &Path) -> PathBuf {
    let mut name = OsString::from(".");
    name.push(path.file_name().unwrap_or_default());
    name.push(".partial");
    path.with_file_name(name)
}

/// Waits until the names in a folder are on the disk.
///
/// # Errors
/// The system's.
pub(super) fn sync_folder(folder: &Path) -> Result<(), FileError> {
    // Elsewhere folders can't be opened as files.
    if cfg!(unix) {
        let folder = if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            folder
        };
        File::open(folder)
            .and_then(|folder| folder.sync_all())
            .map_err(failed("synchronise", folder))?;
    }
    Ok(())
}

/// Result of a removal or a move; a path that is not there is no error.
///
/// # Errors
/// The system's others.
pub(super) fn unless_missing(result: io::Result<()>) -> io::Result<()> {
    match result {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        result => result,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_cannot_be_replaced_stays_and_nothing_stays_beside_it() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("page.md");
        replace(&path, b"old").unwrap();
        replace(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        // A folder can't be replaced by a file.
        let taken = folder.path().join("taken");
        fs::create_dir(&taken).unwrap();
        let refused = replace(&taken, b"new").unwrap_err().to_string();
        assert!(refused.contains("taken"), "{refused}");
        assert!(taken.is_dir());
        assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
    }

    #[cfg(unix)]
    #[test]
    fn a_link_keeps_its_place() {
        let folder = tempfile::tempdir().unwrap();
        let (page, link) = (folder.path().join("page.md"), folder.path().join("link.md"));
        fs::write(&page, "old").unwrap();
        std::os::unix::fs::symlink("page.md", &link).unwrap();
        replace(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&page).unwrap(), b"new");
    }
}
