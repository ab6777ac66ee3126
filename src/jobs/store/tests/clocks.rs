//! Rules about time: leases, waits, and retention of jobs that have ended go by the time that
//! passes while the database is open. The time of day may jump.

use super::*;

conformance! {
    a_clock_set_back_holds_up_neither_waiting_nor_lost_jobs
    a_clock_set_forward_costs_nothing
    the_longest_wait_is_one_that_has_passed
    retention_counts_from_the_end
    what_ended_by_a_wrong_clock_is_kept_as_long_as_anything
    what_ended_is_kept_as_long_while_the_clock_jumps_back_and_forth
    the_time_between_stop_and_start_does_not_count
    a_crash_loses_little_of_the_time_that_has_passed
    a_lease_goes_on_after_a_restart_for_what_was_left_of_it
}

const TEN_YEARS: SignedDuration = SignedDuration::from_hours(10 * 365 * 24);

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
    fixture.clock.jump(-TEN_YEARS);
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 0);
    fixture.pass(LEASE);
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 1);
    assert_eq!(fixture.claim("b").await.job, waiting);
    fixture.pass(Duration::from_secs(2));
    assert_eq!(fixture.claim("b").await.job, lost);
}

// Regression: another service took such a job back while its worker was alive.
async fn a_clock_set_forward_costs_nothing(fixture: &Fixture) {
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    fixture.clock.jump(TEN_YEARS);
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 0);
    fixture.pass(LEASE / 2);
    let renewed = fixture
        .store
        .renew(lease, LEASE, &Progress::default())
        .await;
    assert_eq!(renewed.unwrap(), Renewal::Held);
    fixture.clock.jump(-TEN_YEARS * 2);
    fixture.pass(LEASE / 2);
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 0);
    assert!(fixture.succeed(lease).await);
    assert_eq!(fixture.endings(id).await, ["successful"]);
}

async fn the_longest_wait_is_one_that_has_passed(fixture: &Fixture) {
    fixture.submit().await;
    fixture.pass(Duration::from_secs(7));
    for jump in [TEN_YEARS, -TEN_YEARS, -TEN_YEARS] {
        fixture.clock.jump(jump);
        let counts = fixture.store.count_jobs().await.unwrap();
        assert_eq!(counts.oldest_waiting_s, 7.0);
    }
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

    /// Checks that a job which ended just now is kept for a day.
    async fn is_kept_for_a_day(&self, id: JobId) {
        self.pass(DAY - Duration::from_millis(1));
        assert_eq!(self.remove_older_than_a_day().await, 0, "too early");
        self.pass(Duration::from_millis(1));
        assert_eq!(self.remove_older_than_a_day().await, 1, "too late");
        assert!(self.store.job(id).await.unwrap().is_none());
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

// Regression: these were removed the moment the clock was right again, or never.
async fn what_ended_by_a_wrong_clock_is_kept_as_long_as_anything(fixture: &Fixture) {
    for wrong_by in [TEN_YEARS, -TEN_YEARS] {
        fixture.clock.jump(wrong_by);
        let id = fixture.submit_and_end().await;
        assert_eq!(fixture.remove_older_than_a_day().await, 0);
        fixture.clock.jump(-wrong_by);
        assert_eq!(fixture.remove_older_than_a_day().await, 0);
        fixture.is_kept_for_a_day(id).await;

        let id = fixture.submit_and_end().await;
        fixture.clock.jump(wrong_by);
        assert_eq!(fixture.remove_older_than_a_day().await, 0);
        fixture.is_kept_for_a_day(id).await;
        fixture.clock.jump(-wrong_by);
    }
}

async fn what_ended_is_kept_as_long_while_the_clock_jumps_back_and_forth(fixture: &Fixture) {
    fixture.submit_and_end().await;
    for jump in [TEN_YEARS, -TEN_YEARS, -TEN_YEARS, TEN_YEARS].repeat(2) {
        fixture.clock.jump(jump);
        fixture.pass(DAY / 8 - Duration::from_millis(1));
        assert_eq!(fixture.remove_older_than_a_day().await, 0);
    }
    fixture.pass(Duration::from_millis(8));
    assert_eq!(fixture.remove_older_than_a_day().await, 1);
}

async fn the_time_between_stop_and_start_does_not_count(fixture: &Fixture) {
    let id = fixture.submit_and_end().await;
    fixture.pass(DAY / 2);
    let fixture = fixture.reopened_after(DAY * 100).await;
    fixture.clock.jump(TEN_YEARS);
    assert_eq!(fixture.remove_older_than_a_day().await, 0);
    let fixture = fixture.reopened_after(Duration::ZERO).await;
    fixture.clock.jump(-TEN_YEARS * 2);
    fixture.pass(DAY / 2);
    assert_eq!(fixture.remove_older_than_a_day().await, 1);
    assert!(fixture.store.job(id).await.unwrap().is_none());
    let id = fixture.submit_and_end().await;
    fixture.is_kept_for_a_day(id).await;
}

async fn a_crash_loses_little_of_the_time_that_has_passed(fixture: &Fixture) {
    let fixture = fixture.another().await;
    fixture.submit_and_end().await;
    for _ in 0..24 {
        fixture.pass(DAY / 24 - Duration::from_secs(1));
        fixture.store.maintain().await.unwrap();
    }
    let fixture = fixture.opened_after_a_crash().await;
    assert_eq!(fixture.remove_older_than_a_day().await, 0);
    fixture.pass(Duration::from_secs(24));
    assert_eq!(fixture.remove_older_than_a_day().await, 1);
}

async fn a_lease_goes_on_after_a_restart_for_what_was_left_of_it(fixture: &Fixture) {
    fixture.submit().await;
    fixture.claim("a").await;
    fixture.pass(LEASE / 2);
    let fixture = fixture.reopened_after(DAY).await;
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 0);
    fixture.pass(LEASE / 2);
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 1);
}
