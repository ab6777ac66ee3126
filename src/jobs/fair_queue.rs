//! A queue for a few places in which everyone gets a turn: within a caller's requests the first
//! comes first, and callers take turns, so that many requests of one delay another's by no more
//! than one of theirs.

use std::collections::VecDeque;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::oneshot;

/// Queue for a number of places.
#[derive(Debug, Clone)]
pub(super) struct FairQueue(Arc<Mutex<State>>);

#[derive(Debug)]
struct State {
    free: usize,
    /// Those who wait, caller by caller, the next one first.
    waiting: VecDeque<(String, VecDeque<oneshot::Sender<Turn>>)>,
}

/// A place that is taken until this is dropped; then the next who waits gets it.
#[derive(Debug)]
pub(super) struct Turn(FairQueue);

impl FairQueue {
    /// A queue for this number of places.
    pub(super) fn new(places: usize) -> Self {
        Self(Arc::new(Mutex::new(State {
            free: places,
            waiting: VecDeque::new(),
        })))
    }

    /// Waits for a place in the name of a caller.
    pub(super) async fn turn(&self, caller: &str) -> Turn {
        let receiver = {
            let mut state = self.state();
            if state.free > 0 {
                state.free -= 1;
                return Turn(self.clone());
            }
            state.enqueue(caller)
        };
        match receiver.await {
            Ok(turn) => turn,
            // Senders are only dropped with the queue, of which `self` is a part.
            Err(_) => unreachable!("a queue outlives those who wait in it"),
        }
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl State {
    fn enqueue(&mut self, caller: &str) -> oneshot::Receiver<Turn> {
        let (sender, receiver) = oneshot::channel();
        match self.waiting.iter_mut().find(|(name, _)| name == caller) {
            Some((_, requests)) => requests.push_back(sender),
            None => {
                let requests = VecDeque::from([sender]);
                self.waiting.push_back((caller.to_owned(), requests));
            }
        }
        receiver
    }

    /// The request whose turn is next; its caller goes to the end of the queue.
    fn next(&mut self) -> Option<oneshot::Sender<Turn>> {
        let (caller, mut requests) = self.waiting.pop_front()?;
        let next = requests.pop_front();
        if !requests.is_empty() {
            self.waiting.push_back((caller, requests));
        }
        next
    }
}

impl Drop for Turn {
    fn drop(&mut self) {
        let next = {
            let mut state = self.0.state();
            let next = state.next();
            if next.is_none() {
                state.free += 1;
            }
            next
        };
        if let Some(next) = next {
            // One who has left meanwhile drops the turn, which passes it on.
            drop(next.send(Turn(self.0.clone())));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn callers_take_turns_and_those_who_left_are_passed_over() {
        let queue = FairQueue::new(1);
        let first = queue.turn("a").await;
        let served = Arc::new(Mutex::new(Vec::new()));
        let mut tasks = Vec::new();
        for (caller, request) in [("a", 1), ("a", 2), ("a", 3), ("b", 1), ("c", 1), ("b", 2)] {
            let (queue, served) = (queue.clone(), Arc::clone(&served));
            tasks.push(tokio::spawn(async move {
                let _turn = queue.turn(caller).await;
                served.lock().unwrap().push(format!("{caller}{request}"));
                // Others may come in between.
                tokio::task::yield_now().await;
            }));
            tokio::task::yield_now().await;
        }
        tasks.remove(4).abort();
        tokio::task::yield_now().await;
        drop(first);
        for task in tasks {
            task.await.unwrap();
        }
        let served = served.lock().unwrap().join(" ");
        assert_eq!(served, "a1 b1 a2 b2 a3");
        assert_eq!(queue.state().free, 1);
        assert!(queue.state().waiting.is_empty());
    }
}
