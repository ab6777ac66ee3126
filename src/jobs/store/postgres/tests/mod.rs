//! Rules of the PostgreSQL driver alone. Each test has a database of its own on the server that
//! TEST_POSTGRES_URL names, where its user may make databases.

mod cut_off;
mod events;
mod packs;
mod server;

use super::{Part, PostgresStore};
use crate::jobs::clock::Clock;
use crate::jobs::store::StudyStore;
use crate::jobs::store::tests::Opening;
use sqlx::{AssertSqlSafe, Connection, PgConnection};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Opens a database, empty at first, for the rules of every driver.
pub(in crate::jobs::store) fn open(directory: PathBuf, clock: Arc<dyn Clock>) -> Opening {
    Box::pin(async move {
        Arc::new(open_one(&directory, Part::Service, clock).await) as Arc<dyn StudyStore>
    })
}

async fn open_one(directory: &Path, part: Part, clock: Arc<dyn Clock>) -> PostgresStore {
    let url = url(directory).await;
    let opened = PostgresStore::open(&url, part, 12, clock).await;
    opened.unwrap()
}

/// URL of the database of a test, which is made at the first call.
async fn url(directory: &Path) -> String {
    let server = std::env::var("TEST_POSTGRES_URL").expect("TEST_POSTGRES_URL");
    let note = directory.join("database");
    let name = match fs::read_to_string(&note) {
        Ok(name) => name,
        Err(_) => {
            let name = format!("scree_test_{}", uuid::Uuid::new_v4().simple());
            let mut connection = PgConnection::connect(&server).await.unwrap();
            // Without its own copy of the template in the log of the server, which takes longer.
            sqlx::query(AssertSqlSafe(format!(
                "CREATE DATABASE {name} STRATEGY file_copy"
            )))
            .execute(&mut connection)
            .await
            .unwrap();
            fs::write(&note, &name).unwrap();
            name
        }
    };
    let (place, _) = server.rsplit_once('/').unwrap();
    format!("{place}/{name}")
}
