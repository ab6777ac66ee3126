//! Leases that run out while their workers don't notice.

use super::studies::{new_member, new_study};
use super::*;
use crate::jobs::failure::Failure;
use crate::studies::study::{StudyId, StudyStatus};

conformance! {
    no_stale_worker_ever_writes
    a_job_is_claimed_by_one_of_many
    a_study_that_ends_takes_no_job_from_one_that_is_taking_it
    a_removed_study_takes_no_job_from_one_that_is_taking_it
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

/// Number of times that two studies meet over the same jobs.
const MEETINGS: u32 = 20;

/// Members of a study, each with a scenario of its own.
fn members() -> Vec<NewMember> {
    let letters = ('a'..='t').map(String::from);
    let member = |(number, letter): (u64, String)| new_member(number, &letter);
    (0..).zip(letters).map(member).collect()
}

async fn running_study(store: &dyn StudyStore) -> StudyId {
    let id = StudyId::new();
    store.add_study(&new_study(id, "x")).await.unwrap();
    id
}

/// Ends a study successfully.
async fn end(store: &dyn StudyStore, id: StudyId) {
    let end = StudyEnd {
        status: StudyStatus::Successful,
        problem: None,
        document: None,
    };
    store.end_study(id, end).await.unwrap();
}

/// States of the jobs of a study's members.
async fn statuses(store: &dyn StudyStore, id: StudyId) -> Vec<Option<JobStatus>> {
    let members = store.members(id, (0, 0), 100).await.unwrap();
    members.into_iter().map(|member| member.status).collect()
}

/// One study ends while another takes jobs that it has: what the other has in the end waits.
async fn a_study_that_ends_takes_no_job_from_one_that_is_taking_it(fixture: &Fixture) {
    for _ in 0..MEETINGS {
        let store = &*fixture.store;
        let (ends, takes) = (running_study(store).await, running_study(store).await);
        store.add_members(ends, &members()).await.unwrap();
        let (coming, ending) = (Arc::clone(&fixture.store), Arc::clone(&fixture.store));
        let taking = tokio::spawn(async move { coming.add_members(takes, &members()).await });
        let ended = tokio::spawn(async move { end(&*ending, ends).await });
        assert_eq!(taking.await.unwrap().unwrap(), members().len());
        ended.await.unwrap();
        let statuses = statuses(store, takes).await;
        assert_eq!(statuses, [Some(JobStatus::Accepted); 20]);
        end(store, takes).await;
    }
}

/// A study is removed while another takes jobs that it had: the other keeps them.
async fn a_removed_study_takes_no_job_from_one_that_is_taking_it(fixture: &Fixture) {
    let store = &*fixture.store;
    for _ in 0..MEETINGS {
        let gone = running_study(store).await;
        store.add_members(gone, &members()).await.unwrap();
        while let Some(lease) = fixture.try_claim("a").await {
            fixture.succeed(lease).await;
        }
        end(store, gone).await;
        store.remove_study(gone).await.unwrap();
        let takes = running_study(store).await;
        let (coming, removing) = (Arc::clone(&fixture.store), Arc::clone(&fixture.store));
        let taking = tokio::spawn(async move { coming.add_members(takes, &members()).await });
        let removed = tokio::spawn(async move { removing.remove_orphans().await });
        assert_eq!(taking.await.unwrap().unwrap(), members().len());
        removed.await.unwrap().unwrap();
        let lost = statuses(store, takes).await.contains(&None);
        assert!(!lost, "a member's job is gone");
        end(store, takes).await;
        store.remove_study(takes).await.unwrap();
        while store.remove_orphans().await.unwrap() > 0 {}
    }
}
