//! Errors of the driver, and the kind of each for the port.

use crate::jobs::store::{StoreError, StoreErrorKind};
use sqlx::migrate::MigrateError;

/// Answer of the database, within this folder.
pub(super) type Answer<T> = Result<T, SqliteError>;

/// Error within this folder, before it is sorted by its kind.
#[derive(Debug)]
pub(super) enum SqliteError {
    /// Error of the database.
    Database(sqlx::Error),
    /// Error of a row or block that it holds.
    Content(StoreError),
}

impl From<sqlx::Error> for SqliteError {
    fn from(error: sqlx::Error) -> Self {
        Self::Database(error)
    }
}

impl From<StoreError> for SqliteError {
    fn from(error: StoreError) -> Self {
        Self::Content(error)
    }
}

impl From<SqliteError> for StoreError {
    fn from(error: SqliteError) -> Self {
        match error {
            SqliteError::Database(error) => Self::of_kind(kind(&error), error.into()),
            SqliteError::Content(error) => error,
        }
    }
}

impl SqliteError {
    /// True if the file is no database at all, by its first bytes.
    pub(super) fn is_no_database(&self) -> bool {
        matches!(self, Self::Database(error) if code(error) == Some(SQLITE_NOTADB))
    }

    /// True if the connection's file could not be opened for writing.
    pub(super) fn is_read_only(&self) -> bool {
        matches!(self, Self::Database(error) if code(error) == Some(SQLITE_READONLY))
    }
}

const SQLITE_READONLY: i32 = 8;
const SQLITE_FULL: i32 = 13;
const SQLITE_NOTADB: i32 = 26;

/// BUSY, LOCKED, READONLY, IOERR, CORRUPT, CANTOPEN, NOTADB.
const UNAVAILABLE: [i32; 7] = [5, 6, 8, 10, 11, 14, 26];

/// Error of a migration; that of a database that is full or can't be written is not one of
/// the schema.
pub(super) fn of_migration(error: MigrateError) -> StoreError {
    let kind = match &error {
        MigrateError::Execute(error) | MigrateError::ExecuteMigration(error, _) => kind(error),
        _ => StoreErrorKind::Defect,
    };
    match kind {
        StoreErrorKind::Damaged | StoreErrorKind::Defect => StoreError::Schema(error.into()),
        StoreErrorKind::Full | StoreErrorKind::Unavailable => {
            StoreError::of_kind(kind, error.into())
        }
    }
}

fn kind(error: &sqlx::Error) -> StoreErrorKind {
    match (code(error), error) {
        (Some(SQLITE_FULL), _) => StoreErrorKind::Full,
        (Some(code), _) if UNAVAILABLE.contains(&code) => StoreErrorKind::Unavailable,
        (None, sqlx::Error::PoolTimedOut | sqlx::Error::PoolClosed | sqlx::Error::Io(_)) => {
            StoreErrorKind::Unavailable
        }
        _ => StoreErrorKind::Defect,
    }
}

/// Primary code of an error of SQLite.
fn code(error: &sqlx::Error) -> Option<i32> {
    let code: i32 = error.as_database_error()?.code()?.parse().ok()?;
    // The lowest byte of an extended code is the primary one.
    Some(code & 0xff)
}
