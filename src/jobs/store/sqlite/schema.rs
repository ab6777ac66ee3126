//! Preparation of a database: its migrations, and the marks and settings that are stored in
//! its file.

use super::error::{Answer, SqliteError, of_migration};
use super::inspection::{APPLICATION_ID, Inspected, Version};
use crate::jobs::store::{StoreError, StoreErrorKind};
use sqlx::migrate::Migrator;
use sqlx::sqlite::{SqliteAutoVacuum, SqliteConnectOptions, SqliteConnection};
use sqlx::{ConnectOptions, Connection};

pub(super) static MIGRATOR: Migrator = sqlx::migrate!();

/// Length up to which a database of a former version is rewritten at the start, so that it
/// can give free space back to the system [bytes]: this takes about a second. A longer one
/// becomes so in a copy by `scree backup`.
const REWRITTEN_BYTES: u64 = 64 << 20;

/// Brings a database to this version's schema and settings.
///
/// # Errors
/// Its schema is of a former version and can't be changed.
pub(super) async fn prepare(
    options: &SqliteConnectOptions,
    inspected: Inspected,
) -> Result<(), StoreError> {
    match inspected.version {
        Version::Former => migrate(options).await?,
        Version::Current => {}
    }
    let empty = inspected.bytes == 0;
    let rewrite = !inspected.shrinks && !empty && inspected.bytes <= REWRITTEN_BYTES;
    if (rewrite || !inspected.marked)
        && let Err(error) = settle(options, rewrite).await
    {
        let error = StoreError::from(error);
        // A database that can't be written is read as it is.
        tracing::warn!(%error, "the database keeps its former settings");
    }
    Ok(())
}

async fn migrate(options: &SqliteConnectOptions) -> Result<(), StoreError> {
    let connected = connect(options).await;
    let mut connection = connected.map_err(|error| pending(error.into()))?;
    let migrated = MIGRATOR.run_direct(None, &mut connection, false).await;
    let migrated = migrated.map_err(|error| pending(of_migration(error)));
    connection.close().await.map_err(SqliteError::from)?;
    migrated
}

/// Error of a schema that must be changed and can't be.
fn pending(error: StoreError) -> StoreError {
    let text = format!(
        "{error}; its schema must first be brought to this version, for which it must be writable"
    );
    match error.kind() {
        StoreErrorKind::Full => StoreError::Full(text.into()),
        StoreErrorKind::Unavailable => StoreError::Unavailable(text.into()),
        StoreErrorKind::Damaged | StoreErrorKind::Defect => error,
    }
}

async fn settle(options: &SqliteConnectOptions, rewrite: bool) -> Answer<()> {
    let mut connection = connect(options).await?;
    let settled = write_settings(&mut connection, rewrite).await;
    connection.close().await?;
    settled
}

async fn write_settings(connection: &mut SqliteConnection, rewrite: bool) -> Answer<()> {
    sqlx::query(sqlx::AssertSqlSafe(format!(
        "PRAGMA application_id = {APPLICATION_ID}"
    )))
    .execute(&mut *connection)
    .await?;
    if rewrite {
        sqlx::query("VACUUM").execute(connection).await?;
    }
    Ok(())
}

/// Connection for changes of the schema. Foreign keys are off, since a table that is made
/// anew is dropped in between; the setting of `auto_vacuum` holds from the first table or the
/// next `VACUUM` on.
async fn connect(options: &SqliteConnectOptions) -> Answer<SqliteConnection> {
    let options = options.clone().foreign_keys(false);
    let options = options.auto_vacuum(SqliteAutoVacuum::Incremental);
    Ok(options.connect().await?)
}
