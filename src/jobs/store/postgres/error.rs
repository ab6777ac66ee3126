//! Errors of the driver, and the kind of each for the port.

use crate::jobs::store::{StoreError, StoreErrorKind};
use sqlx::migrate::MigrateError;

/// Answer of the database, within this folder.
pub(super) type Answer<T> = Result<T, PostgresError>;

/// Error within this folder, before it is sorted by its kind.
#[derive(Debug)]
pub(super) enum PostgresError {
    /// Error of the database.
    Database(sqlx::Error),
    /// Error of a row or block that it holds.
    Content(StoreError),
}

impl From<sqlx::Error> for PostgresError {
    fn from(error: sqlx::Error) -> Self {
        Self::Database(error)
    }
}

impl From<StoreError> for PostgresError {
    fn from(error: StoreError) -> Self {
        Self::Content(error)
    }
}

impl From<PostgresError> for StoreError {
    fn from(error: PostgresError) -> Self {
        match error {
            PostgresError::Database(sqlx::Error::PoolTimedOut) => Self::Unavailable(
                "the server gives no connection: is it running, in reach, and has it room for one \
                 more (max_connections)?"
                    .into(),
            ),
            PostgresError::Database(error) => Self::of_kind(kind(&error), error.into()),
            PostgresError::Content(error) => error,
        }
    }
}

/// Error of a migration; that of a server that can't be reached or written is not one of the
/// schema.
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

/// Classes of SQLSTATE by which the server is out of reach or refuses for now: connections,
/// rolled back by the server, insufficient resources, intervention of an operator, errors of its
/// system, read-only, refused logins.
const UNAVAILABLE: [&str; 7] = ["08", "40", "53", "57", "58", "25", "28"];

const DISK_FULL: &str = "53100";

fn kind(error: &sqlx::Error) -> StoreErrorKind {
    let state = error
        .as_database_error()
        .and_then(|error| error.code().map(String::from));
    match (state.as_deref(), error) {
        (Some(DISK_FULL), _) => StoreErrorKind::Full,
        (Some(state), _) if UNAVAILABLE.iter().any(|class| state.starts_with(class)) => {
            StoreErrorKind::Unavailable
        }
        (
            None,
            sqlx::Error::PoolTimedOut
            | sqlx::Error::PoolClosed
            | sqlx::Error::Io(_)
            | sqlx::Error::Tls(_)
            | sqlx::Error::Protocol(_)
            | sqlx::Error::WorkerCrashed,
        ) => StoreErrorKind::Unavailable,
        _ => StoreErrorKind::Defect,
    }
}
