//! News of jobs: one task reads the events of the database and tells all who follow, who would
//! otherwise each ask the database all the time.

use super::store::{EVENTS_AT_ONCE, Event, JobStore, StoreError};
use std::sync::Arc;
use tokio::sync::{broadcast, watch};
use tokio::task::JoinHandle;
use tracing::warn;

/// Pieces of news that a follower may be behind; one that is further behind asks the database.
const BACKLOG: usize = 256;

/// Number of events after which a piece of news is told, although there are more.
const EVENTS_OF_NEWS: usize = 1_000;

/// A piece of news.
#[derive(Debug, Clone)]
pub enum News {
    /// Events, in order.
    Events(Arc<[Event]>),
    /// The service is stopping: no more news follows.
    Closing,
}

/// Those who follow the jobs of a service.
#[derive(Debug, Clone)]
pub struct Followers(broadcast::Sender<News>);

impl Followers {
    /// Starts the task that tells the news until the service is stopped.
    pub fn start(
        store: Arc<dyn JobStore>,
        stopped: watch::Receiver<bool>,
    ) -> (Self, JoinHandle<()>) {
        let (sender, _) = broadcast::channel(BACKLOG);
        let followers = Self(sender.clone());
        let task = tokio::spawn(async move { tell(&*store, stopped, &sender).await });
        (followers, task)
    }

    /// News from now on: of all events that are stored after this returns.
    pub(super) fn join(&self) -> broadcast::Receiver<News> {
        self.0.subscribe()
    }
}

async fn tell(
    store: &dyn JobStore,
    mut stopped: watch::Receiver<bool>,
    sender: &broadcast::Sender<News>,
) {
    let mut last = None;
    while !*stopped.borrow() {
        match next(store, &mut last).await {
            Ok(events) if events.is_empty() => {}
            Ok(events) => {
                let are_more = events.len() >= EVENTS_OF_NEWS;
                // Without a follower nobody misses it.
                drop(sender.send(News::Events(events.into())));
                if are_more {
                    continue;
                }
            }
            Err(error) => warn!(%error, "events can't be read now"),
        }
        tokio::select! {
            () = store.wait_for_events() => {}
            _ = stopped.wait_for(|stopped| *stopped) => {}
        }
    }
    drop(sender.send(News::Closing));
}

/// The next events after the last ones: all, or so many that there may be more.
async fn next(store: &dyn JobStore, last: &mut Option<i64>) -> Result<Vec<Event>, StoreError> {
    let mut after = match *last {
        Some(last) => last,
        None => store.last_event().await?,
    };
    let mut events = Vec::new();
    loop {
        let page = store.events(after, None).await?;
        let Some(newest) = page.last() else { break };
        after = newest.sequence;
        let is_last = page.len() < EVENTS_AT_ONCE as usize;
        events.extend(page);
        // What comes meanwhile comes with the next news: events that never end must not keep these.
        if is_last || events.len() >= EVENTS_OF_NEWS {
            break;
        }
    }
    *last = Some(after);
    Ok(events)
}
