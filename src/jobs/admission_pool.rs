//! Admission pool: the threads on which scenarios are read, checked and planned. Reading one may
//! take half a second, planning one many seconds, and the threads that answer requests must be
//! free for others meanwhile.

use super::fair_queue::FairQueue;
use crate::config::Admission;
use crate::quota::{InUse, Quota, UsedUp};
use scree_solver::Cancellation;
use std::time::Duration;
use thiserror::Error;
use tokio::time::{Instant, timeout_at};

/// The admission pool of a service.
#[derive(Debug, Clone)]
pub struct AdmissionPool {
    threads: FairQueue,
    /// The one thread of timings, which would slow each other.
    timings: FairQueue,
    /// The one thread of rasters, which take much memory.
    rasters: FairQueue,
    requests: Quota,
    time_limit: Duration,
}

/// Reason why a request is not admitted.
#[derive(Debug, Clone, PartialEq, Error)]
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
        limit_s: f64,
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
    place: InUse,
    end: Instant,
    cancellation: Cancellation,
}

impl AdmissionPool {
    /// A pool on a machine with this many cores.
    pub fn new(limits: &Admission, cores: usize) -> Self {
        Self {
            threads: FairQueue::new(limits.threads(cores)),
            timings: FairQueue::new(1),
            rasters: FairQueue::new(1),
            requests: Quota::new(limits.requests, limits.requests_per_caller()),
            time_limit: limits.time_limit(),
        }
    }

    /// Takes a place for a request of this caller.
    ///
    /// # Errors
    /// The pool is full, or the caller has its share of it.
    pub fn enter(&self, caller: &str) -> Result<Admitted, AdmissionError> {
        let place = self
            .requests
            .enter(caller)
            .map_err(|used_up| match used_up {
                UsedUp::ByAll(requests) => AdmissionError::Full { requests },
                UsedUp::ByCaller(requests) => AdmissionError::ShareSpent { requests },
            })?;
        Ok(Admitted {
            pool: self.clone(),
            place,
            end: Instant::now() + self.time_limit,
            cancellation: Cancellation::default(),
        })
    }

    /// Does a slice of the work of an answer that goes on as long as its client reads: on a thread
    /// of the pool when the caller's turn has come, without a place and a time limit.
    ///
    /// # Errors
    /// The work panicked.
    pub(super) async fn slice<T: Send + 'static>(
        &self,
        caller: &str,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, AdmissionError> {
        let turn = self.threads.turn(caller).await;
        let done = tokio::task::spawn_blocking(move || {
            let result = work();
            drop(turn);
            result
        });
        done.await
            .map_err(|error| AdmissionError::BrokenOff(error.to_string()))
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

    /// Reads the file of a raster: no other is read meanwhile, so that only one takes memory.
    ///
    /// # Errors
    /// The time is over, or the work panicked.
    pub async fn read_raster<T: Send + 'static>(
        &self,
        work: impl FnOnce() -> T + Send + 'static,
    ) -> Result<T, AdmissionError> {
        self.work_on(&self.pool.rasters, |_| work()).await
    }

    async fn work_on<T: Send + 'static>(
        &self,
        threads: &FairQueue,
        work: impl FnOnce(&Cancellation) -> T + Send + 'static,
    ) -> Result<T, AdmissionError> {
        let turn = timeout_at(self.end, threads.turn(self.place.caller())).await;
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
        let limit_s = self.pool.time_limit.as_secs_f64();
        AdmissionError::TimedOut { limit_s }
    }
}

impl Drop for Admitted {
    fn drop(&mut self) {
        self.cancellation.ask();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc;

    fn pool(requests: usize, time_limit_s: f64) -> AdmissionPool {
        let limits = Admission {
            threads: Some(1),
            requests,
            time_limit_s,
        };
        AdmissionPool::new(&limits, 1)
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
