//! The service that leads, of those that share a database: it drives studies and tells webhooks,
//! which two would only do twice. It leads as long as its session with the server lasts, which
//! holds a lock.

use super::error::Answer;
use super::locks::LEADER;
use sqlx::postgres::{PgConnectOptions, PgConnection};
use sqlx::{ConnectOptions, Connection};
use tokio::sync::Mutex;

/// Candidate of one process.
pub(super) struct Leader {
    options: PgConnectOptions,
    session: Mutex<Option<Session>>,
}

struct Session {
    connection: PgConnection,
    leads: bool,
}

impl Leader {
    pub(super) fn new(options: PgConnectOptions) -> Self {
        Self {
            options,
            session: Mutex::default(),
        }
    }

    /// True if this process leads, which it may from now on.
    pub(super) async fn leads(&self) -> Answer<bool> {
        let mut held = self.session.lock().await;
        // A session with an error is not put back: it ends, and with it the lock.
        let mut session = match held.take() {
            Some(session) => session,
            None => Session {
                connection: self.options.connect().await?,
                leads: false,
            },
        };
        if session.leads {
            session.connection.ping().await?;
        } else {
            session.leads = sqlx::query_scalar("SELECT pg_try_advisory_lock($1)")
                .bind(LEADER)
                .fetch_one(&mut session.connection)
                .await?;
        }
        let leads = session.leads;
        *held = Some(session);
        Ok(leads)
    }

    pub(super) async fn close(&self) {
        if let Some(session) = self.session.lock().await.take()
            && let Err(error) = session.connection.close().await
        {
            tracing::debug!(%error, "the session of the leader is not closed in order");
        }
    }
}
