//! Rules that depend on the clock, which may jump: leases, waits, and retention of jobs that
//! have ended.

use super::*;

conformance! {
    a_clock_set_back_holds_up_neither_waiting_nor_lost_jobs
    a_clock_set_forward_costs_a_lease_and_nothing_else
    retention_counts_from_the_end
    what_ended_by_a_clock_set_back_is_kept_as_long_as_anything
    while_the_clock_is_evidently_wrong_no_age_is_taken_by_it
}

async fn a_clock_set_back_holds_up_neither_waiting_nor_lost_jobs(fixture: &Fixture) {
    let waiting = fixture.submit().await;
    let lease = fixture.claim("a").await;
    let failed_attempt = FailedAttempt::Infrastructure("x".to_owned());
    fixture
        .store
        .fail_attempt(lease, &failed_attempt)
        .await
        .unwrap();
    let lost = fixture.submit().await;
    assert_eq!(fixture.claim("a").await.job, lost, "the other one waits");
    fixture.clock.jump(SignedDuration::from_hours(-24));
    assert_eq!(fixture.store.reclaim_expired("b", LEASE).await.unwrap(), 1);
    fixture.pass(Duration::from_secs(2));
    assert_eq!(fixture.claim("b").await.job, waiting);
    assert_eq!(fixture.claim("b").await.job, lost);
}

async fn a_clock_set_forward_costs_a_lease_and_nothing_else(fixture: &Fixture) {
    let id = fixture.submit().await;
    let old = fixture.claim("a").await;
    fixture.clock.jump(SignedDuration::from_hours(24));
    assert_eq!(fixture.store.reclaim_own("b").await.unwrap(), 0);
    assert_eq!(fixture.store.reclaim_expired("a", LEASE).await.unwrap(), 0);
    let progress = Progress::default();
    let renewed = fixture.store.renew(old, LEASE, &progress).await.unwrap();
    assert_eq!(renewed, Renewal::Held, "nobody was faster");
    assert_eq!(fixture.store.reclaim_expired("b", LEASE).await.unwrap(), 0);
    assert!(fixture.succeed(old).await);
    assert_eq!(fixture.endings(id).await, ["successful"]);
}

const DAY: Duration = Duration::from_secs(86_400);
const DAY_MS: i64 = 86_400_000;

impl Fixture {
    async fn submit_and_end(&self) -> JobId {
        let id = self.submit().await;
        let lease = self.claim("a").await;
        assert!(self.succeed(lease).await);
        id
    }

    async fn remove_older_than_a_day(&self) -> u64 {
        self.store.remove_ended(DAY_MS).await.unwrap()
    }
}

async fn retention_counts_from_the_end(fixture: &Fixture) {
    let first = fixture.submit_and_end().await;
    fixture.pass(DAY / 2);
    let second = fixture.submit_and_end().await;
    fixture.submit().await;
    assert_eq!(fixture.remove_older_than_a_day().await, 0);
    fixture.pass(DAY / 2);
    assert_eq!(fixture.remove_older_than_a_day().await, 1);
    assert!(fixture.store.job(first).await.unwrap().is_none());
    fixture.pass(DAY);
    assert_eq!(fixture.remove_older_than_a_day().await, 1);
    assert!(fixture.store.job(second).await.unwrap().is_none());
    fixture.pass(DAY * 9);
    assert_eq!(fixture.remove_older_than_a_day().await, 0, "it never ended");
}

// Regression: these were removed the moment the clock was right again.
async fn what_ended_by_a_clock_set_back_is_kept_as_long_as_anything(fixture: &Fixture) {
    let before = fixture.submit_and_end().await;
    fixture.submit().await;
    let lease = fixture.claim("a").await;
    let back = SignedDuration::from_hours(400 * 24);
    fixture.clock.jump(-back);
    let store = &fixture.store;
    assert!(store.succeed(lease, "{}", FINGERPRINT).await.unwrap());
    let wrong = [
        lease.job,
        fixture.submit_and_end().await,
        fixture.submit_and_end().await,
    ];
    store.remove(wrong[2]).await.unwrap();
    assert_eq!(fixture.remove_older_than_a_day().await, 0);
    fixture.clock.jump(back);
    fixture.pass(DAY / 2);
    assert_eq!(fixture.remove_older_than_a_day().await, 0);
    fixture.pass(DAY / 2);
    assert_eq!(fixture.remove_older_than_a_day().await, 1);
    assert!(store.job(before).await.unwrap().is_none());
    fixture.pass(DAY / 2);
    assert_eq!(fixture.remove_older_than_a_day().await, 2);
    for id in wrong {
        assert!(store.job(id).await.unwrap().is_none());
    }
}

async fn while_the_clock_is_evidently_wrong_no_age_is_taken_by_it(fixture: &Fixture) {
    fixture.submit_and_end().await;
    fixture.clock.jump(-SignedDuration::from_hours(400 * 24));
    fixture.submit_and_end().await;
    fixture.pass(DAY * 2);
    assert_eq!(fixture.remove_older_than_a_day().await, 0);
    fixture.clock.jump(SignedDuration::from_hours(400 * 24));
    assert_eq!(fixture.remove_older_than_a_day().await, 1, "the first one");
    fixture.pass(DAY);
    assert_eq!(fixture.remove_older_than_a_day().await, 1);
}
