//! News between processes, by LISTEN and NOTIFY.
//!
//! A message says no more than that there is something new. It is sent after the transaction, not
//! in it: the server lets transactions with messages end one by one, so that claims would wait for
//! each other. One that gets lost is made up for by those who wait, who look from time to time.

use sqlx::PgPool;
use sqlx::postgres::{PgConnectOptions, PgListener};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use tokio::sync::{Mutex, Notify, watch};
use tokio::task::JoinHandle;
use tokio::time::{sleep, timeout};

/// Least time between two messages of a process.
const MESSAGE_PAUSE: Duration = Duration::from_millis(20);

/// Longest time until those who wait look without having heard anything.
const LOOK_PAUSE: Duration = Duration::from_secs(2);

/// Time before a lost session is replaced.
const RETRY_PAUSE: Duration = Duration::from_secs(1);

/// Subject of news.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Subject {
    /// Jobs have come into the queue.
    Queue,
    /// Jobs have changed.
    Events,
}

impl Subject {
    pub(super) const ALL: [Self; 2] = [Self::Queue, Self::Events];

    fn channel(self) -> &'static str {
        match self {
            Self::Queue => "scree_queue",
            Self::Events => "scree_events",
        }
    }
}

/// News of one process: those it tells, and those it hears.
pub(super) struct News {
    heard: Arc<Heard>,
    /// News seen by those who wait.
    seen: [Mutex<watch::Receiver<u64>>; 2],
    outbox: Arc<Outbox>,
    tasks: [JoinHandle<()>; 2],
}

/// Numbers of news heard so far.
struct Heard([watch::Sender<u64>; 2]);

/// News to be told.
#[derive(Default)]
struct Outbox {
    wanted: [AtomicBool; 2],
    filled: Notify,
}

impl News {
    /// `subjects` are those that others tell this process of.
    pub(super) fn start(
        pool: &PgPool,
        options: PgConnectOptions,
        subjects: &'static [Subject],
    ) -> Self {
        let heard = Arc::new(Heard([watch::Sender::new(0), watch::Sender::new(0)]));
        let outbox = Arc::new(Outbox::default());
        let tasks = [
            tokio::spawn(listen(options, subjects, Arc::clone(&heard))),
            tokio::spawn(tell(pool.clone(), Arc::clone(&outbox))),
        ];
        Self {
            seen: Subject::ALL.map(|subject| Mutex::new(heard.0[subject as usize].subscribe())),
            heard,
            outbox,
            tasks,
        }
    }

    /// Tells all processes, this one at once.
    pub(super) fn tell(&self, subjects: &[Subject]) {
        for &subject in subjects {
            self.heard.note(subject);
            self.outbox.wanted[subject as usize].store(true, Ordering::Relaxed);
        }
        self.outbox.filled.notify_one();
    }

    /// Waits for news that came after the last wait for this subject ended, but no longer than
    /// [`LOOK_PAUSE`].
    pub(super) async fn wait(&self, subject: Subject) {
        let mut seen = self.seen[subject as usize].lock().await;
        // Its sender is as old as the receiver: the wait does not fail.
        drop(timeout(LOOK_PAUSE, seen.changed()).await);
    }

    pub(super) fn close(&self) {
        self.tasks.iter().for_each(JoinHandle::abort);
    }
}

impl Drop for News {
    fn drop(&mut self) {
        self.close();
    }
}

impl Heard {
    fn note(&self, subject: Subject) {
        self.0[subject as usize].send_modify(|count| *count += 1);
    }

    fn note_all(&self) {
        Subject::ALL
            .into_iter()
            .for_each(|subject| self.note(subject));
    }
}

/// Listens as long as the process runs; a lost session is replaced.
async fn listen(options: PgConnectOptions, subjects: &[Subject], heard: Arc<Heard>) {
    loop {
        if let Err(error) = listen_once(&options, subjects, &heard).await {
            tracing::debug!(%error, "no news can be heard now");
        }
        sleep(RETRY_PAUSE).await;
        // What was told meanwhile is missed.
        heard.note_all();
    }
}

async fn listen_once(
    options: &PgConnectOptions,
    subjects: &[Subject],
    heard: &Heard,
) -> Result<(), sqlx::Error> {
    let pool = sqlx::postgres::PgPoolOptions::new()
        .max_connections(1)
        .idle_timeout(None)
        .max_lifetime(None)
        .connect_lazy_with(options.clone());
    let mut listener = PgListener::connect_with(&pool).await?;
    listener
        .listen_all(subjects.iter().map(|subject| subject.channel()))
        .await?;
    heard.note_all();
    // `None`: the session was lost.
    while let Some(message) = listener.try_recv().await? {
        let is_told = |subject: &Subject| subject.channel() == message.channel();
        if let Some(subject) = Subject::ALL.into_iter().find(is_told) {
            heard.note(subject);
        }
    }
    Ok(())
}

/// Sends messages as long as the process runs.
async fn tell(pool: PgPool, outbox: Arc<Outbox>) {
    loop {
        outbox.filled.notified().await;
        for subject in Subject::ALL {
            if !outbox.wanted[subject as usize].swap(false, Ordering::Relaxed) {
                continue;
            }
            if let Err(error) = send(&pool, subject).await {
                tracing::debug!(%error, "news can't be told now");
            }
        }
        sleep(MESSAGE_PAUSE).await;
    }
}

/// One message, which need not reach the disk.
async fn send(pool: &PgPool, subject: Subject) -> Result<(), sqlx::Error> {
    let statements = match subject {
        Subject::Queue => "SET LOCAL synchronous_commit = off; NOTIFY scree_queue",
        Subject::Events => "SET LOCAL synchronous_commit = off; NOTIFY scree_events",
    };
    sqlx::raw_sql(statements).execute(pool).await?;
    Ok(())
}
