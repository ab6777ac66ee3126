//! Rules of the SQLite driver alone: those that the database enforces, the lock, the kinds of
//! its errors; the file ([`files`]), former versions ([`upgrade`]), backups and space.

mod backups;
mod files;
mod space;
mod upgrade;

use super::SqliteStore;
use crate::jobs::clock::{Clock, SystemClock};
use crate::jobs::failure::Failure;
use crate::jobs::job::JobStatus;
use crate::jobs::store::tests::{FINGERPRINT, Fixture, Opening, results};
use crate::jobs::store::{
    Dismissal, JobStore, NewResults, ResumePoint, StoreError, StoreErrorKind, StoredState,
    StudyStore,
};
use crate::results::chunk::BlockError;
use crate::results::columns::Selection;
use sqlx::{Connection, SqliteConnection};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tempfile::TempDir;

/// Opens an empty database, for the rules of every driver.
pub(in crate::jobs::store) fn open(directory: PathBuf, clock: Arc<dyn Clock>) -> Opening {
    Box::pin(async move {
        let path = directory.join("test.db");
        let store = SqliteStore::open_with(&path, None, clock).await.unwrap();
        Arc::new(store) as Arc<dyn StudyStore>
    })
}

/// A connection to the database past the store.
async fn past(fixture: &Fixture) -> SqliteConnection {
    connect(&fixture.directory.path().join("test.db")).await
}

async fn connect(database: &Path) -> SqliteConnection {
    let url = format!("sqlite://{}", database.display());
    SqliteConnection::connect(&url).await.unwrap()
}

#[tokio::test]
async fn a_damaged_block_is_noticed() {
    let fixture = Fixture::new(open).await;
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    fixture.store.keep(lease, &results(3)).await.unwrap();
    sqlx::query("UPDATE trajectory_chunks SET data = zeroblob(length(data))")
        .execute(&mut past(&fixture).await)
        .await
        .unwrap();
    let read = fixture.store.chunk(id, 0, 0, &Selection::default()).await;
    assert!(matches!(read, Err(StoreError::Block { .. })), "{read:?}");
}

#[tokio::test]
async fn final_states_are_sinks_whatever_the_code_asks_for() {
    let fixture = Fixture::new(open).await;
    let ended = [
        fixture.submit().await,
        fixture.submit().await,
        fixture.submit().await,
    ];
    let leases = [
        fixture.claim("a").await,
        fixture.claim("a").await,
        fixture.claim("a").await,
    ];
    fixture.succeed(leases[0]).await;
    fixture
        .store
        .fail(leases[1], &Failure::internal("x"))
        .await
        .unwrap();
    fixture.store.dismiss(ended[2]).await.unwrap();
    let wanted = [
        JobStatus::Successful,
        JobStatus::Failed,
        JobStatus::Dismissed,
    ];
    assert_eq!(
        fixture.store.dismiss(ended[0]).await.unwrap(),
        Dismissal::Ended(wanted[0])
    );

    for statement in [
        "UPDATE jobs SET status = 'accepted', started_ms = NULL, finished_ms = NULL, ended_operating_ms = NULL, outcome = NULL, problem = NULL",
        "UPDATE jobs SET status = 'running', finished_ms = NULL, ended_operating_ms = NULL, outcome = NULL, problem = NULL",
        "UPDATE jobs SET finished_ms = 0",
        "UPDATE jobs SET ended_operating_ms = 0",
        "UPDATE jobs SET outcome = '[]' WHERE outcome IS NOT NULL",
    ] {
        let refused = sqlx::query(statement)
            .execute(&mut past(&fixture).await)
            .await
            .unwrap_err();
        assert!(
            refused.to_string().contains("the job has ended"),
            "{statement}: {refused}"
        );
    }
    for (id, status) in ended.into_iter().zip(wanted) {
        assert_eq!(fixture.status(id).await, status);
    }
}

#[tokio::test]
async fn outcomes_of_former_versions_get_the_present_keys() {
    let fixture = Fixture::new(open).await;
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    let former = r#"{"flow":{"mass_left_kg":1.5,"volume_left_out_m3":0.0},
        "audit":{"points_put_back":2,"points_left":3,"angular_momentum_spread":0.1,
                 "note":"\"points_left\": not a key"}}"#;
    fixture
        .store
        .succeed(lease, former, FINGERPRINT)
        .await
        .unwrap();
    let renaming = include_str!("../../../../../migrations/0007_outcome_keys.sql");
    sqlx::raw_sql(renaming)
        .execute(&mut past(&fixture).await)
        .await
        .unwrap();
    let found: String = sqlx::query_scalar("SELECT outcome FROM jobs WHERE id = ?")
        .bind(id.to_string())
        .fetch_one(&mut past(&fixture).await)
        .await
        .unwrap();
    let found: serde_json::Value = serde_json::from_str(&found).unwrap();
    let expected = serde_json::json!({
        "flow": {"outflow_mass_kg": 1.5, "excluded_volume_m3": 0.0},
        "conservation": {"penetration_corrections": 2, "points_outflow": 3,
            "angular_momentum_from_shifting": 0.1, "note": "\"points_left\": not a key"}
    });
    assert_eq!(found, expected);
}

#[tokio::test]
async fn rows_that_make_no_sense_are_refused() {
    let fixture = Fixture::new(open).await;
    fixture.submit().await;
    for statement in [
        "UPDATE jobs SET status = 'done'",
        "UPDATE jobs SET status = 'running'",
        "UPDATE jobs SET status = 'running', started_ms = 1, lease_owner = 'a', lease_expires_operating_ms = 9",
        "UPDATE jobs SET lease_owner = 'a', lease_expires_operating_ms = 9",
        "UPDATE jobs SET lease_token = -1",
        "UPDATE jobs SET finished_ms = 1, ended_operating_ms = 1",
        "UPDATE jobs SET status = 'successful', started_ms = 1, finished_ms = 2, ended_operating_ms = 2, outcome = '{}'",
        "UPDATE jobs SET outcome = '{}'",
        "UPDATE jobs SET fraction = 1.5",
        "UPDATE jobs SET steps = 'many'",
        "INSERT INTO trajectory_chunks SELECT 'nobody', 0, 0, 1, 0, 0, 'planes-zstd-1', zeroblob(32), zeroblob(1)",
    ] {
        let done = sqlx::query(statement)
            .execute(&mut past(&fixture).await)
            .await;
        assert!(done.is_err(), "{statement}");
    }
}

#[tokio::test]
async fn no_job_is_run_to_its_end_twice_whatever_the_code_asks_for() {
    let fixture = Fixture::new(open).await;
    fixture.submit().await;
    let lease = fixture.claim("a").await;
    fixture.succeed(lease).await;
    let again = sqlx::query(
        "INSERT INTO attempts (job_id, attempt, owner, started_ms, ended_ms, ending)
         SELECT job_id, 2, owner, 1, 2, ending FROM attempts",
    );
    assert!(again.execute(&mut past(&fixture).await).await.is_err());
}

#[tokio::test]
async fn a_state_of_many_pieces_is_whole_or_noticed() {
    let fixture = Fixture::new(open).await;
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    // Noise does not compress: more than two pieces.
    let mut noise = vec![0; 20 << 20];
    blake3::Hasher::new().finalize_xof().fill(&mut noise);
    let resume_point = ResumePoint {
        time_s: 1.0,
        samples: 1,
        fingerprint: [0; 32],
    };
    let kept = NewResults {
        state: Some(StoredState::pack(resume_point, &noise).unwrap()),
        ..results(1)
    };
    assert!(fixture.store.keep(lease, &kept).await.unwrap());
    let state = fixture.store.state(id).await.unwrap().unwrap();
    assert!(state.unpack().unwrap() == noise);
    sqlx::query("DELETE FROM run_state_pieces WHERE piece = 1")
        .execute(&mut past(&fixture).await)
        .await
        .unwrap();
    let state = fixture.store.state(id).await.unwrap().unwrap();
    assert!(matches!(state.unpack(), Err(BlockError::Checksum)));
}

#[tokio::test]
async fn a_closed_database_leaves_one_file_and_the_lock() {
    let fixture = Fixture::new(open).await;
    fixture.submit().await;
    fixture.store.close().await;
    let entries = std::fs::read_dir(fixture.directory.path()).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["test.db", "test.db.lock"]);
}

// Regression: a link to the database let a second service take over its jobs.
#[cfg(unix)]
#[tokio::test]
async fn a_database_has_one_service_by_whatever_name() {
    let fixture = Fixture::new(open).await;
    let database = fixture.directory.path().join("test.db");
    let link = fixture.directory.path().join("link.db");
    std::os::unix::fs::symlink(&database, &link).unwrap();
    for name in [database, link] {
        let second = SqliteStore::open(&name).await;
        assert!(matches!(second, Err(StoreError::InUse { .. })), "{name:?}");
    }
}

#[tokio::test]
async fn a_database_at_its_limit_is_full() {
    let directory = TempDir::new().unwrap();
    let path = directory.path().join("test.db");
    // What the empty schema takes, and less than a probe more.
    SqliteStore::open(&path).await.unwrap().close().await;
    let taken = std::fs::metadata(&path).unwrap().len();
    let clock = Arc::new(SystemClock::default());
    let store = SqliteStore::open_with(&path, Some(taken + 8192), clock).await;
    let store: Arc<dyn JobStore> = Arc::new(store.unwrap());
    let refused = store.probe().await.unwrap_err();
    assert_eq!(refused.kind(), StoreErrorKind::Full, "{refused}");
    assert!(refused.to_string().contains("full"), "{refused}");
    store.ping().await.expect("it can still be read");
}

#[tokio::test]
async fn a_closed_database_is_unavailable() {
    let fixture = Fixture::new(open).await;
    fixture.store.close().await;
    for answer in [fixture.store.ping().await, fixture.store.probe().await] {
        let refused = answer.unwrap_err();
        assert_eq!(refused.kind(), StoreErrorKind::Unavailable, "{refused}");
    }
}
