//! What any driver of the job store must hold to.

use super::*;
use crate::jobs::failure::Failure;
use crate::jobs::job::{Job, JobStatus};
use crate::jobs::progress::Progress;
use crate::jobs::submit::NewJob;
use crate::results::chunk;
use crate::results::columns::Selection;
use crate::results::columns::tests::numbered_columns;
use crate::results::flow::StoredSnapshot;
use scree_solver::record::FlowSnapshot;
use tempfile::TempDir;

struct Fixture {
    store: Store,
    directory: TempDir,
}

impl Fixture {
    async fn new() -> Self {
        let directory = TempDir::new().unwrap();
        let store = Store::open(&directory.path().join("test.db"))
            .await
            .unwrap();
        Self { store, directory }
    }

    async fn submit(&self) -> JobId {
        let job = NewJob {
            id: JobId::new(),
            title: "a title".to_owned(),
            bodies: 1,
            scenario: "{}".to_owned(),
            solver_version: "1",
        };
        self.store.submit(&job).await.unwrap();
        job.id
    }

    async fn claim(&self) -> Hold {
        self.store.claim("2").await.unwrap().unwrap().hold
    }

    async fn job(&self, id: JobId) -> Job {
        self.store.job(id).await.unwrap().unwrap()
    }

    async fn status(&self, id: JobId) -> JobStatus {
        self.job(id).await.summary.status
    }
}

/// Results of the samples 0..count.
fn results(count: u32) -> NewResults {
    let columns = numbered_columns(count);
    let snapshot = FlowSnapshot {
        time_s: f64::from(count),
        points: 1,
        thinning: 1,
        position_m: vec![[1.0, 2.0, 3.0]],
        speed_m_s: vec![0.5],
    };
    NewResults {
        chunks: vec![NewChunk {
            body: 0,
            first_sample: 0,
            samples: columns.len(),
            first_time_s: columns.time_s[0],
            last_time_s: columns.time_s[columns.len() - 1],
            block: chunk::encode(&columns).unwrap(),
        }],
        snapshots: vec![StoredSnapshot::pack(&snapshot).unwrap()],
        progress: Progress {
            fraction: 0.5,
            steps: 7,
            eta_s: Some(3.0),
            ..Progress::default()
        },
    }
}

#[tokio::test]
async fn jobs_are_claimed_in_the_order_of_submission_and_once() {
    let fixture = Fixture::new().await;
    let jobs = [fixture.submit().await, fixture.submit().await];
    assert_eq!(
        fixture.claim().await,
        Hold {
            job: jobs[0],
            attempt: 1
        }
    );
    assert_eq!(fixture.claim().await.job, jobs[1]);
    assert_eq!(fixture.store.claim("2").await.unwrap(), None);
    let job = fixture.job(jobs[0]).await;
    assert_eq!(job.summary.status, JobStatus::Running);
    assert_eq!(job.solver_version, "2", "the solver that runs it");
    assert!(job.summary.started.unwrap() >= job.summary.created);
}

#[tokio::test]
async fn a_growing_chunk_replaces_itself_and_reads_back() {
    let fixture = Fixture::new().await;
    let id = fixture.submit().await;
    let hold = fixture.claim().await;
    for count in [3, 8] {
        assert!(fixture.store.keep(hold, &results(count)).await.unwrap());
    }
    let all = Selection::default();
    let stored = fixture.store.chunk(id, 0, 0, &all).await.unwrap().unwrap();
    assert_eq!(
        (stored.next_sample, stored.columns),
        (8, numbered_columns(8))
    );
    assert_eq!(fixture.store.chunk(id, 0, 8, &all).await.unwrap(), None);
    assert_eq!(fixture.store.chunk(id, 1, 0, &all).await.unwrap(), None);
    let late = Selection {
        from_s: Some(0.08),
        ..all
    };
    assert_eq!(fixture.store.chunk(id, 0, 0, &late).await.unwrap(), None);
    let progress = fixture.job(id).await.summary.progress;
    assert_eq!((progress.steps, progress.eta_s), (7, Some(3.0)));
}

#[tokio::test]
async fn the_nearest_snapshot_is_found_the_earlier_of_two() {
    let fixture = Fixture::new().await;
    let id = fixture.submit().await;
    let hold = fixture.claim().await;
    assert_eq!(fixture.store.snapshot(id, None).await.unwrap(), None);
    for time in [2, 4, 8] {
        fixture.store.keep(hold, &results(time)).await.unwrap();
    }
    for (asked, found) in [
        (Some(-1.0), 2.0),
        (Some(3.0), 2.0),
        (Some(3.1), 4.0),
        (Some(9e9), 8.0),
        (None, 8.0),
    ] {
        let snapshot = fixture.store.snapshot(id, asked).await.unwrap().unwrap();
        assert_eq!(snapshot.time_s, found, "{asked:?}");
    }
}

#[tokio::test]
async fn a_damaged_block_is_noticed() {
    let fixture = Fixture::new().await;
    let id = fixture.submit().await;
    let hold = fixture.claim().await;
    fixture.store.keep(hold, &results(3)).await.unwrap();
    sqlx::query("UPDATE trajectory_chunks SET data = zeroblob(length(data))")
        .execute(&fixture.store.writer)
        .await
        .unwrap();
    let read = fixture.store.chunk(id, 0, 0, &Selection::default()).await;
    assert!(matches!(read, Err(StoreError::Block { .. })), "{read:?}");
}

#[tokio::test]
async fn a_worker_that_lost_its_job_can_not_write() {
    let fixture = Fixture::new().await;
    let id = fixture.submit().await;
    let old = fixture.claim().await;
    fixture.store.keep(old, &results(3)).await.unwrap();
    assert!(fixture.store.put_back(old).await.unwrap());
    assert_eq!(
        fixture
            .store
            .chunk(id, 0, 0, &Selection::default())
            .await
            .unwrap(),
        None
    );
    assert_eq!(fixture.store.snapshot(id, None).await.unwrap(), None);
    let new = fixture.claim().await;
    assert_eq!(
        new,
        Hold {
            job: id,
            attempt: 2
        }
    );

    assert!(!fixture.store.keep(old, &results(5)).await.unwrap());
    assert!(!fixture.store.succeed(old, "{}").await.unwrap());
    assert!(
        !fixture
            .store
            .fail(old, &Failure::internal("x"))
            .await
            .unwrap()
    );
    assert!(!fixture.store.put_back(old).await.unwrap());
    assert!(!fixture.store.is_running(old).await.unwrap());
    assert_eq!(fixture.store.snapshot(id, None).await.unwrap(), None);
    assert!(fixture.store.is_running(new).await.unwrap());
    assert!(fixture.store.succeed(new, "{\"bodies\":[]}").await.unwrap());
    let job = fixture.job(id).await;
    assert_eq!(job.outcome.unwrap().get(), "{\"bodies\":[]}");
    assert_eq!(job.summary.progress.fraction, 1.0);
}

#[tokio::test]
async fn a_dismissed_job_keeps_what_its_worker_still_had_and_stays_dismissed() {
    let fixture = Fixture::new().await;
    let id = fixture.submit().await;
    let hold = fixture.claim().await;
    assert_eq!(
        fixture.store.dismiss(id).await.unwrap(),
        Dismissal::Dismissed
    );
    assert!(fixture.store.keep(hold, &results(4)).await.unwrap());
    assert!(!fixture.store.put_back(hold).await.unwrap());
    assert!(!fixture.store.succeed(hold, "{}").await.unwrap());
    assert_eq!(fixture.status(id).await, JobStatus::Dismissed);
    assert!(
        fixture
            .store
            .chunk(id, 0, 0, &Selection::default())
            .await
            .unwrap()
            .is_some()
    );
    assert_eq!(fixture.job(id).await.summary.progress.eta_s, None);
    assert_eq!(
        fixture.store.dismiss(id).await.unwrap(),
        Dismissal::Dismissed
    );
    assert_eq!(
        fixture.store.dismiss(JobId::new()).await.unwrap(),
        Dismissal::Unknown
    );
}

#[tokio::test]
async fn final_states_are_sinks_whatever_the_code_asks_for() {
    let fixture = Fixture::new().await;
    let ended = [
        fixture.submit().await,
        fixture.submit().await,
        fixture.submit().await,
    ];
    let holds = [
        fixture.claim().await,
        fixture.claim().await,
        fixture.claim().await,
    ];
    fixture.store.succeed(holds[0], "{}").await.unwrap();
    fixture
        .store
        .fail(holds[1], &Failure::internal("x"))
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
        "UPDATE jobs SET status = 'accepted', started_ms = NULL, finished_ms = NULL, outcome = NULL, problem = NULL",
        "UPDATE jobs SET status = 'running', finished_ms = NULL, outcome = NULL, problem = NULL",
        "UPDATE jobs SET finished_ms = 0",
        "UPDATE jobs SET outcome = '[]' WHERE outcome IS NOT NULL",
    ] {
        let refused = sqlx::query(statement)
            .execute(&fixture.store.writer)
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
async fn rows_that_make_no_sense_are_refused() {
    let fixture = Fixture::new().await;
    fixture.submit().await;
    for statement in [
        "UPDATE jobs SET status = 'done'",
        "UPDATE jobs SET status = 'running'",
        "UPDATE jobs SET finished_ms = 1",
        "UPDATE jobs SET status = 'successful', started_ms = 1, finished_ms = 2, outcome = '{}'",
        "UPDATE jobs SET outcome = '{}'",
        "UPDATE jobs SET scenario = 'no JSON'",
        "UPDATE jobs SET fraction = 1.5",
        "UPDATE jobs SET steps = 'many'",
        "INSERT INTO trajectory_chunks SELECT 'nobody', 0, 0, 1, 0, 0, 'planes-zstd-1', zeroblob(32), zeroblob(1)",
    ] {
        let done = sqlx::query(statement).execute(&fixture.store.writer).await;
        assert!(done.is_err(), "{statement}");
    }
}

#[tokio::test]
async fn a_closed_database_leaves_one_file_and_the_lock() {
    let fixture = Fixture::new().await;
    fixture.submit().await;
    fixture.store.close().await;
    let entries = std::fs::read_dir(fixture.directory.path()).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["test.db", "test.db.lock"]);
}

// Once a link to the database let a second service take over its jobs.
#[cfg(unix)]
#[tokio::test]
async fn a_database_has_one_service_by_whatever_name() {
    let fixture = Fixture::new().await;
    let database = fixture.directory.path().join("test.db");
    let link = fixture.directory.path().join("link.db");
    std::os::unix::fs::symlink(&database, &link).unwrap();
    for name in [database, link] {
        let second = Store::open(&name).await;
        assert!(matches!(second, Err(StoreError::InUse(_))), "{name:?}");
    }
}
