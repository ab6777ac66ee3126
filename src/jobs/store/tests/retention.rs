//! Rules of how long a job that has ended is kept, by clocks that jump.

use super::*;

conformance! {
    retention_counts_from_the_end
    what_ended_by_a_clock_set_back_is_kept_as_long_as_anything
    while_the_clock_is_evidently_wrong_no_age_is_taken_by_it
}

const DAY: Duration = Duration::from_secs(86_400);
const DAY_MS: i64 = 86_400_000;

impl<S: JobStore> Fixture<S> {
    async fn submit_and_end(&self) -> JobId {
        let id = self.submit().await;
        let hold = self.claim("a").await;
        assert!(self.store.succeed(hold, "{}", FINGERPRINT).await.unwrap());
        id
    }

    async fn remove_older_than_a_day(&self) -> u64 {
        self.store.remove_ended(DAY_MS).await.unwrap()
    }
}

async fn retention_counts_from_the_end<S: JobStore>(fixture: &Fixture<S>) {
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

// Once these were removed the moment the clock was right again.
async fn what_ended_by_a_clock_set_back_is_kept_as_long_as_anything<S: JobStore>(
    fixture: &Fixture<S>,
) {
    let before = fixture.submit_and_end().await;
    fixture.submit().await;
    let hold = fixture.claim("a").await;
    let back = SignedDuration::from_hours(400 * 24);
    fixture.clock.jump(-back);
    let store = &fixture.store;
    assert!(store.succeed(hold, "{}", FINGERPRINT).await.unwrap());
    let wrong = [
        hold.job,
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

async fn while_the_clock_is_evidently_wrong_no_age_is_taken_by_it<S: JobStore>(
    fixture: &Fixture<S>,
) {
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
