//! Rules for every driver of the job store ([`conformance`], [`clocks`], [`pages`],
//! [`races`], [`studies`], [`terrains`], [`model`]). Those of one driver alone are in its folder.

/// Makes each rule a test of every driver; a further driver is one line here.
macro_rules! conformance {
    ($($rule:ident)*) => {
        mod sqlite {
            $(rule_of! { crate::jobs::store::sqlite::tests::open, $rule, })*
        }
        mod postgres {
            $(rule_of! {
                crate::jobs::store::postgres::tests::open, $rule,
                #[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
            })*
        }
    };
}

/// Makes a rule a test of one driver, given by its constructor.
macro_rules! rule_of {
    ($open:path, $rule:ident, $(#[$attribute:meta])?) => {
        $(#[$attribute])?
        #[tokio::test(flavor = "multi_thread", worker_threads = 2)]
        async fn $rule() {
            super::$rule(&super::Fixture::new($open).await).await;
        }
    };
}

mod clocks;
mod conformance;
mod model;
mod pages;
mod races;
mod studies;
mod terrains;

use super::*;
use crate::jobs::clock::Clock;
use crate::jobs::job::{Job, JobId, JobStatus};
use crate::jobs::submit::NewJob;
use crate::results::chunk;
use crate::results::columns::tests::numbered_columns;
use crate::results::flow::StoredSnapshot;
use crate::runs::Progress;
use jiff::{SignedDuration, Timestamp};
use scree_solver::record::FlowSnapshot;
use std::path::PathBuf;
use std::pin::Pin;
use std::sync::{Arc, Mutex};
use std::time::Duration;
use tempfile::TempDir;

/// Duration of leases in these tests.
pub(super) const LEASE: Duration = Duration::from_secs(30);

/// A clock that stands still until it is set.
#[derive(Debug)]
pub(super) struct SetClock(Mutex<(Timestamp, Duration)>);

impl SetClock {
    fn new() -> Self {
        let now = Timestamp::from_second(1_700_000_000).unwrap();
        Self(Mutex::new((now, Duration::ZERO)))
    }

    /// The time of day is set, by so much; no time passes.
    fn jump(&self, by: SignedDuration) {
        self.0.lock().unwrap().0 += by;
    }

    fn pass(&self, time: Duration) {
        let mut clock = self.0.lock().unwrap();
        clock.0 += time;
        clock.1 += time;
    }
}

impl Clock for SetClock {
    fn now(&self) -> Timestamp {
        self.0.lock().unwrap().0
    }

    fn uptime(&self) -> Duration {
        self.0.lock().unwrap().1
    }
}

/// A store that is being opened.
pub(super) type Opening = Pin<Box<dyn Future<Output = Arc<dyn StudyStore>> + Send>>;

/// Constructor of a driver: opens a database, empty at first, in this folder if it is one of files.
pub(super) type Open = fn(PathBuf, Arc<dyn Clock>) -> Opening;

/// A driver with an empty database.
pub(super) struct Fixture {
    pub(super) store: Arc<dyn StudyStore>,
    pub(super) clock: Arc<SetClock>,
    pub(super) directory: Arc<TempDir>,
    open: Open,
}

impl Fixture {
    pub(super) async fn new(open: Open) -> Self {
        Self::within(TempDir::new().unwrap(), open).await
    }

    /// A driver with the database in this folder.
    pub(super) async fn within(directory: TempDir, open: Open) -> Self {
        let directory = Arc::new(directory);
        let clock = Arc::new(SetClock::new());
        let store = open(directory.path().to_owned(), clock.clone()).await;
        Self {
            store,
            clock,
            directory,
            open,
        }
    }

    /// The same database, closed and opened again after this time.
    async fn reopened_after(&self, time: Duration) -> Self {
        self.store.close().await;
        self.pass(time);
        let store = (self.open)(self.directory.path().to_owned(), self.clock.clone()).await;
        Self {
            store,
            clock: self.clock.clone(),
            directory: self.directory.clone(),
            open: self.open,
        }
    }

    /// The same database, opened again without having been closed.
    async fn opened_after_a_crash(self) -> Self {
        drop(self.store);
        let store = (self.open)(self.directory.path().to_owned(), self.clock.clone()).await;
        Self { store, ..self }
    }

    /// Another empty database of the same driver.
    async fn another(&self) -> Self {
        Self::new(self.open).await
    }

    pub(super) async fn submit(&self) -> JobId {
        let jobs = [new_job()];
        let submitted = self.store.submit(&submission(&jobs)).await.unwrap();
        assert_eq!(submitted, Submitted::Accepted);
        jobs[0].id
    }

    async fn try_claim(&self, owner: &str) -> Option<Lease> {
        let claims = self.store.claim(&claimant(owner)).await.unwrap();
        claims.first().map(|claim| claim.lease)
    }

    pub(super) async fn claim(&self, owner: &str) -> Lease {
        self.try_claim(owner).await.expect("a job to claim")
    }

    /// Ends a job with an empty outcome; false if the lease is no longer valid.
    pub(super) async fn succeed(&self, lease: Lease) -> bool {
        self.store.succeed(lease, "{}", FINGERPRINT).await.unwrap()
    }

    pub(super) async fn job(&self, id: JobId) -> Job {
        self.store.job(id).await.unwrap().unwrap()
    }

    pub(super) async fn status(&self, id: JobId) -> JobStatus {
        self.job(id).await.summary.status
    }

    /// Kinds of end of the attempts at a job; "" for one that continues.
    pub(super) async fn endings(&self, id: JobId) -> Vec<String> {
        let attempts = self.job(id).await.attempts;
        attempts
            .into_iter()
            .map(|attempt| attempt.ending.unwrap_or_default())
            .collect()
    }

    pub(super) fn pass(&self, time: Duration) {
        self.clock.pass(time);
    }
}

pub(super) fn new_job() -> NewJob {
    NewJob {
        id: JobId::new(),
        title: "a title".to_owned(),
        bodies: 1,
        scenario: "{}".to_owned(),
        scenario_hash: "0".repeat(64),
        plan: "{}".to_owned(),
        planned_work: 10,
        planned_memory_bytes: 1_000,
        labels: Vec::new(),
        terrains: Vec::new(),
        solver_version: "1",
    }
}

pub(super) fn submission(jobs: &[NewJob]) -> Submission<'_> {
    Submission {
        jobs,
        submitter: None,
        key: None,
        room: Room {
            queue: 1_000,
            submitter: None,
        },
    }
}

pub(super) fn claimant(owner: &str) -> Claimant {
    Claimant {
        owner: owner.to_owned(),
        lease_duration: LEASE,
        solver: Solver {
            version: "2",
            commit: "c",
            instructions: "none",
        },
        up_for: Duration::from_secs(3_600),
        pack: Pack::SINGLE,
        memory_bytes: 1_000_000,
    }
}

pub(super) const FINGERPRINT: &str =
    "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef";

/// Results of the samples 0..count.
pub(super) fn results(count: u32) -> NewResults {
    let columns = numbered_columns(count);
    let snapshot = FlowSnapshot {
        time_s: f64::from(count),
        points: 1,
        thinning: 1,
        point_id: vec![0],
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
        maps: Vec::new(),
        progress: Progress {
            fraction: 0.5,
            steps: 7,
            eta_s: Some(3.0),
            ..Progress::default()
        },
        state: None,
    }
}

/// The same, with the run's state after the results.
pub(super) fn results_and_state(count: u32) -> NewResults {
    let resume_point = ResumePoint {
        time_s: f64::from(count),
        samples: count as usize,
        fingerprint: [9; 32],
    };
    NewResults {
        state: Some(StoredState::pack(resume_point, b"the state").unwrap()),
        ..results(count)
    }
}
