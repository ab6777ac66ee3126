//! The job store against a model of it: random histories of a few jobs under two
//! services, with late workers, clocks that jump, and crashes.

use super::*;
use crate::jobs::failure::Failure;
use crate::jobs::store::claim::LOST_CLAIM_MS;
use proptest::prelude::*;
use proptest::test_runner::TestRunner;
use std::collections::BTreeMap;
use tokio::runtime::Handle;
use tokio::task::block_in_place;

conformance! {
    whatever_happens_the_store_does_what_its_model_does
}

const OWNERS: [&str; 2] = ["a", "b"];

/// One event. `usize`s select a job, or one of all leases ever given.
#[derive(Debug, Clone)]
enum Event {
    Submit,
    Claim(usize),
    Renew(usize),
    Save(usize),
    Succeed(usize),
    Fail(usize),
    HandBack(usize),
    AttemptFailed(usize),
    Dismiss(usize),
    Crash(usize),
    TakeBackExpired(usize),
    /// The time of day is set, by so many milliseconds.
    Jump(i64),
    /// So many milliseconds pass.
    Pass(u64),
}

fn event() -> impl Strategy<Value = Event> {
    prop_oneof![
        3 => Just(Event::Submit),
        6 => (0..2usize).prop_map(Event::Claim),
        2 => any::<usize>().prop_map(Event::Renew),
        2 => any::<usize>().prop_map(Event::Save),
        2 => any::<usize>().prop_map(Event::Succeed),
        1 => any::<usize>().prop_map(Event::Fail),
        2 => any::<usize>().prop_map(Event::HandBack),
        2 => any::<usize>().prop_map(Event::AttemptFailed),
        1 => any::<usize>().prop_map(Event::Dismiss),
        2 => (0..2usize).prop_map(Event::Crash),
        2 => (0..2usize).prop_map(Event::TakeBackExpired),
        2 => any::<i32>().prop_map(|seconds| Event::Jump(i64::from(seconds) * 100)),
        4 => prop_oneof![0..20_000u64, 20_000..90_000u64].prop_map(Event::Pass),
    ]
}

/// State of a job as predicted without the database.
#[derive(Debug, Clone, Default, PartialEq)]
struct ModelJob {
    status: Option<JobStatus>,
    attempt: u32,
    /// Index of its lease among all leases, while it runs or was dismissed.
    holder: Option<usize>,
    owner: usize,
    expires_ms: i64,
    not_before_ms: i64,
    failed_attempts: u32,
    saved: bool,
    /// True if the current attempt has saved a state.
    saved_now: bool,
}

#[derive(Debug, Default)]
struct Model {
    /// Operating time.
    now_ms: i64,
    jobs: BTreeMap<usize, ModelJob>,
}

const LEASE_MS: i64 = 30_000;

/// Cause of a failed attempt.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Why {
    CutOff,
    Expired,
    Infrastructure,
}

impl Model {
    fn is(job: &ModelJob, status: JobStatus) -> bool {
        job.status == Some(status)
    }

    /// The job for which a lease is valid.
    fn held(&mut self, lease: usize) -> Option<&mut ModelJob> {
        self.jobs.values_mut().find(|job| job.holder == Some(lease))
    }

    fn running(&mut self, lease: usize) -> Option<&mut ModelJob> {
        self.held(lease)
            .filter(|job| Self::is(job, JobStatus::Running))
    }

    fn claimable(&mut self) -> Option<(usize, &mut ModelJob)> {
        let now = self.now_ms;
        let free = |job: &ModelJob| job.not_before_ms <= now;
        let mut jobs = self.jobs.iter_mut().map(|(place, job)| (*place, job));
        jobs.find(|(_, job)| Self::is(job, JobStatus::Accepted) && free(job))
    }

    fn end(job: &mut ModelJob, status: JobStatus) {
        job.status = Some(status);
        job.saved = false;
        if status != JobStatus::Dismissed {
            job.holder = None;
        }
    }

    fn penetration_correction(job: &mut ModelJob, not_before_ms: i64) {
        job.status = Some(JobStatus::Accepted);
        job.holder = None;
        job.not_before_ms = not_before_ms;
    }

    fn fail_attempt(job: &mut ModelJob, now_ms: i64, why: Why) -> Returned {
        if why != Why::Infrastructure && job.saved_now {
            Self::penetration_correction(job, now_ms);
            return Returned::Waiting;
        }
        let wait_ms = match (why, job.failed_attempts) {
            (Why::CutOff, _) => 0,
            (_, 0) => 2_000,
            (_, _) => 8_000,
        };
        job.failed_attempts += 1;
        if job.failed_attempts == 3 {
            Self::end(job, JobStatus::Failed);
            return Returned::Failed;
        }
        Self::penetration_correction(job, now_ms + wait_ms);
        Returned::Waiting
    }

    /// Reclaims every running job for which `lost` is true; returns their number.
    fn reclaim_expired(&mut self, why: Why, lost: impl Fn(&ModelJob, i64) -> bool) -> usize {
        let now = self.now_ms;
        let mut count = 0;
        for job in self.jobs.values_mut() {
            if Self::is(job, JobStatus::Running) && lost(job, now) {
                Self::fail_attempt(job, now, why);
                count += 1;
            }
        }
        count
    }
}

/// The store and its model, and all leases ever given.
struct Pair {
    fixture: Fixture,
    model: Model,
    ids: Vec<JobId>,
    leases: Vec<Lease>,
}

impl Pair {
    async fn happen(&mut self, event: &Event) {
        match *event {
            Event::Submit => {
                let job = ModelJob {
                    status: Some(JobStatus::Accepted),
                    ..ModelJob::default()
                };
                self.model.jobs.insert(self.ids.len(), job);
                self.ids.push(self.fixture.submit().await);
            }
            Event::Claim(owner) => self.claim(owner).await,
            Event::Dismiss(pick) if !self.ids.is_empty() => self.dismiss(pick).await,
            Event::Crash(owner) => {
                let expected = self
                    .model
                    .reclaim_expired(Why::CutOff, |job, _| job.owner == owner);
                let taken = self.fixture.store.reclaim_own(OWNERS[owner]).await;
                assert_eq!(taken.unwrap(), expected);
            }
            Event::TakeBackExpired(owner) => {
                let expected = self.model.reclaim_expired(Why::Expired, |job, now| {
                    let own = if job.owner == owner { LOST_CLAIM_MS } else { 0 };
                    job.expires_ms + own <= now
                });
                let store = &self.fixture.store;
                let taken = store.reclaim_expired(OWNERS[owner]).await;
                assert_eq!(taken.unwrap(), expected);
            }
            Event::Jump(by_ms) => {
                // No rule is about the time of day.
                self.fixture.clock.jump(SignedDuration::from_millis(by_ms));
            }
            Event::Pass(time_ms) => {
                self.fixture.pass(Duration::from_millis(time_ms));
                self.model.now_ms += time_ms.cast_signed();
            }
            _ if !self.leases.is_empty() => self.write(event).await,
            _ => {}
        }
    }

    async fn claim(&mut self, owner: usize) {
        let lease = self.fixture.try_claim(OWNERS[owner]).await;
        let number = self.leases.len();
        let expires_ms = self.model.now_ms + LEASE_MS;
        let Some((place, job)) = self.model.claimable() else {
            assert_eq!(lease, None);
            return;
        };
        let lease = lease.expect("the model has a job to claim");
        job.status = Some(JobStatus::Running);
        job.attempt += 1;
        job.holder = Some(number);
        job.owner = owner;
        job.expires_ms = expires_ms;
        job.saved_now = false;
        assert_eq!((lease.job, lease.attempt), (self.ids[place], job.attempt));
        self.leases.push(lease);
    }

    async fn dismiss(&mut self, pick: usize) {
        let place = pick % self.ids.len();
        let job = self.model.jobs.get_mut(&place).expect("it was submitted");
        let expected = match job.status {
            Some(status @ (JobStatus::Successful | JobStatus::Failed)) => Dismissal::Ended(status),
            _ => {
                Model::end(job, JobStatus::Dismissed);
                Dismissal::Dismissed
            }
        };
        let dismissal = self.fixture.store.dismiss(self.ids[place]).await;
        assert_eq!(dismissal.unwrap(), expected);
    }

    /// A write under some lease, valid or stale.
    async fn write(&mut self, event: &Event) {
        let store = &self.fixture.store;
        let model = &mut self.model;
        let now = model.now_ms;
        let number = |pick: usize| pick % self.leases.len();
        match *event {
            Event::Renew(pick) => {
                let expected = match model.held(number(pick)) {
                    None => Renewal::Lost,
                    Some(job) if Model::is(job, JobStatus::Dismissed) => Renewal::Dismissed,
                    Some(job) => {
                        job.expires_ms = now + LEASE_MS;
                        Renewal::Held
                    }
                };
                let lease = self.leases[number(pick)];
                let renewed = store.renew(lease, LEASE, &Progress::default()).await;
                assert_eq!(renewed.unwrap(), expected);
            }
            Event::Save(pick) => {
                let held = model.held(number(pick));
                let expected = held.is_some();
                if let Some(job) = held.filter(|job| Model::is(job, JobStatus::Running)) {
                    job.saved = true;
                    job.saved_now = true;
                    job.failed_attempts = 0;
                }
                let lease = self.leases[number(pick)];
                let kept = store.keep(lease, &results_and_state(3)).await;
                assert_eq!(kept.unwrap(), expected);
            }
            Event::AttemptFailed(pick) => {
                let expected = match model.running(number(pick)) {
                    Some(job) => Model::fail_attempt(job, now, Why::Infrastructure),
                    None => Returned::Lost,
                };
                let failed_attempt = FailedAttempt::Infrastructure("x".to_owned());
                let lease = self.leases[number(pick)];
                assert_eq!(
                    store.fail_attempt(lease, &failed_attempt).await.unwrap(),
                    expected
                );
            }
            Event::Succeed(pick) | Event::Fail(pick) | Event::HandBack(pick) => {
                let lease = self.leases[number(pick)];
                let running = model.running(number(pick));
                let expected = running.is_some();
                let done = match (event, running) {
                    (Event::Succeed(_), job) => {
                        job.into_iter()
                            .for_each(|job| Model::end(job, JobStatus::Successful));
                        store.succeed(lease, "{}", FINGERPRINT).await
                    }
                    (Event::Fail(_), job) => {
                        job.into_iter()
                            .for_each(|job| Model::end(job, JobStatus::Failed));
                        store.fail(lease, &Failure::internal("x")).await
                    }
                    (_, job) => {
                        job.into_iter()
                            .for_each(|job| Model::penetration_correction(job, 0));
                        store.release(lease).await
                    }
                };
                assert_eq!(done.unwrap(), expected, "{event:?}");
            }
            _ => {}
        }
    }

    async fn agree(&self) {
        for (place, expected) in &self.model.jobs {
            let id = self.ids[*place];
            let job = self.fixture.job(id).await;
            assert_eq!(Some(job.summary.status), expected.status, "job {place}");
            assert_eq!(job.attempt, expected.attempt, "job {place}");
            let state = self.fixture.store.state(id).await.unwrap();
            assert_eq!(state.is_some(), expected.saved, "job {place}");
            let endings = self.fixture.endings(id).await;
            assert_eq!(endings.len(), expected.attempt as usize, "job {place}");
            let running = endings.iter().filter(|ending| ending.is_empty()).count();
            let expected_running = usize::from(Model::is(expected, JobStatus::Running));
            assert_eq!(running, expected_running, "job {place}: {endings:?}");
        }
    }
}

/// Plays the events on an empty store and on an empty model.
async fn play(fixture: Fixture, events: &[Event]) {
    let mut pair = Pair {
        fixture,
        model: Model::default(),
        ids: Vec::new(),
        leases: Vec::new(),
    };
    for event in events {
        pair.happen(event).await;
    }
    pair.agree().await;
}

async fn whatever_happens_the_store_does_what_its_model_does(fixture: &Fixture) {
    let mut runner = TestRunner::new(ProptestConfig {
        cases: 48,
        failure_persistence: None,
        ..ProptestConfig::default()
    });
    let histories = prop::collection::vec(event(), 1..60);
    let played = block_in_place(|| {
        runner.run(&histories, |events| {
            let played = async { play(fixture.another().await, &events).await };
            Handle::current().block_on(played);
            Ok(())
        })
    });
    played.unwrap();
}
