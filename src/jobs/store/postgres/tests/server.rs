//! Rules that the server itself enforces, and its refusals.

use super::{Part, PostgresStore, open, open_one, url};
use crate::jobs::clock::SystemClock;
use crate::jobs::store::tests::Fixture;
use crate::jobs::store::{StoreError, StoreErrorKind};
use sqlx::{AssertSqlSafe, Connection, PgConnection};
use std::sync::Arc;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn final_states_are_sinks_whatever_the_code_asks_for() {
    let fixture = Fixture::new(open).await;
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    fixture.succeed(lease).await;
    let database = url(fixture.directory.path()).await;
    let mut past = PgConnection::connect(&database).await.unwrap();
    for statement in [
        "UPDATE jobs SET status = 'accepted', started_ms = NULL, finished_ms = NULL,
             ended_operating_ms = NULL, outcome = NULL",
        "UPDATE jobs SET finished_ms = 0",
        "UPDATE jobs SET ended_operating_ms = 0",
        "UPDATE jobs SET outcome = '[]'",
    ] {
        let refused = sqlx::query(statement).execute(&mut past).await.unwrap_err();
        let text = refused.to_string();
        assert!(text.contains("the job has ended"), "{statement}: {text}");
    }
    assert!(fixture.status(id).await.is_final());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_job_can_not_be_run_to_its_end_twice() {
    let fixture = Fixture::new(open).await;
    fixture.submit().await;
    let lease = fixture.claim("a").await;
    fixture.succeed(lease).await;
    let database = url(fixture.directory.path()).await;
    let mut past = PgConnection::connect(&database).await.unwrap();
    let second = "INSERT INTO attempts (job_id, attempt, owner, started_ms, ended_ms, ending)
                  SELECT id, 2, 'b', 1, 2, 'successful' FROM jobs";
    let refused = sqlx::query(second).execute(&mut past).await.unwrap_err();
    assert!(
        refused.to_string().contains("attempts_to_the_end"),
        "{refused}"
    );
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_worker_needs_the_schema_of_its_version() {
    let directory = tempfile::tempdir().unwrap();
    let url = url(directory.path()).await;
    let opened =
        async |part| PostgresStore::open(&url, part, 2, Arc::new(SystemClock::default())).await;
    let empty = opened(Part::Worker).await.unwrap_err().to_string();
    assert!(empty.contains("start a service with it first"), "{empty}");
    opened(Part::Service).await.unwrap().close().await;
    opened(Part::Worker).await.unwrap().close().await;
    let mut past = PgConnection::connect(&url).await.unwrap();
    let later =
        "INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time)
                 VALUES (99999, 'later', true, '', 0)";
    sqlx::query(later).execute(&mut past).await.unwrap();
    for part in [Part::Worker, Part::Service] {
        let error = opened(part).await.unwrap_err();
        assert!(matches!(error, StoreError::Schema(_)), "{error}");
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_server_that_is_gone_makes_the_database_unavailable() {
    let nowhere = "postgres://scree@127.0.0.1:1/scree";
    let clock = Arc::new(SystemClock::default());
    let refused = PostgresStore::open(nowhere, Part::Worker, 2, clock).await;
    assert_eq!(refused.unwrap_err().kind(), StoreErrorKind::Unavailable);
}

/// Sessions that the server has ended are replaced, and lose nothing that was acknowledged.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn sessions_that_the_server_ends_are_replaced() {
    let directory = tempfile::tempdir().unwrap();
    let clock = Arc::new(SystemClock::default());
    let store = open_one(directory.path(), Part::Service, clock).await;
    let url = url(directory.path()).await;
    for _ in 0..5 {
        let mut past = PgConnection::connect(&url).await.unwrap();
        let end = "SELECT pg_terminate_backend(pid) FROM pg_stat_activity
                   WHERE datname = current_database() AND pid <> pg_backend_pid()";
        sqlx::query(AssertSqlSafe(end))
            .execute(&mut past)
            .await
            .unwrap();
        // Each session fails once.
        let mut refused = 0;
        while let Err(error) = store.last_event().await.map_err(StoreError::from) {
            assert_eq!(error.kind(), StoreErrorKind::Unavailable, "{error}");
            refused += 1;
            assert!(refused <= 20);
        }
    }
    store.close().await;
}
