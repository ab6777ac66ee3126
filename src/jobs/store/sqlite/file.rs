//! Database file: where it is, whose it is, and whether it is still the one that was opened.

use crate::jobs::store::StoreError;
use std::fs::{self, Metadata, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use thiserror::Error;

/// Reason why a path can't be used as a database, or no longer.
#[derive(Debug, Error)]
pub(super) enum FileFault {
    #[error("it is a link to a file that does not exist: remove the link, or restore its target")]
    DanglingLink,
    #[error("its directory does not exist: create it, or name another one")]
    NoDirectory,
    #[error("it is not a regular file: name a file")]
    NotAFile,
    #[cfg(unix)]
    #[error(
        "the file has {0} names (hard links), so that two services could use it at once: remove \
         the other names, or use a copy of it (scree backup)"
    )]
    HardLinks(u64),
    #[error(
        "the file was removed or moved while the service uses it: nothing is accepted until it is \
         back; what was written since is lost once the service stops without it"
    )]
    Removed,
    #[error(
        "the file was replaced by another one while the service uses it: nothing is accepted until \
         the former file is back or the service is started again"
    )]
    Replaced,
    #[error(
        "its write-ahead log (-wal) was removed or replaced while the service uses it: nothing is \
         accepted until the log is back, or the service has been stopped in order and started again"
    )]
    LogRemoved,
    #[error(transparent)]
    System(#[from] io::Error),
}

/// Error of a database file.
#[derive(Debug, Error)]
#[error("{}: {fault}", path.display())]
struct FileError {
    path: PathBuf,
    fault: FileFault,
}

/// A path that can be a database, by its canonical name: links to a file are that file.
#[derive(Debug)]
pub(super) struct Location {
    pub(super) path: PathBuf,
    /// The file's metadata, if it exists.
    pub(super) found: Option<Metadata>,
}

/// The file of an open database.
#[derive(Debug)]
pub(super) struct DatabaseFile {
    path: PathBuf,
    identity: Identity,
    /// Identity of the write-ahead log, from the first write on: connections that stay open keep
    /// SQLite from making another one.
    log: OnceLock<Identity>,
}

/// Identity of a file under whatever name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Identity {
    #[cfg(unix)]
    device_and_inode: (u64, u64),
}

impl Location {
    /// Location of a database.
    ///
    /// # Errors
    /// The path can't be one of a database.
    pub(super) fn of(path: &Path) -> Result<Self, StoreError> {
        Self::resolve(path).map_err(|fault| error(path, fault))
    }

    fn resolve(path: &Path) -> Result<Self, FileFault> {
        let missing = |error: &io::Error| error.kind() == io::ErrorKind::NotFound;
        match path.canonicalize() {
            Ok(path) => {
                let metadata = fs::metadata(&path)?;
                check_kind(&metadata)?;
                Ok(Self {
                    path,
                    found: Some(metadata),
                })
            }
            Err(error) if missing(&error) && path.symlink_metadata().is_ok() => {
                Err(FileFault::DanglingLink)
            }
            Err(error) if missing(&error) => Ok(Self {
                path: new_path(path)?,
                found: None,
            }),
            Err(error) => Err(error.into()),
        }
    }

    /// The file, created if it does not exist, readable by its owner alone.
    ///
    /// # Errors
    /// The file can't be created.
    pub(super) fn create_if_missing(self) -> Result<DatabaseFile, StoreError> {
        let failed = |error: io::Error| self::error(&self.path, error.into());
        let metadata = match &self.found {
            Some(metadata) => metadata.clone(),
            None => private(OpenOptions::new().write(true).create_new(true))
                .open(&self.path)
                .and_then(|file| file.metadata())
                .map_err(failed)?,
        };
        Ok(DatabaseFile {
            identity: Identity::of(&metadata),
            path: self.path,
            log: OnceLock::new(),
        })
    }

    /// Warns if others than the file's owner can read it.
    pub(super) fn warn_of_readers(&self) {
        #[cfg(unix)]
        if let Some(metadata) = &self.found {
            use std::os::unix::fs::MetadataExt;
            let mode = metadata.mode() & 0o777;
            if mode & 0o077 != 0 {
                let database = self.path.display();
                tracing::warn!(
                    %database,
                    mode = format!("{mode:o}"),
                    "other users can access the database; chmod 600 keeps them out"
                );
            }
        }
    }
}

impl DatabaseFile {
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Checks that the path still leads to the file that was opened.
    ///
    /// # Errors
    /// It leads to none, or to another one.
    pub(super) fn check(&self) -> Result<(), StoreError> {
        let fault = match fs::metadata(&self.path) {
            Ok(metadata) if Identity::of(&metadata) == self.identity => return Ok(()),
            Ok(_) => FileFault::Replaced,
            Err(error) if error.kind() == io::ErrorKind::NotFound => FileFault::Removed,
            Err(error) => error.into(),
        };
        Err(error(&self.path, fault))
    }

    /// The same, and that the write-ahead log, which is there while a connection has a transaction
    /// open, is the one of the first write: what is written to another one is lost.
    ///
    /// # Errors
    /// One of the files is no longer there, or another one.
    pub(super) fn check_with_log(&self) -> Result<(), StoreError> {
        self.check()?;
        let fault = match fs::metadata(beside(&self.path, "-wal")) {
            Ok(metadata) => {
                let identity = Identity::of(&metadata);
                if *self.log.get_or_init(|| identity) == identity {
                    return Ok(());
                }
                FileFault::LogRemoved
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => FileFault::LogRemoved,
            Err(error) => error.into(),
        };
        Err(error(&self.path, fault))
    }
}

impl Identity {
    #[cfg(unix)]
    pub(super) fn of(metadata: &Metadata) -> Self {
        use std::os::unix::fs::MetadataExt;
        Self {
            device_and_inode: (metadata.dev(), metadata.ino()),
        }
    }

    #[cfg(not(unix))]
    pub(super) fn of(_: &Metadata) -> Self {
        Self {}
    }
}

fn check_kind(metadata: &Metadata) -> Result<(), FileFault> {
    if !metadata.is_file() {
        return Err(FileFault::NotAFile);
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::MetadataExt;
        if metadata.nlink() > 1 {
            return Err(FileFault::HardLinks(metadata.nlink()));
        }
    }
    Ok(())
}

/// Canonical path of a file that does not exist.
fn new_path(path: &Path) -> Result<PathBuf, FileFault> {
    let name = path.file_name().ok_or(FileFault::NotAFile)?;
    match directory_of(path).canonicalize() {
        Ok(directory) => Ok(directory.join(name)),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Err(FileFault::NoDirectory),
        Err(error) => Err(error.into()),
    }
}

/// Directory of a file.
pub(super) fn directory_of(path: &Path) -> &Path {
    match path.parent() {
        Some(directory) if directory != Path::new("") => directory,
        _ => Path::new("."),
    }
}

/// A file that is created is readable by its owner alone. SQLite gives its log the same mode.
pub(super) fn private(options: &mut OpenOptions) -> &mut OpenOptions {
    #[cfg(unix)]
    {
        use std::os::unix::fs::OpenOptionsExt;
        options.mode(0o600);
    }
    options
}

/// Path of a file that belongs to the database, by the end of its name.
pub(super) fn beside(database: &Path, end: &str) -> PathBuf {
    let mut path = database.as_os_str().to_owned();
    path.push(end);
    PathBuf::from(path)
}

fn error(path: &Path, fault: FileFault) -> StoreError {
    let path = path.to_owned();
    StoreError::Unavailable(FileError { path, fault }.into())
}
