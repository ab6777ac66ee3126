//! Schema of the database: made and changed by services, checked by workers.

use super::error::{Answer, PostgresError, of_migration};
use crate::jobs::store::StoreError;
use sqlx::PgPool;
use sqlx::migrate::Migrator;

static MIGRATOR: Migrator = sqlx::migrate!("migrations/postgres");

/// Brings a database to this version's schema. Of several services that start at the same time one
/// does so, and the others wait.
///
/// # Errors
/// Its schema is of a later version, or can't be changed.
pub(super) async fn migrate(pool: &PgPool) -> Result<(), StoreError> {
    MIGRATOR.run(pool).await.map_err(of_migration)
}

/// Checks that a database has this version's schema.
///
/// # Errors
/// It has another.
pub(super) async fn check(pool: &PgPool) -> Result<(), StoreError> {
    let found = applied(pool).await.map_err(|error| match error {
        // No table of migrations.
        PostgresError::Database(error) if is_undefined_table(&error) => {
            StoreError::Schema("it holds no jobs: start a service with it first".into())
        }
        error => error.into(),
    })?;
    let wanted = MIGRATOR.iter().map(|migration| migration.version).max();
    if found == wanted {
        return Ok(());
    }
    let number = |version: Option<i64>| version.map_or("none".to_owned(), |v| v.to_string());
    Err(StoreError::Schema(
        format!(
            "its schema is of version {}, and this program's of version {}: use the program that \
             the service is of",
            number(found),
            number(wanted)
        )
        .into(),
    ))
}

async fn applied(pool: &PgPool) -> Answer<Option<i64>> {
    let version = sqlx::query_scalar("SELECT max(version) FROM _sqlx_migrations WHERE success");
    Ok(version.fetch_one(pool).await?)
}

fn is_undefined_table(error: &sqlx::Error) -> bool {
    let code = error.as_database_error().and_then(|error| error.code());
    code.as_deref() == Some("42P01")
}
