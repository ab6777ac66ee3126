//! Answers to the operator's questions: all who ask at about the same time share one, so that a flood
//! of questions costs the database no more than a few.

use std::sync::Arc;
use std::time::Duration;
use tokio::sync::Mutex;
use tokio::time::Instant;

/// Age up to which an answer is given again.
const AGE: Duration = Duration::from_millis(200);

/// The last answer to a question.
#[derive(Debug)]
pub(super) struct Recent<T>(Mutex<Option<(Instant, Arc<T>)>>);

impl<T> Default for Recent<T> {
    fn default() -> Self {
        Self(Mutex::new(None))
    }
}

impl<T> Recent<T> {
    /// The answer, found anew if the last one is too old. Who asks meanwhile waits for it.
    pub(super) async fn get(&self, find: impl Future<Output = T>) -> Arc<T> {
        let mut last = self.0.lock().await;
        if let Some((found, answer)) = &*last
            && found.elapsed() < AGE
        {
            return Arc::clone(answer);
        }
        let answer = Arc::new(find.await);
        *last = Some((Instant::now(), Arc::clone(&answer)));
        answer
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU32, Ordering};

    #[tokio::test]
    async fn who_asks_at_the_same_time_gets_the_same_answer() {
        let (recent, count) = (Recent::default(), AtomicU32::new(0));
        let ask = || {
            recent.get(async {
                tokio::time::sleep(Duration::from_millis(10)).await;
                count.fetch_add(1, Ordering::Relaxed)
            })
        };
        let (a, b, c) = tokio::join!(ask(), ask(), ask());
        assert_eq!([*a, *b, *c], [0; 3]);
        tokio::time::sleep(AGE).await;
        assert_eq!(*ask().await, 1);
    }
}
