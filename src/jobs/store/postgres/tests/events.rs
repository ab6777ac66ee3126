//! Events and news while many processes write.

use super::{Part, open, open_one};
use crate::jobs::clock::SystemClock;
use crate::jobs::job::JobId;
use crate::jobs::store::tests::{FINGERPRINT, Fixture, claimant, new_job, submission};
use crate::jobs::store::{JobStore, StudyStore};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, Instant};
use tokio::time::timeout;

const JOBS: usize = 100;

/// A follower reads while eight writers end jobs at the same time: it sees every event once, in the
/// order of its job, and never one before another that it saw.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_follower_misses_no_event() {
    let fixture = Fixture::new(open).await;
    for _ in 0..JOBS {
        fixture.submit().await;
    }
    let writers = (0..8).map(|writer| {
        let store = Arc::clone(&fixture.store);
        tokio::spawn(async move { end_all(&*store, &format!("w{writer}")).await })
    });
    let writers: Vec<_> = writers.collect();
    let mut seen: BTreeMap<JobId, Vec<String>> = BTreeMap::new();
    let (mut last, mut count) = (0, 0);
    let began = Instant::now();
    while count < 3 * JOBS {
        assert!(began.elapsed() < Duration::from_secs(60), "{count} events");
        for event in fixture.store.events(last, None).await.unwrap() {
            assert!(event.sequence > last);
            last = event.sequence;
            count += 1;
            let of_job = seen.entry(event.job).or_default();
            of_job.push(format!("{:?}", event.change));
        }
    }
    for writer in writers {
        writer.await.unwrap();
    }
    assert!(fixture.store.events(last, None).await.unwrap().is_empty());
    assert_eq!(fixture.store.last_event().await.unwrap(), last);
    for changes in seen.values() {
        let expected = ["Status(Accepted)", "Status(Running)", "Status(Successful)"];
        assert_eq!(changes, &expected);
    }
}

async fn end_all(store: &dyn StudyStore, owner: &str) {
    let claimant = claimant(owner);
    while let Some(claim) = store.claim(&claimant).await.unwrap().pop() {
        assert!(store.succeed(claim.lease, "{}", FINGERPRINT).await.unwrap());
    }
}

/// A worker and a follower elsewhere are told at once.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn other_processes_are_told_of_news() {
    let directory = tempfile::tempdir().unwrap();
    let clock = || Arc::new(SystemClock::default());
    let service = open_one(directory.path(), Part::Service, clock()).await;
    let worker = open_one(directory.path(), Part::Worker, clock()).await;
    // Until the worker listens; what it hears before counts as news, too.
    tokio::time::sleep(Duration::from_millis(300)).await;
    for _ in 0..2 {
        worker.wait_for_jobs().await;
    }
    for _ in 0..3 {
        let waiting = timeout(Duration::from_millis(1_000), worker.wait_for_jobs());
        let jobs = [new_job()];
        let request = submission(&jobs);
        let (heard, submitted) = tokio::join!(waiting, JobStore::submit(&service, &request));
        submitted.unwrap();
        assert!(heard.is_ok(), "not told");
        // The message of this process to itself is heard before the next.
        tokio::time::sleep(Duration::from_millis(100)).await;
    }
    JobStore::close(&worker).await;
    JobStore::close(&service).await;
}

/// Of two services one leads, and the other once that has gone.
#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn one_service_leads() {
    let directory = tempfile::tempdir().unwrap();
    let clock = || Arc::new(SystemClock::default());
    let first = open_one(directory.path(), Part::Service, clock()).await;
    let second = open_one(directory.path(), Part::Service, clock()).await;
    for _ in 0..2 {
        assert!(JobStore::leads(&first).await.unwrap());
        assert!(!JobStore::leads(&second).await.unwrap());
    }
    JobStore::close(&first).await;
    let began = Instant::now();
    while !JobStore::leads(&second).await.unwrap() {
        assert!(began.elapsed() < Duration::from_secs(10));
    }
    JobStore::close(&second).await;
}
