//! The database of a process: the one place that names the drivers.

use crate::config::{Database, ServiceConfig};
use crate::jobs::clock::SystemClock;
use crate::jobs::store::postgres::PostgresStore;
use crate::jobs::store::sqlite::SqliteStore;
use crate::jobs::store::{StoreError, StudyStore};
use std::sync::Arc;

pub(crate) use crate::jobs::store::postgres::Part;

/// Opens the database for a part of the program, with at most so many connections if it is on a
/// server.
///
/// # Errors
/// It can't be opened, or another process uses its file.
pub(crate) async fn open(
    config: &ServiceConfig,
    part: Part,
    connections: u32,
) -> Result<Arc<dyn StudyStore>, StoreError> {
    let clock = Arc::new(SystemClock::default());
    Ok(match &config.database {
        Database::File(path) => {
            let largest = config.limits.database_bytes;
            Arc::new(SqliteStore::open_with(path, largest, clock).await?)
        }
        Database::Postgres(url) => {
            Arc::new(PostgresStore::open(url, part, connections, clock).await?)
        }
    })
}

/// Name of a process among those that share the database. Where several can, it is never that of
/// another one, nor of a former one: leases alone tell whose jobs are whose.
pub(crate) fn name_of_process(config: &ServiceConfig) -> String {
    let name = &config.queue.name;
    if !config.database.is_shared() {
        return name.clone();
    }
    let host = sysinfo::System::host_name().unwrap_or_default();
    let number = uuid::Uuid::new_v4().simple().to_string();
    format!("{name}@{host}-{}", &number[..8])
}
