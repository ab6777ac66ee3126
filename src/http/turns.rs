//! Turns: how many reading requests of one caller are answered at a time. The others of that caller
//! wait for each other, and not those of other callers for them.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::{OwnedSemaphorePermit, Semaphore};

/// Reading requests of one caller that are answered at a time: as many as the connections that
/// read the database, less one for the others.
const AT_A_TIME: usize = 3;

/// The turns of all callers.
#[derive(Debug, Clone, Default)]
pub(super) struct Turns(Arc<Mutex<BTreeMap<String, Arc<Semaphore>>>>);

/// A turn of a caller, until this is dropped.
#[derive(Debug)]
pub(super) struct Turn {
    turns: Turns,
    caller: String,
    permit: Option<OwnedSemaphorePermit>,
}

impl Turns {
    /// Waits for a turn of this caller.
    pub(super) async fn take(&self, caller: &str) -> Turn {
        let semaphore = {
            let mut callers = self.callers();
            let semaphore = callers.entry(caller.to_owned());
            semaphore
                .or_insert_with(|| Arc::new(Semaphore::new(AT_A_TIME)))
                .clone()
        };
        // None is ever closed.
        let permit = semaphore.acquire_owned().await.ok();
        Turn {
            turns: self.clone(),
            caller: caller.to_owned(),
            permit,
        }
    }

    fn callers(&self) -> MutexGuard<'_, BTreeMap<String, Arc<Semaphore>>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        drop(self.permit.take());
        let mut callers = self.turns.callers();
        // Whoever waits or has a turn holds it, too.
        if let Some(semaphore) = callers.get(&self.caller)
            && Arc::strong_count(semaphore) == 1
        {
            callers.remove(&self.caller);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;
    use tokio::time::timeout;

    #[tokio::test]
    async fn a_caller_waits_for_its_own_turns_and_for_no_others() {
        let turns = Turns::default();
        let mut taken = Vec::new();
        for _ in 0..AT_A_TIME {
            taken.push(turns.take("a").await);
        }
        let short = Duration::from_millis(20);
        assert!(timeout(short, turns.take("a")).await.is_err());
        drop(
            timeout(short, turns.take("b"))
                .await
                .expect("a turn of its own"),
        );
        taken.pop();
        taken.push(timeout(short, turns.take("a")).await.expect("one is free"));
        taken.clear();
        assert!(turns.callers().is_empty());
    }
}
