//! Rules for every driver of the job store, one per test.

use super::*;
use crate::jobs::failure::Failure;
use crate::results::columns::Selection;
use crate::results::terrain::{MapQuantity, StoredMap};
use scree_solver::raster::Raster;

conformance! {
    jobs_are_claimed_in_the_order_of_submission_and_once
    a_job_ends_once_and_says_how
    a_growing_chunk_replaces_itself_and_reads_back
    the_size_of_results_is_that_of_what_grows_no_more
    maps_of_the_flow_are_kept_and_go_with_their_attempt
    the_nearest_snapshot_is_found_the_earlier_of_two
    a_worker_that_lost_its_job_can_not_write
    a_dismissed_job_keeps_what_its_worker_still_had_and_stays_dismissed
    a_lease_that_is_renewed_does_not_run_out
    a_lease_that_ran_out_is_another_s_to_take
    a_claim_whose_answer_got_lost_is_taken_back
    a_saved_job_whose_lease_ran_out_is_taken_at_once
    a_former_self_s_jobs_are_taken_back_at_once_and_no_others
    the_third_failed_attempt_in_a_row_is_the_last
    a_job_cut_off_waits_until_the_service_has_lived_as_long
    after_a_failed_attempt_a_job_waits_longer_each_time
    a_saved_state_comes_back_and_ends_the_row_of_failed_attempts
    an_attempt_begins_at_its_saved_state_or_afresh
    a_job_handed_back_keeps_its_state_and_has_no_failed_attempt
    a_removal_is_the_last_event_of_a_job_and_the_only_one_left
    a_database_that_can_be_read_and_written_says_so
}

async fn a_database_that_can_be_read_and_written_says_so(fixture: &Fixture) {
    fixture.store.ping().await.unwrap();
    for _ in 0..2 {
        fixture.store.probe().await.unwrap();
    }
    fixture.store.maintain().await.unwrap();
}

// Regression: a process that had no other beside it ran such a job for ever.
async fn a_claim_whose_answer_got_lost_is_taken_back(fixture: &Fixture) {
    let id = fixture.submit().await;
    fixture.claim("a").await;
    fixture.pass(LEASE + Duration::from_secs(59));
    assert_eq!(fixture.store.reclaim_expired("a").await.unwrap(), 0);
    fixture.pass(Duration::from_secs(1));
    assert_eq!(fixture.store.reclaim_expired("a").await.unwrap(), 1);
    assert_eq!(fixture.status(id).await, JobStatus::Accepted);
}

async fn a_removal_is_the_last_event_of_a_job_and_the_only_one_left(fixture: &Fixture) {
    let removed = fixture.submit().await;
    let other = fixture.submit().await;
    fixture.store.dismiss(removed).await.unwrap();
    let last = fixture.store.last_event().await.unwrap();
    fixture.store.remove(removed).await.unwrap();
    let removal = Event {
        sequence: last + 1,
        job: removed,
        change: Change::Removed,
        attempt: 0,
    };
    let of_one = fixture.store.events(0, Some(removed)).await.unwrap();
    assert_eq!(of_one, [removal]);
    let of_all = fixture.store.events(0, None).await.unwrap();
    assert_eq!(of_all.len(), 2, "{of_all:?}");
    assert_eq!(of_all[0].job, other);
    assert_eq!(of_all[1], removal);
    assert_eq!(fixture.store.last_event().await.unwrap(), last + 1);
}

async fn jobs_are_claimed_in_the_order_of_submission_and_once(fixture: &Fixture) {
    let jobs = [fixture.submit().await, fixture.submit().await];
    let first = fixture.claim("a").await;
    assert_eq!((first.job, first.attempt), (jobs[0], 1));
    assert_eq!(fixture.claim("b").await.job, jobs[1]);
    assert_eq!(fixture.try_claim("a").await, None);
    let job = fixture.job(jobs[0]).await;
    assert_eq!(job.summary.status, JobStatus::Running);
    assert_eq!(
        job.provenance.solver_version, "2",
        "the solver that runs it"
    );
    assert!(job.summary.started.unwrap() >= job.summary.created);
}

async fn a_job_ends_once_and_says_how(fixture: &Fixture) {
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    let failure = Failure::internal("x");
    assert!(fixture.succeed(lease).await);
    assert!(
        !fixture
            .store
            .succeed(lease, "[]", FINGERPRINT)
            .await
            .unwrap()
    );
    assert!(!fixture.store.fail(lease, &failure).await.unwrap());
    let job = fixture.job(id).await;
    assert_eq!(job.outcome.unwrap().get(), "{}");
    assert_eq!(job.provenance.fingerprint.as_deref(), Some(FINGERPRINT));
    assert_eq!(job.summary.progress.fraction, 1.0);
    assert_eq!(fixture.endings(id).await, ["successful"]);

    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    assert!(fixture.store.fail(lease, &failure).await.unwrap());
    assert!(!fixture.succeed(lease).await);
    assert!(fixture.job(id).await.problem.is_some());
    assert_eq!(fixture.endings(id).await, ["failed"]);
    assert_eq!(fixture.try_claim("a").await, None, "a failure is final");
}

async fn a_growing_chunk_replaces_itself_and_reads_back(fixture: &Fixture) {
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    for count in [3, 8] {
        assert!(fixture.store.keep(lease, &results(count)).await.unwrap());
    }
    let all = Selection::default();
    let stored = fixture.store.chunk(id, 0, 0, &all).await.unwrap().unwrap();
    let found = (stored.next_sample, stored.columns);
    assert_eq!(found, (8, numbered_columns(8)));
    let last = fixture.store.last_chunk(id, 0).await.unwrap();
    assert_eq!(last, Some((0, numbered_columns(8))));
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

async fn the_size_of_results_is_that_of_what_grows_no_more(fixture: &Fixture) {
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    let bytes = async || fixture.store.results_bytes(id).await.unwrap();
    assert_eq!(bytes().await, 0);
    let few = results(8);
    assert!(fixture.store.keep(lease, &few).await.unwrap());
    let of_snapshot = few.snapshots[0].block.data.len() as u64;
    assert_eq!(bytes().await, of_snapshot, "the chunk still grows");
    let full = results(chunk::CHUNK_SAMPLES as u32);
    assert!(fixture.store.keep(lease, &full).await.unwrap());
    assert_eq!(bytes().await, of_snapshot + full.complete_bytes());
    assert_eq!(full.complete_bytes(), full.bytes());
}

async fn maps_of_the_flow_are_kept_and_go_with_their_attempt(fixture: &Fixture) {
    let store = &fixture.store;
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    let map = |quantity, value| StoredMap::of(quantity, &raster(value)).unwrap();
    let (height, deposit) = (MapQuantity::FlowHeightMax, MapQuantity::Deposit);
    assert!(store.flow_maps(id).await.unwrap().is_empty());
    assert_eq!(store.flow_map(id, height).await.unwrap(), None);
    // Written again if it is not known whether it was written.
    for value in [1.0, 2.0] {
        let kept = NewResults {
            maps: vec![map(deposit, value), map(height, value + 5.0)],
            ..NewResults::default()
        };
        assert!(store.keep(lease, &kept).await.unwrap());
        assert_eq!(store.results_bytes(id).await.unwrap(), kept.bytes());
    }
    assert_eq!(store.flow_maps(id).await.unwrap(), [height, deposit]);
    let found = store.flow_map(id, height).await.unwrap();
    assert_eq!(found, Some(map(height, 7.0)));
    let speed = MapQuantity::FlowSpeedMax;
    assert_eq!(store.flow_map(id, speed).await.unwrap(), None);
    assert!(store.release(lease).await.unwrap());
    let next = fixture.claim("a").await;
    assert_eq!(store.flow_maps(id).await.unwrap().len(), 2);
    assert!(store.begin(next, &AttemptStart::Afresh, 1).await.unwrap());
    assert!(store.flow_maps(id).await.unwrap().is_empty());
}

fn raster(value: f64) -> Raster {
    Raster {
        columns: 3,
        rows: 3,
        cell_size: 1.0,
        west: 0.0,
        south: 0.0,
        epsg: None,
        values: vec![value; 9],
    }
}

async fn the_nearest_snapshot_is_found_the_earlier_of_two(fixture: &Fixture) {
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    assert_eq!(fixture.store.snapshot(id, None).await.unwrap(), None);
    for time in [2, 4, 8, 8] {
        fixture.store.keep(lease, &results(time)).await.unwrap();
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

async fn a_worker_that_lost_its_job_can_not_write(fixture: &Fixture) {
    let store = &fixture.store;
    let id = fixture.submit().await;
    let old = fixture.claim("a").await;
    assert!(store.release(old).await.unwrap());
    let new = fixture.claim("b").await;
    assert_eq!((new.job, new.attempt), (id, 2));
    assert!(new.token > old.token);

    let failed_attempt = FailedAttempt::Infrastructure("x".to_owned());
    assert!(!store.keep(old, &results_and_state(5)).await.unwrap());
    assert!(!store.succeed(old, "{}", FINGERPRINT).await.unwrap());
    assert!(!store.fail(old, &Failure::internal("x")).await.unwrap());
    assert!(!store.release(old).await.unwrap());
    assert!(!store.begin(old, &AttemptStart::Afresh, 1).await.unwrap());
    assert_eq!(
        store.fail_attempt(old, &failed_attempt).await.unwrap(),
        Returned::Lost
    );
    let progress = Progress::default();
    let renewed = store.renew(old, LEASE, &progress).await.unwrap();
    assert_eq!(renewed, Renewal::Lost);
    assert_eq!(store.snapshot(id, None).await.unwrap(), None);
    assert_eq!(store.state(id).await.unwrap(), None);
    assert_eq!(fixture.endings(id).await, ["handed-back", ""]);

    assert!(store.succeed(new, "{}", FINGERPRINT).await.unwrap());
    assert_eq!(fixture.endings(id).await, ["handed-back", "successful"]);
}

async fn a_dismissed_job_keeps_what_its_worker_still_had_and_stays_dismissed(fixture: &Fixture) {
    let store = &fixture.store;
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    store.keep(lease, &results_and_state(3)).await.unwrap();
    assert_eq!(store.dismiss(id).await.unwrap(), Dismissal::Dismissed);
    let renewed = store.renew(lease, LEASE, &Progress::default()).await;
    assert_eq!(renewed.unwrap(), Renewal::Dismissed);
    assert!(store.keep(lease, &results_and_state(4)).await.unwrap());
    assert_eq!(store.state(id).await.unwrap(), None, "it never goes on");
    assert!(!store.release(lease).await.unwrap());
    assert!(!store.succeed(lease, "{}", FINGERPRINT).await.unwrap());
    assert_eq!(fixture.status(id).await, JobStatus::Dismissed);
    let all = Selection::default();
    let kept = store.chunk(id, 0, 0, &all).await.unwrap().unwrap();
    assert_eq!(kept.next_sample, 4);
    assert_eq!(fixture.job(id).await.summary.progress.eta_s, None);
    assert_eq!(store.dismiss(id).await.unwrap(), Dismissal::Dismissed);
    assert_eq!(fixture.endings(id).await, ["dismissed"]);
    let nobody = store.dismiss(JobId::new()).await.unwrap();
    assert_eq!(nobody, Dismissal::Unknown);
}

async fn a_lease_that_is_renewed_does_not_run_out(fixture: &Fixture) {
    fixture.submit().await;
    let lease = fixture.claim("a").await;
    let progress = Progress {
        fraction: 0.25,
        ..Progress::default()
    };
    for _ in 0..5 {
        fixture.pass(LEASE / 2);
        let renewed = fixture.store.renew(lease, LEASE, &progress).await.unwrap();
        assert_eq!(renewed, Renewal::Held);
        let taken = fixture.store.reclaim_expired("b").await.unwrap();
        assert_eq!(taken, 0);
    }
    assert_eq!(fixture.job(lease.job).await.summary.progress, progress);
}

async fn a_lease_that_ran_out_is_another_s_to_take(fixture: &Fixture) {
    let id = fixture.submit().await;
    let old = fixture.claim("a").await;
    fixture.pass(LEASE);
    let own = fixture.store.reclaim_expired("a").await.unwrap();
    assert_eq!(own, 0, "its own process knows better");
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 1);
    assert_eq!(fixture.status(id).await, JobStatus::Accepted);
    fixture.pass(Duration::from_secs(10));
    let new = fixture.claim("b").await;
    assert_eq!((new.job, new.attempt), (id, 2));
    assert!(!fixture.store.keep(old, &results(3)).await.unwrap());
    assert_eq!(fixture.endings(id).await, ["expired", ""]);
}

async fn a_saved_job_whose_lease_ran_out_is_taken_at_once(fixture: &Fixture) {
    let id = fixture.submit().await;
    let at_once = |owner: &str| Claimant {
        up_for: Duration::ZERO,
        ..claimant(owner)
    };
    for (own, other) in [("a", "b"), ("b", "a")].repeat(TOLERATED_SETBACKS as usize) {
        let claim = fixture.store.claim(&at_once(own)).await.unwrap();
        let claim = claim.first().expect("what has got on waits for nothing");
        assert_eq!((claim.lease.job, claim.failed_attempts), (id, 0));
        let kept = results_and_state(3);
        assert!(fixture.store.keep(claim.lease, &kept).await.unwrap());
        fixture.pass(LEASE);
        let taken = fixture.store.reclaim_expired(other).await;
        assert_eq!(taken.unwrap(), 1);
    }
    let others = fixture.submit().await;
    fixture.claim("a").await;
    assert_eq!(fixture.claim("a").await.job, others);
    fixture.pass(LEASE);
    assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 2);
    assert_eq!(fixture.try_claim("b").await, None, "these saved nothing");
}

async fn a_former_self_s_jobs_are_taken_back_at_once_and_no_others(fixture: &Fixture) {
    let jobs = [fixture.submit().await, fixture.submit().await];
    fixture.claim("a").await;
    fixture.claim("b").await;
    assert_eq!(fixture.store.reclaim_own("a").await.unwrap(), 1);
    assert_eq!(fixture.status(jobs[1]).await, JobStatus::Running);
    let again = fixture.claim("a").await;
    assert_eq!((again.job, again.attempt), (jobs[0], 2));
    assert_eq!(fixture.endings(jobs[0]).await, ["cut-off", ""]);
}

async fn the_third_failed_attempt_in_a_row_is_the_last(fixture: &Fixture) {
    let id = fixture.submit().await;
    for attempt in 1..=TOLERATED_SETBACKS {
        assert_eq!(fixture.claim("a").await.attempt, attempt);
        assert_eq!(fixture.store.reclaim_own("a").await.unwrap(), 1);
    }
    let job = fixture.job(id).await;
    assert_eq!(job.summary.status, JobStatus::Failed);
    assert!(job.problem.unwrap().get().contains("cut-off"));
    assert_eq!(fixture.endings(id).await, ["cut-off"; 3]);
    assert_eq!(fixture.try_claim("a").await, None);
}

// A service that is killed repeatedly, sooner than it could have run the job, fails
// nothing: the job waits for a service that stays up longer, and other jobs go first.
async fn a_job_cut_off_waits_until_the_service_has_lived_as_long(fixture: &Fixture) {
    let store = &fixture.store;
    let id = fixture.submit().await;
    let after = |up_ms: u64| Claimant {
        up_for: Duration::from_millis(up_ms),
        ..claimant("a")
    };
    for (wait_ms, failed_attempts) in [(0, 0), (2_000, 1), (8_000, 2)] {
        if wait_ms > 0 {
            let too_soon = after(wait_ms - 1);
            for _ in 0..5 {
                assert_eq!(store.reclaim_own("a").await.unwrap(), 0);
                fixture.pass(Duration::from_secs(60));
                assert_eq!(store.claim(&too_soon).await.unwrap(), []);
            }
            let other = fixture.submit().await;
            let claim = store.claim(&too_soon).await.unwrap().remove(0);
            assert_eq!((claim.lease.job, claim.failed_attempts), (other, 0));
            assert!(store.succeed(claim.lease, "{}", FINGERPRINT).await.unwrap());
        }
        let claim = store.claim(&after(wait_ms)).await.unwrap().remove(0);
        assert_eq!(
            (claim.lease.job, claim.failed_attempts),
            (id, failed_attempts)
        );
        assert_eq!(store.reclaim_own("a").await.unwrap(), 1);
    }
    assert_eq!(fixture.status(id).await, JobStatus::Failed);
}

async fn after_a_failed_attempt_a_job_waits_longer_each_time(fixture: &Fixture) {
    let id = fixture.submit().await;
    let failed_attempt = FailedAttempt::Infrastructure("no room".to_owned());
    for wait_s in [2, 8] {
        let lease = fixture.claim("a").await;
        let returned = fixture
            .store
            .fail_attempt(lease, &failed_attempt)
            .await
            .unwrap();
        assert_eq!(returned, Returned::Waiting);
        fixture.pass(Duration::from_millis(wait_s * 1000 - 1));
        assert_eq!(fixture.try_claim("a").await, None);
        fixture.pass(Duration::from_millis(1));
    }
    let lease = fixture.claim("a").await;
    let returned = fixture
        .store
        .fail_attempt(lease, &failed_attempt)
        .await
        .unwrap();
    assert_eq!(returned, Returned::Failed);
    let problem = fixture.job(id).await.problem.unwrap();
    assert!(problem.get().contains("urn:scree:failure:infrastructure"));
    assert!(problem.get().contains("no room"));
    let attempts = fixture.job(id).await.attempts;
    assert_eq!(attempts[0].detail.as_deref(), Some("no room"));
}

async fn a_saved_state_comes_back_and_ends_the_row_of_failed_attempts(fixture: &Fixture) {
    let id = fixture.submit().await;
    let at_once = Claimant {
        up_for: Duration::ZERO,
        ..claimant("a")
    };
    for count in 1..=2 * TOLERATED_SETBACKS {
        // A job that made progress waits for nothing.
        let claim = fixture.store.claim(&at_once).await.unwrap().remove(0);
        let lease = claim.lease;
        assert_eq!(claim.failed_attempts, 0);
        let kept = results_and_state(count);
        assert!(fixture.store.keep(lease, &kept).await.unwrap());
        let state = fixture.store.state(id).await.unwrap().unwrap();
        assert_eq!(Some(&state), kept.state.as_ref());
        assert_eq!(state.unpack().unwrap(), b"the state");
        fixture.store.reclaim_own("a").await.unwrap();
        let progress = fixture.job(id).await.summary.progress;
        assert_eq!((progress.fraction, progress.eta_s), (0.5, None));
    }
    let lease = fixture.claim("a").await;
    fixture.succeed(lease).await;
    assert_eq!(fixture.store.state(id).await.unwrap(), None);
}

async fn an_attempt_begins_at_its_saved_state_or_afresh(fixture: &Fixture) {
    let store = &fixture.store;
    let id = fixture.submit().await;
    let lease = fixture.claim("a").await;
    store.keep(lease, &results_and_state(3)).await.unwrap();
    store.keep(lease, &results(8)).await.unwrap();
    store.reclaim_own("a").await.unwrap();

    let lease = fixture.claim("a").await;
    let resume_point = store.state(id).await.unwrap().unwrap().resume_point;
    assert!(
        store
            .begin(lease, &AttemptStart::At(resume_point), 2)
            .await
            .unwrap()
    );
    let latest = store.snapshot(id, None).await.unwrap().unwrap();
    assert_eq!(latest.time_s, 3.0, "what came after is gone");
    let attempts = fixture.job(id).await.attempts;
    assert_eq!(attempts[0].resumed_from_s, None);
    assert_eq!(attempts[1].resumed_from_s, Some(3.0));

    assert!(store.begin(lease, &AttemptStart::Afresh, 2).await.unwrap());
    assert_eq!(store.snapshot(id, None).await.unwrap(), None);
    assert_eq!(store.last_chunk(id, 0).await.unwrap(), None);
    assert_eq!(store.state(id).await.unwrap(), None);
    assert_eq!(fixture.job(id).await.summary.progress.fraction, 0.0);
}

async fn a_job_handed_back_keeps_its_state_and_has_no_failed_attempt(fixture: &Fixture) {
    let id = fixture.submit().await;
    for _ in 0..=TOLERATED_SETBACKS {
        let lease = fixture.claim("a").await;
        assert!(fixture.store.release(lease).await.unwrap());
        let progress = fixture.job(id).await.summary.progress;
        assert_eq!(progress, Progress::default());
    }
    let lease = fixture.claim("a").await;
    fixture
        .store
        .keep(lease, &results_and_state(3))
        .await
        .unwrap();
    fixture.store.release(lease).await.unwrap();
    assert!(fixture.store.state(id).await.unwrap().is_some());
    let job = fixture.job(id).await;
    assert_eq!(job.summary.status, JobStatus::Accepted);
    assert_eq!(job.summary.started, None);
    assert_eq!(job.summary.progress.fraction, 0.5, "it goes on from there");
}
