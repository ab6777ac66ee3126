//! Consistent copy of a database that a service may be using.

use super::error::SqliteError;
use super::file::{Location, beside, directory_of};
use super::inspection::{connect_to_read, immutable, inspect};
use super::lock::Lock;
use crate::jobs::store::StoreError;
use crate::results::chunk::Block;
use futures_util::TryStreamExt;
use sqlx::sqlite::SqliteConnection;
use sqlx::{ConnectOptions, Connection};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use tempfile::TempPath;
use thiserror::Error;

/// A backup that was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Backup {
    /// Its length [bytes].
    pub bytes: u64,
    /// Number of jobs in it.
    pub jobs: u64,
}

/// Reason why there is no backup. Whatever it is, the destination is as it was.
#[derive(Debug, Error)]
pub enum BackupError {
    /// The database is on a server.
    #[error("the database is on a PostgreSQL server: pg_dump copies it")]
    OnServer,
    /// The database does not exist.
    #[error("database {0} not found")]
    Missing(PathBuf),
    /// The destination exists, and must not be replaced.
    #[error("{0} exists: name another file, or pass --replace to replace it")]
    Exists(PathBuf),
    /// The destination is the database, or one of the files beside it.
    #[error("{0} belongs to the database itself: name another file")]
    Itself(PathBuf),
    /// The copy can't be written.
    #[error("{path}: {source}")]
    Destination {
        /// The destination.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// A service uses the database, whose write-ahead log is gone.
    #[error(
        "a service uses {}, and its write-ahead log (-wal) is gone: stop the service in order, \
         which writes it into the file, and try again", .0.display()
    )]
    LogMissing(PathBuf),
    /// The copy is not sound, which the database itself may not be.
    #[error("the copy is not sound, and was removed: {0}")]
    Unsound(String),
    /// The database can't be read.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl From<sqlx::Error> for BackupError {
    fn from(error: sqlx::Error) -> Self {
        Self::Store(SqliteError::from(error).into())
    }
}

/// Ends of the names of a database's own files: itself, its logs, and its lock.
const OWN_FILES: [&str; 5] = ["", "-wal", "-shm", "-journal", ".lock"];

/// Writes a copy of a database, as it is at one moment, to a file that nobody else can read.
///
/// # Errors
/// [`BackupError`]; the destination is unchanged then.
pub async fn back_up(
    database: &Path,
    destination: &Path,
    replace: bool,
) -> Result<Backup, BackupError> {
    let location = Location::of(database)?;
    if location.found.is_none() {
        return Err(BackupError::Missing(database.to_owned()));
    }
    check_destination(&location.path, destination, replace)?;
    check_log(&location.path)?;
    inspect(&location.path).await?;
    let failed = |source| BackupError::Destination {
        path: destination.to_owned(),
        source,
    };
    // Beside the destination, so that it can be renamed; with access for its owner alone.
    let directory = directory_of(destination);
    let copy = tempfile::Builder::new()
        .prefix(".scree-backup-")
        .tempfile_in(directory)
        .map_err(failed)?
        .into_temp_path();
    let name = copy.to_str().ok_or_else(|| {
        let reason = "its folder's name is not valid UTF-8, which SQLite needs";
        failed(io::Error::new(io::ErrorKind::InvalidInput, reason))
    })?;
    copy_to(&location.path, name).await?;
    let jobs = verify(&copy).await?;
    let bytes = sync(&copy).map_err(failed)?;
    publish(copy, destination, replace)?;
    File::open(directory)
        .and_then(|directory| directory.sync_all())
        .map_err(failed)?;
    Ok(Backup { bytes, jobs })
}

/// Checks that a database that a service uses has its write-ahead log: without it jobs are missing
/// in the file, and a new log would take the place of the service's.
fn check_log(database: &Path) -> Result<(), BackupError> {
    if beside(database, "-wal").exists() || !beside(database, ".lock").exists() {
        return Ok(());
    }
    match Lock::of(database).take() {
        Err(StoreError::InUse { .. }) => Err(BackupError::LogMissing(database.to_owned())),
        // The lock is released at once.
        _ => Ok(()),
    }
}

fn check_destination(
    database: &Path,
    destination: &Path,
    replace: bool,
) -> Result<(), BackupError> {
    let real = destination.canonicalize();
    let exists = real.is_ok();
    let place = real.unwrap_or_else(|_| {
        let folder = directory_of(destination).canonicalize().unwrap_or_default();
        folder.join(destination.file_name().unwrap_or_default())
    });
    if OWN_FILES.iter().any(|end| beside(database, end) == place) {
        return Err(BackupError::Itself(destination.to_owned()));
    }
    if exists && !replace {
        return Err(BackupError::Exists(destination.to_owned()));
    }
    Ok(())
}

async fn copy_to(database: &Path, copy: &str) -> Result<(), BackupError> {
    let mut connection = connect_to_read(database).await?;
    // The copy can give free space back, also if the database can't.
    let shrinks: i64 = sqlx::query_scalar("PRAGMA auto_vacuum")
        .fetch_one(&mut connection)
        .await?;
    if shrinks == 0 {
        sqlx::query("PRAGMA auto_vacuum = INCREMENTAL")
            .execute(&mut connection)
            .await?;
    }
    sqlx::query("VACUUM INTO ?1")
        .bind(copy)
        .execute(&mut connection)
        .await?;
    Ok(connection.close().await?)
}

/// Checks a copy, and counts its jobs.
async fn verify(copy: &Path) -> Result<u64, BackupError> {
    let mut connection = immutable(copy).connect().await?;
    let verdict: Vec<String> = sqlx::query_scalar("PRAGMA integrity_check")
        .fetch_all(&mut connection)
        .await?;
    if verdict != ["ok"] {
        return Err(BackupError::Unsound(verdict.join("; ")));
    }
    verify_blocks(&mut connection).await?;
    let jobs: i64 = sqlx::query_scalar("SELECT count(*) FROM jobs")
        .fetch_one(&mut connection)
        .await?;
    connection.close().await?;
    Ok(jobs.unsigned_abs())
}

/// Checks the checksums of all stored blocks.
async fn verify_blocks(connection: &mut SqliteConnection) -> Result<(), BackupError> {
    verify_blocks_of(
        connection,
        "SELECT job_id, checksum, data FROM trajectory_chunks
         UNION ALL SELECT job_id, checksum, data FROM flow_snapshots",
    )
    .await?;
    // A database of a former version has none.
    let has_maps: bool =
        sqlx::query_scalar("SELECT EXISTS (SELECT 1 FROM sqlite_master WHERE name = 'flow_maps')")
            .fetch_one(&mut *connection)
            .await?;
    if has_maps {
        let maps = "SELECT job_id, checksum, data FROM flow_maps";
        verify_blocks_of(connection, maps).await?;
    }
    Ok(())
}

/// Checks the checksums of the blocks that a query finds.
async fn verify_blocks_of(
    connection: &mut SqliteConnection,
    query: &'static str,
) -> Result<(), BackupError> {
    let mut blocks = sqlx::query_as::<_, (String, Vec<u8>, Vec<u8>)>(query).fetch(connection);
    while let Some((job, checksum, data)) = blocks.try_next().await? {
        let sound = <[u8; 32]>::try_from(checksum)
            .is_ok_and(|checksum| Block { data, checksum }.is_sound());
        if !sound {
            return Err(BackupError::Unsound(format!(
                "a block of job {job} does not have its checksum, nor has it in the database; \
                 remove this job there, and try again"
            )));
        }
    }
    Ok(())
}

/// Waits until the copy is on the disk, and returns its length [bytes].
fn sync(copy: &Path) -> io::Result<u64> {
    let file = File::options().write(true).open(copy)?;
    file.sync_all()?;
    Ok(file.metadata()?.len())
}

fn publish(copy: TempPath, destination: &Path, replace: bool) -> Result<(), BackupError> {
    let renamed = if replace {
        copy.persist(destination)
    } else {
        copy.persist_noclobber(destination)
    };
    renamed.map_err(|error| match error.error.kind() {
        io::ErrorKind::AlreadyExists => BackupError::Exists(destination.to_owned()),
        _ => BackupError::Destination {
            path: destination.to_owned(),
            source: error.error,
        },
    })
}
