//! Leases that run out while their workers don't notice.

use super::*;
use crate::jobs::failure::Failure;

conformance! {
    no_stale_worker_ever_writes
    a_job_is_claimed_by_one_of_many
}

/// Number of times that a lease is made to run out.
const RACES: u32 = 200;

/// A worker sleeps through its lease, another claims the job, and both write
/// at the same time. In whatever order the database executes them, only the writes of the second
/// worker count.
async fn no_stale_worker_ever_writes(fixture: &Fixture) {
    let mut stale_writes = 0;
    for race in 0..RACES {
        let id = fixture.submit().await;
        let stale = fixture.claim("a").await;
        fixture.pass(LEASE);
        fixture.store.reclaim_expired("b").await.unwrap();
        fixture.pass(Duration::from_secs(10));
        let fresh = fixture.claim("b").await;
        assert_eq!(fresh.job, id);

        let old = tokio::spawn(write_as_a_stale_worker(
            Arc::clone(&fixture.store),
            stale,
            race,
        ));
        let new = tokio::spawn(write_to_the_end(Arc::clone(&fixture.store), fresh));
        stale_writes += old.await.unwrap();
        new.await.unwrap();
        let job = fixture.job(id).await;
        assert_eq!(job.outcome.unwrap().get(), "{\"by\":\"b\"}");
        let snapshot = fixture.store.snapshot(id, None).await.unwrap().unwrap();
        assert_eq!(snapshot.time_s, 5.0);
        assert_eq!(fixture.endings(id).await, ["expired", "successful"]);
    }
    assert_eq!(stale_writes, 0, "of {RACES} races");
}

/// Tries every kind of write; returns the number of accepted ones.
async fn write_as_a_stale_worker(store: Arc<dyn StudyStore>, lease: Lease, race: u32) -> u32 {
    let mut written = 0;
    let progress = Progress::default();
    written += u32::from(store.keep(lease, &results_and_state(9)).await.unwrap());
    let renewed = store.renew(lease, LEASE, &progress).await.unwrap();
    written += u32::from(renewed != Renewal::Lost);
    let ended = match race % 4 {
        0 => store.succeed(lease, "{\"by\":\"a\"}", FINGERPRINT).await,
        1 => store.fail(lease, &Failure::internal("a")).await,
        2 => store.release(lease).await,
        _ => store.begin(lease, &AttemptStart::Afresh, 1).await,
    };
    written + u32::from(ended.unwrap())
}

async fn write_to_the_end(store: Arc<dyn StudyStore>, lease: Lease) {
    assert!(store.keep(lease, &results_and_state(5)).await.unwrap());
    let ended = store.succeed(lease, "{\"by\":\"b\"}", FINGERPRINT).await;
    assert!(ended.unwrap());
}

/// Many workers claim at once: every job goes to exactly one of them.
async fn a_job_is_claimed_by_one_of_many(fixture: &Fixture) {
    let mut submitted = Vec::new();
    for _ in 0..50 {
        submitted.push(fixture.submit().await);
    }
    let workers = (0..8).map(|worker| {
        let store = Arc::clone(&fixture.store);
        tokio::spawn(async move {
            let mut claimed = Vec::new();
            let claimant = claimant(&format!("worker {worker}"));
            loop {
                let claims = store.claim(&claimant).await.unwrap();
                if claims.is_empty() {
                    return claimed;
                }
                claimed.extend(claims.iter().map(|claim| claim.lease.job));
            }
        })
    });
    let workers: Vec<_> = workers.collect();
    let mut claimed = Vec::new();
    for worker in workers {
        claimed.extend(worker.await.unwrap());
    }
    claimed.sort();
    submitted.sort();
    assert_eq!(claimed, submitted);
}
