//! Rules about time: leases, waits, and retention of jobs that have ended go by the time that
//! passes while the database is open. The time of day may jump.

use super::*;

conformance! {
    a_clock_set_back_holds_up_neither_waiting_nor_lost_jobs
    a_clock_set_forward_costs_nothing
    the_longest_wait_is_one_that_has_passed
    retention_counts_from_the_end
    a_key_outlives_its_last_job_for_its_retention_time
    keys_of_one_submitter_are_bounded_by_their_space
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

/// A job submitted with this key.
async fn submit_with_key(fixture: &Fixture, submitter: &str, text: &str) -> JobId {
    let job = new_job();
    let key = key(text);
    let jobs = [job];
    let submission = Submission {
        submitter: Some(submitter),
        key: Some(&key),
        ..submission(&jobs)
    };
    let submitted = fixture.store.submit(&submission).await.unwrap();
    assert_eq!(submitted, Submitted::Accepted);
    let answer = KeptAnswer {
        status: 202,
        location: None,
        body: "{}".to_owned(),
    };
    let kept = fixture.store.keep_answer(Some(submitter), &key, &answer);
    kept.await.unwrap();
    jobs[0].id
}

fn key(text: &str) -> Key {
    Key {
        text: text.to_owned(),
        request_hash: [7; 32],
    }
}

async fn is_known(fixture: &Fixture, submitter: &str, text: &str) -> bool {
    let key = key(text);
    let former = fixture.store.former_request(Some(submitter), &key);
    former.await.unwrap().is_some()
}

async fn remove(fixture: &Fixture, id: JobId) {
    fixture.store.dismiss(id).await.unwrap();
    assert_eq!(fixture.store.remove(id).await.unwrap(), Removal::Removed);
}

async fn a_key_outlives_its_last_job_for_its_retention_time(fixture: &Fixture) {
    let kept = KeyRetention {
        age_ms: DAY_MS,
        bytes: u64::MAX >> 1,
    };
    let day = Duration::from_millis(DAY_MS as u64);
    let id = submit_with_key(fixture, "lab", "k").await;
    fixture.pass(2 * day);
    fixture.store.maintain().await.unwrap();
    assert_eq!(fixture.store.forget_keys(kept).await.unwrap(), 0);
    remove(fixture, id).await;
    fixture.pass(day / 2);
    assert_eq!(fixture.store.forget_keys(kept).await.unwrap(), 0);
    assert!(is_known(fixture, "lab", "k").await);
    fixture.pass(day / 2);
    assert_eq!(fixture.store.forget_keys(kept).await.unwrap(), 1);
    assert!(!is_known(fixture, "lab", "k").await);
}

async fn keys_of_one_submitter_are_bounded_by_their_space(fixture: &Fixture) {
    let few = KeyRetention {
        age_ms: DAY_MS,
        bytes: 4_000,
    };
    let other = submit_with_key(fixture, "other", "first").await;
    remove(fixture, other).await;
    let alive = submit_with_key(fixture, "lab", "alive").await;
    for number in 0..200 {
        let id = submit_with_key(fixture, "lab", &number.to_string()).await;
        remove(fixture, id).await;
    }
    let mut forgotten = 0;
    loop {
        let more = fixture.store.forget_keys(few).await.unwrap();
        forgotten += more;
        if more == 0 {
            break;
        }
    }
    assert!((185..200).contains(&forgotten), "{forgotten}");
    assert!(!is_known(fixture, "lab", "0").await);
    for (submitter, key) in [("lab", "199"), ("lab", "alive"), ("other", "first")] {
        assert!(is_known(fixture, submitter, key).await, "{key}");
    }
    assert_eq!(fixture.status(alive).await, JobStatus::Accepted);
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
