//! First look at a database file: whose it is and of which version, before anything is
//! written.

use super::error::{Answer, SqliteError};
use super::file::beside;
use super::schema::MIGRATOR;
use crate::jobs::store::StoreError;
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{ConnectOptions, Connection};
use std::fs;
use std::path::{Path, PathBuf};
use thiserror::Error;

/// `PRAGMA application_id` of a database of this program: "Scre".
pub(super) const APPLICATION_ID: i64 = 0x5363_7265;

/// Schema of a database.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Version {
    /// That of this program.
    Current,
    /// None yet, or that of a former version.
    Former,
}

/// Result of the look.
#[derive(Debug, Clone, Copy)]
pub(super) struct Inspected {
    pub(super) version: Version,
    /// True if it has this program's application id; a restored dump has none.
    pub(super) marked: bool,
    /// True if it can give free space back to the system.
    pub(super) shrinks: bool,
    /// Its length [bytes].
    pub(super) bytes: u64,
}

impl Inspected {
    /// Result for a file that does not exist.
    pub(super) const NOTHING: Self = Self {
        version: Version::Former,
        marked: false,
        shrinks: false,
        bytes: 0,
    };
}

/// A database that this program does not touch.
#[derive(Debug, Error)]
#[error("{}: {fault}", path.display())]
struct ForeignDatabase {
    path: PathBuf,
    fault: Fault,
}

#[derive(Debug, Error)]
enum Fault {
    #[error("not a database: name another file, or restore a backup; this one was left as it is")]
    NoDatabase,
    #[error(
        "a database of another program (its tables are not those of scree): name another file; \
         this one was left as it is"
    )]
    Foreign,
    #[error(
        "a database of a newer version of scree (its schema has migration {0}, this version knows \
         those up to {1}): start that version, or restore a backup from before the upgrade; the \
         file was left as it is"
    )]
    Newer(i64, i64),
}

/// Looks at a database, read-only.
///
/// # Errors
/// It is not a database, that of another program, or of a newer version.
pub(super) async fn inspect(path: &Path) -> Result<Inspected, StoreError> {
    // Without a log no connection is open that could write it, and none is created.
    let logged = beside(path, "-wal").exists();
    let connected = if logged {
        connect_to_read(path).await
    } else {
        immutable(path).connect().await
    };
    let looked = match connected {
        Ok(mut connection) => {
            let looked = look(&mut connection).await;
            connection.close().await.map_err(SqliteError::from)?;
            looked
        }
        Err(error) => Err(error.into()),
    };
    let looked = match looked {
        Err(error) if error.is_no_database() => Err(Fault::NoDatabase),
        looked => looked?,
    };
    looked.map_err(|fault| {
        let path = path.to_owned();
        StoreError::Schema(ForeignDatabase { path, fault }.into())
    })
}

/// A connection to a file that nobody writes, which needs no further file.
pub(super) fn immutable(path: &Path) -> SqliteConnectOptions {
    let options = SqliteConnectOptions::new().filename(path);
    options.read_only(true).immutable(true)
}

/// True if all of a database is in its main file.
pub(super) fn is_complete(path: &Path) -> bool {
    fs::metadata(beside(path, "-wal")).map_or(true, |log| log.len() == 0)
}

/// A connection that reads beside a service, or where nobody can write.
pub(super) async fn connect_to_read(path: &Path) -> Result<SqliteConnection, sqlx::Error> {
    let options = SqliteConnectOptions::new().filename(path).read_only(true);
    match has_read(options).await {
        Err(_) if is_complete(path) => has_read(immutable(path)).await,
        connected => connected,
    }
}

async fn has_read(options: SqliteConnectOptions) -> Result<SqliteConnection, sqlx::Error> {
    let mut connection = options.connect().await?;
    sqlx::query("SELECT count(*) FROM sqlite_schema")
        .execute(&mut connection)
        .await?;
    Ok(connection)
}

async fn look(connection: &mut SqliteConnection) -> Answer<Result<Inspected, Fault>> {
    let tables: Vec<String> =
        sqlx::query_scalar("SELECT name FROM sqlite_schema WHERE type = 'table'")
            .fetch_all(&mut *connection)
            .await?;
    let (id, vacuum, bytes): (i64, i64, i64) = sqlx::query_as(
        "SELECT application_id, auto_vacuum, page_count * page_size
         FROM pragma_application_id, pragma_auto_vacuum, pragma_page_count, pragma_page_size",
    )
    .fetch_one(&mut *connection)
    .await?;
    let has = |name: &str| tables.iter().any(|table| table == name);
    if ![0, APPLICATION_ID].contains(&id)
        || !(tables.is_empty() || has(MIGRATOR.table_name.as_ref()))
    {
        return Ok(Err(Fault::Foreign));
    }
    let applied: Vec<(i64, Vec<u8>)> = if tables.is_empty() {
        Vec::new()
    } else {
        sqlx::query_as("SELECT version, checksum FROM _sqlx_migrations ORDER BY version")
            .fetch_all(connection)
            .await?
    };
    Ok(version(&applied).map(|version| Inspected {
        version,
        marked: id == APPLICATION_ID,
        shrinks: vacuum == INCREMENTAL,
        bytes: bytes.unsigned_abs(),
    }))
}

/// Value of `PRAGMA auto_vacuum`.
const INCREMENTAL: i64 = 2;

fn version(applied: &[(i64, Vec<u8>)]) -> Result<Version, Fault> {
    let known = MIGRATOR.iter();
    let newest = known.map(|known| known.version).max().unwrap_or(0);
    let ours = |(version, checksum): &(i64, Vec<u8>)| {
        let mut known = MIGRATOR.iter();
        known.any(|known| known.version == *version && known.checksum[..] == checksum[..])
    };
    // Whatever came later, the first migration never changes.
    if applied.first().is_some_and(|first| !ours(first)) {
        return Err(Fault::Foreign);
    }
    if let Some((version, _)) = applied.iter().find(|(version, _)| *version > newest) {
        return Err(Fault::Newer(*version, newest));
    }
    // One that is not as it was compiled in is reported by the migration.
    let current = applied.len() == MIGRATOR.iter().count() && applied.iter().all(ours);
    Ok(if current {
        Version::Current
    } else {
        Version::Former
    })
}
