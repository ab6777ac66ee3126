//! Packs of jobs that a worker claims at once.

use super::open;
use crate::jobs::job::{JobId, JobStatus};
use crate::jobs::store::tests::{Fixture, claimant, new_job, submission};
use crate::jobs::store::{Claim, Claimant, FailedAttempt, Pack, StudyStore};
use crate::jobs::submit::NewJob;
use std::time::Duration;

/// Jobs with this planned work, in the queue.
async fn submit(fixture: &Fixture, work: &[u64]) -> Vec<JobId> {
    let job = |&planned_work: &u64| NewJob {
        planned_work,
        ..new_job()
    };
    let jobs: Vec<_> = work.iter().map(job).collect();
    fixture.store.submit(&submission(&jobs)).await.unwrap();
    jobs.iter().map(|job| job.id).collect()
}

async fn claim(store: &dyn StudyStore, jobs: u32, work: u64) -> Vec<Claim> {
    let claimant = Claimant {
        pack: Pack { jobs, work },
        ..claimant("a")
    };
    store.claim(&claimant).await.unwrap()
}

fn jobs(claims: &[Claim]) -> Vec<JobId> {
    claims.iter().map(|claim| claim.lease.job).collect()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_pack_has_jobs_in_turn_as_far_as_their_work_fits() {
    let fixture = Fixture::new(open).await;
    let ids = submit(&fixture, &[70, 20, 20, 5, 500, 5]).await;
    let store = &*fixture.store;
    assert_eq!(jobs(&claim(store, 8, 100).await), ids[..2]);
    assert_eq!(jobs(&claim(store, 8, 100).await), ids[2..4]);
    assert_eq!(
        jobs(&claim(store, 8, 100).await),
        ids[4..5],
        "large jobs come alone"
    );
    assert_eq!(jobs(&claim(store, 8, 100).await), ids[5..]);
    assert!(claim(store, 8, 100).await.is_empty());
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_lease_that_ran_out_before_its_job_began_is_no_failed_attempt() {
    let fixture = Fixture::new(open).await;
    let ids = submit(&fixture, &[1, 1, 1]).await;
    let claims = claim(&*fixture.store, 8, 100).await;
    assert_eq!(jobs(&claims), ids);
    fixture.pass(Duration::from_secs(30));
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 3);
    // The first may be what killed the worker: it waits, and the others come one by one now.
    let again = claim(&*fixture.store, 8, 100).await;
    assert_eq!(jobs(&again), ids[1..2]);
    assert_eq!(again[0].failed_attempts, 0);
    assert_eq!(jobs(&claim(&*fixture.store, 8, 100).await), ids[2..]);
    fixture.pass(Duration::from_secs(2));
    let first = claim(&*fixture.store, 8, 100).await;
    assert_eq!(jobs(&first), ids[..1]);
    assert_eq!(first[0].failed_attempts, 1);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_job_that_had_a_worker_before_comes_in_no_pack() {
    let fixture = Fixture::new(open).await;
    let ids = submit(&fixture, &[1, 1, 1]).await;
    let claims = claim(&*fixture.store, 8, 100).await;
    let failed = FailedAttempt::Infrastructure("x".to_owned());
    let middle = claims[1].lease;
    fixture.store.fail_attempt(middle, &failed).await.unwrap();
    for claim in [&claims[0], &claims[2]] {
        assert!(fixture.store.release(claim.lease).await.unwrap());
    }
    fixture.pass(Duration::from_secs(2));
    for id in ids {
        assert_eq!(jobs(&claim(&*fixture.store, 8, 100).await), [id]);
    }
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_worker_claims_no_job_that_it_has_no_memory_for() {
    let fixture = Fixture::new(open).await;
    let large = NewJob {
        planned_memory_bytes: 2_000_000,
        ..new_job()
    };
    let jobs = [large, new_job()];
    fixture.store.submit(&submission(&jobs)).await.unwrap();
    assert_eq!(fixture.claim("small").await.job, jobs[1].id);
    assert_eq!(fixture.status(jobs[0].id).await, JobStatus::Accepted);
    assert!(!fixture.store.is_idle(0).await.unwrap(), "one runs");
    let claimant = Claimant {
        memory_bytes: 2_000_000,
        ..claimant("large")
    };
    let claims = fixture.store.claim(&claimant).await.unwrap();
    assert_eq!(claims[0].lease.job, jobs[0].id);
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_queue_of_jobs_that_others_have_memory_for_is_empty() {
    let fixture = Fixture::new(open).await;
    fixture.submit().await;
    assert!(!fixture.store.is_idle(1_000).await.unwrap());
    assert!(fixture.store.is_idle(999).await.unwrap());
}
