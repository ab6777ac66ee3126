//! Admission pool: the threads on which scenarios are read, checked and planned. Reading one may
//! take half a second, planning one many seconds, and the threads that answer requests must be
//! free for others meanwhile.

use super::fair_queue::FairQueue;
use crate::config::Admission;
use scree_solver::Cancellation;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use thiserror::Error;
use tokio::time::{Instant, timeout_at};

/// The admission pool of a service.
#[derive(Debug, Clone)]
pub struct AdmissionPool {
    threads: FairQueue,
    /// The one thread of timings, which would slow each other.
    timings: FairQueue,
    guests: Arc<Mutex<BTreeMap<String, usize>>>,
    limits: Admission,
}

/// Reason why a request is not admitted.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum AdmissionError {
    /// Too many requests wait.
    #[error(
        "{requests} requests are being read or wait for it, as many as admission.requests of this service allows"
    )]
    Full {
        /// Number of requests in the pool.
        requests: usize,
    },
    /// Too many requests of this caller wait.
    #[error(
        "{requests} requests of this caller are being read or wait for it, half of admission.requests of this service"
    )]
    ShareSpent {
        /// Number of the caller's requests in the pool.
        requests: usize,
    },
    /// The work, or the wait for it, took too long.
    #[error("the request was not read within {limit_s} s (admission.time_limit_s of this service)")]
    TimedOut {
        /// The limit [s].
        limit_s: u64,
    },
    /// The work panicked.
    #[error("the work broke off: {0}")]
    BrokenOff(String),
}

/// A request's place in the pool. Once it is dropped, because its client has left or its time is
/// over, work that is being done for it is cancelled.
#[derive(Debug)]
pub struct Admitted {
    pool: AdmissionPool,
    caller: String,
    end: Instant,
    cancellation: Cancellation,
}

impl AdmissionPool {
    /// A pool on a machine with this many cores.
    pub fn new(limits: &Admission, cores: usize) -> Self {
        Self {
            threads: FairQueue::new(limits.threads(cores)),
            timings: FairQueue::new(1),
            guests: Arc::default(),
            limits: limits.clone(),
        }
    }

    /// Takes a place for a request of this caller.
    ///
    /// # Errors
    /// The pool is full, or the caller has its share of it.
    pub fn enter(&self, caller: &str) -> Result<Admitted, AdmissionError> {
        let mut guests = self.guests();
        let requests: usize = guests.values().sum();
        if requests >= self.limits.requests {
            return Err(AdmissionError::Full { requests });
        }
        let own = guests.get(caller).copied().unwrap_or_default();
        if own >= self.limits.requests_per_caller() {
            return Err(AdmissionError::ShareSpent { requests: own });
        }
        guests.insert(caller.to_owned(), own + 1);
        Ok(Admitted {
            pool: self.clone(),
            caller: caller.to_owned(),
            end: Instant::now() + self.limits.time_limit(),
            cancellation: Cancellation::default(),
        })
    }

    fn guests(&self) -> MutexGuard<'_, BTreeMap<String, usize>> {
        self.guests.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Admitted {
    /// Does a piece of work on a thread of the pool, when the caller's turn has come. Long work
    /// looks for the cancellation, or comes in slices, between which others have their turns.
    ///
    /// # Errors
    /// The time is over, or the work panicked.
    pub async fn work<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Cancellation) -> T + Send + 'static,
    ) -> Result<T, AdmissionError> {
        self.work_on(&self.pool.threads, work).await
    }

    /// Does a piece of work whose wall time matters: nothing else is timed meanwhile.
    ///
    /// # Errors
    /// The time is over, or the work panicked.
    pub async fn time<T: Send + 'static>(
        &self,
        work: impl FnOnce(&Cancellation) -> T + Send + 'static,
    ) -> Result<T, AdmissionError> {
        self.work_on(&self.pool.timings, work).await
    }

    async fn work_on<T: Send + 'static>(
        &self,
        threads: &FairQueue,
        work: impl FnOnce(&Cancellation) -> T + Send + 'static,
    ) -> Result<T, AdmissionError> {
        let turn = timeout_at(self.end, threads.turn(&self.caller)).await;
        let turn = turn.map_err(|_| self.timed_out())?;
        let cancellation = self.cancellation.clone();
        let done = tokio::task::spawn_blocking(move || {
            let result = work(&cancellation);
            // Held by the work: a client that leaves frees the thread once the work has ended.
            drop(turn);
            result
        });
        match timeout_at(self.end, done).await {
            Ok(Ok(result)) => Ok(result),
            Ok(Err(error)) => Err(AdmissionError::BrokenOff(error.to_string())),
            Err(_) => Err(self.timed_out()),
        }
    }

    fn timed_out(&self) -> AdmissionError {
        let limit_s = self.pool.limits.time_limit().as_secs();
        AdmissionError::TimedOut { limit_s }
    }
}

impl Drop for Admitted {
    fn drop(&mut self) {
        self.cancellation.ask();
        let mut guests = self.pool.guests();
        if let Some(requests) = guests.get_mut(&self.caller) {
            *requests -= 1;
            if *requests == 0 {
                guests.remove(&self.caller);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;
    use std::time::Duration;

    fn pool(requests: usize, time_limit_s: f64) -> AdmissionPool {
        let limits = Admission {
            threads: Some(1),
            requests,
            time_limit_s,
        };
        AdmissionPool::new(&limits, 1)
    }

    #[test]
    fn one_caller_has_half_of_the_pool_and_all_of_them_the_whole() {
        let pool = pool(4, 1.0);
        let a: Vec<_> = (0..2).map(|_| pool.enter("a").unwrap()).collect();
        let refused = pool.enter("a").unwrap_err();
        assert_eq!(refused, AdmissionError::ShareSpent { requests: 2 });
        let _b: Vec<_> = (0..2).map(|_| pool.enter("b").unwrap()).collect();
        let refused = pool.enter("c").unwrap_err();
        assert_eq!(refused, AdmissionError::Full { requests: 4 });
        drop(a);
        assert!(pool.enter("c").is_ok());
        assert_eq!(pool.guests().len(), 1, "a caller who left is forgotten");
    }

    #[tokio::test]
    async fn work_for_a_request_that_is_over_is_cancelled() {
        let pool = pool(2, 1.0);
        let place = pool.enter("a").unwrap();
        let (told, ended) = mpsc::channel();
        let until_cancelled = move |cancellation: &Cancellation| {
            while !cancellation.is_asked() {
                std::thread::sleep(Duration::from_millis(1));
            }
            told.send(()).unwrap();
        };
        let refused = place.work(until_cancelled).await.unwrap_err();
        assert!(matches!(refused, AdmissionError::TimedOut { .. }));
        drop(place);
        ended.recv_timeout(Duration::from_secs(10)).unwrap();
        let place = pool.enter("a").unwrap();
        assert_eq!(place.work(|_| 7).await, Ok(7), "the thread is free again");
        let broken = place.work(|_| panic!("no")).await.unwrap_err();
        assert!(matches!(broken, AdmissionError::BrokenOff(_)));
    }
}
