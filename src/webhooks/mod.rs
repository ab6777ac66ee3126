//! Webhooks: tells receivers, which the operator names, of changes of jobs, in order and at least
//! once each (Standard Webhooks, version 1).

mod message;
mod post;

use crate::config::Webhook;
use crate::jobs::store::{Change, Event, JobStore, StoreError};
use crate::jobs::{JobService, News};
use message::Message;
use std::sync::Arc;
use std::time::Duration;
use tokio::sync::broadcast::Receiver;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::watch;
use tokio::task::JoinHandle;
use tokio::time::{Instant, sleep};
use tracing::{info, warn};

/// Pauses before a message is sent again; the last one is repeated.
const PAUSES_S: [u64; 6] = [1, 4, 16, 60, 300, 900];
/// Time after which a message that nobody takes is given up.
const GIVEN_UP_AFTER: Duration = Duration::from_secs(24 * 3600);

/// Starts to tell the receivers, each by a task of its own that ends with the service.
pub(crate) fn start(
    webhooks: &[Webhook],
    store: &Arc<dyn JobStore>,
    jobs: &JobService,
    stopped: &watch::Receiver<bool>,
) -> Vec<JoinHandle<()>> {
    let tasks = webhooks.iter().map(|webhook| {
        let teller = Teller {
            webhook: webhook.clone(),
            store: Arc::clone(store),
            news: jobs.news(),
            stopped: stopped.clone(),
        };
        tokio::spawn(teller.tell())
    });
    tasks.collect()
}

/// Tells one receiver.
struct Teller {
    webhook: Webhook,
    store: Arc<dyn JobStore>,
    news: Receiver<News>,
    stopped: watch::Receiver<bool>,
}

/// Fate of a message.
#[derive(PartialEq)]
enum Sent {
    Taken,
    GivenUp,
    /// The service stops; it is sent after the next start.
    Stopping,
    /// Another service leads by now; it sends it.
    NotByThis,
}

/// True if this service, of those that share a database, tells.
struct Leads(bool);

impl Teller {
    async fn tell(mut self) {
        let mut stopped = self.stopped.clone();
        loop {
            let told = self.all_there_is().await;
            if let Err(error) = &told {
                warn!(name = self.webhook.name, %error, "a webhook's place can't be read or noted now");
            }
            let pause = async {
                // One that does not lead is told by nobody when it does.
                if !matches!(told, Ok(Leads(true))) {
                    sleep(Duration::from_secs(PAUSES_S[0])).await;
                } else if matches!(
                    self.news.recv().await,
                    Ok(News::Closing) | Err(RecvError::Closed)
                ) {
                    std::future::pending::<()>().await;
                }
            };
            tokio::select! {
                () = pause => {}
                _ = stopped.wait_for(|stopped| *stopped) => return,
            }
        }
    }

    /// Tells all events after the last that was taken; a new receiver is told from now on.
    /// Of several services one tells.
    async fn all_there_is(&self) -> Result<Leads, StoreError> {
        if !self.store.leads().await? {
            return Ok(Leads(false));
        }
        let last = self.store.last_event().await?;
        let noted = self.store.webhook_position(&self.webhook.name).await?;
        // A number that no event has had is from before the database was restored.
        let mut position = noted.filter(|noted| *noted <= last).unwrap_or(last);
        if noted != Some(position) {
            self.note(position).await?;
        }
        loop {
            let events = self.store.events(position, None).await?;
            let Some(newest) = events.last().map(|event| event.sequence) else {
                return Ok(Leads(true));
            };
            for event in events.iter().filter(|event| self.is_told(event)) {
                match self.send(event).await? {
                    Sent::Stopping => return Ok(Leads(true)),
                    Sent::NotByThis => return Ok(Leads(false)),
                    Sent::Taken | Sent::GivenUp => {}
                }
                self.note(event.sequence).await?;
            }
            self.note(newest).await?;
            position = newest;
        }
    }

    fn is_told(&self, event: &Event) -> bool {
        matches!(event.change, Change::Status(status) if self.webhook.states.contains(&status))
    }

    async fn note(&self, position: i64) -> Result<(), StoreError> {
        let name = &self.webhook.name;
        self.store.note_webhook_position(name, position).await
    }

    /// Sends the message of an event until it is taken.
    async fn send(&self, event: &Event) -> Result<Sent, StoreError> {
        let name = &self.webhook.name;
        let Some(message) = Message::of(event) else {
            return Ok(Sent::Taken);
        };
        let mut stopped = self.stopped.clone();
        let began = Instant::now();
        for attempt in 0.. {
            if !self.store.leads().await? {
                return Ok(Sent::NotByThis);
            }
            match post::post(&self.webhook, &message).await {
                Ok(()) => return Ok(Sent::Taken),
                Err(error) if began.elapsed() >= GIVEN_UP_AFTER => {
                    warn!(name, id = %event.job, %error, "a webhook's message is given up");
                    return Ok(Sent::GivenUp);
                }
                Err(error) => {
                    info!(name, id = %event.job, %error, "a webhook's message is sent again later");
                }
            }
            let pause = PAUSES_S[PAUSES_S.len().min(attempt + 1) - 1];
            tokio::select! {
                () = sleep(Duration::from_secs(pause)) => {}
                _ = stopped.wait_for(|stopped| *stopped) => return Ok(Sent::Stopping),
            }
        }
        Ok(Sent::GivenUp)
    }
}
