//! Driver for PostgreSQL: one database for services and workers on many machines. All that knows
//! its SQL, connections and migrations is in this folder; each operation of the port is in the file
//! of its subject, and [`JobStore`] says what it must do.
//!
//! Transactions run at the same time and lock rows: each that changes a job begins with a statement
//! that names the job's lease or locks its row, so that whoever comes second sees what the first
//! did. What counts rows takes a [`Turn`]. Every commit reaches the disk of the server before it is
//! acknowledged (`synchronous_commit`). Other processes are told of news by NOTIFY.
//!
//! A running job is one with a lease, which the table checks. Statements for one job ask for the
//! lease, which no index has, and not for the state: of those that run the server believes at times
//! that there are none, and would look through all that have run since it counted.
//!
//! [`JobStore`]: super::JobStore

mod ending;
mod error;
mod events;
mod flow_maps;
mod health;
mod history;
mod keyed_requests;
mod leader;
mod lease;
mod locks;
mod news;
mod operating_time;
mod pages;
mod port;
mod queue;
mod read;
mod removal;
mod results;
mod schema;
mod states;
mod studies;
mod study_members;
mod submission;
mod terrains;
#[cfg(test)]
pub(super) mod tests;
mod webhooks;

use super::StoreError;
use crate::jobs::clock::Clock;
use error::{Answer, PostgresError};
use leader::Leader;
use locks::Turn;
use news::{News, Subject};
use operating_time::OperatingTime;
use sqlx::postgres::{PgConnectOptions, PgPoolOptions};
use sqlx::{ConnectOptions, Connection, PgPool, Postgres, Transaction};
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

/// Time after which a connection that was not used is tried before it is used.
const TRIED_AFTER: Duration = Duration::from_secs(2);

/// Time to wait for a connection.
const CONNECTION_PATIENCE: Duration = Duration::from_secs(5);

/// Time after which a connection that is not used is closed: a worker whose jobs take long holds
/// none for nothing.
const IDLE: Duration = Duration::from_secs(30);

/// Settings of every session. The statements are made for this isolation, in which one that waited
/// for a row sees what the other did. A client that is cut off in a transaction must not keep its rows
/// locked until the server's own keepalives notice, which takes hours.
const SESSION: [(&str, &str); 6] = [
    ("default_transaction_isolation", "read committed"),
    ("idle_in_transaction_session_timeout", "20s"),
    ("tcp_keepalives_idle", "10"),
    ("tcp_keepalives_interval", "5"),
    ("tcp_keepalives_count", "3"),
    ("tcp_user_timeout", "30s"),
];

/// Part of a process that opens a database.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A service: it brings the schema to its version.
    Service,
    /// A worker: it needs the schema of its version.
    Worker,
}

impl Part {
    /// Subjects that it is told of: a worker follows no events.
    fn subjects(self) -> &'static [Subject] {
        match self {
            Self::Service => &Subject::ALL,
            Self::Worker => &[Subject::Queue],
        }
    }
}

/// One moment, by both clocks.
#[derive(Debug, Clone, Copy)]
struct Now {
    /// Time of day, to be shown [ms].
    wall_ms: i64,
    /// Operating time, by which durations are measured [ms].
    operating_ms: i64,
}

/// A database that services and workers share.
pub struct PostgresStore {
    pool: PgPool,
    clock: Arc<dyn Clock>,
    operating_time: OperatingTime,
    news: News,
    leader: Leader,
}

impl std::fmt::Debug for PostgresStore {
    /// Without the options of the connections, which may hold a password.
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter
            .debug_struct("PostgresStore")
            .finish_non_exhaustive()
    }
}

impl PostgresStore {
    /// Opens the database of this URL with at most so many connections, besides one that listens
    /// and, for a service, one that leads.
    ///
    /// # Errors
    /// The URL is none, the server can't be reached, or the schema is of another version and can't
    /// be changed.
    pub async fn open(
        url: &str,
        part: Part,
        connections: u32,
        clock: Arc<dyn Clock>,
    ) -> Result<Self, StoreError> {
        let options = PgConnectOptions::from_str(url).map_err(PostgresError::from)?;
        let options = options
            .application_name("scree")
            .options(SESSION)
            .disable_statement_logging();
        let pool = pool(connections).connect_with(options.clone());
        let pool = pool.await.map_err(PostgresError::from)?;
        match part {
            Part::Service => schema::migrate(&pool).await?,
            Part::Worker => schema::check(&pool).await?,
        }
        let operating_time = OperatingTime::resume(&pool, Arc::clone(&clock)).await?;
        Ok(Self {
            news: News::start(&pool, options.clone(), part.subjects()),
            leader: Leader::new(options),
            pool,
            clock,
            operating_time,
        })
    }

    /// Closes the database.
    pub(super) async fn close(&self) {
        if !self.pool.is_closed()
            && let Err(error) = self
                .operating_time
                .note(&self.pool)
                .await
                .map_err(StoreError::from)
        {
            tracing::warn!(%error, "the end of operation can't be noted");
        }
        self.leader.close().await;
        self.news.close();
        self.pool.close().await;
    }

    /// The moment of a transaction that is about to begin.
    async fn now(&self) -> Answer<Now> {
        self.operating_time.compare(&self.pool).await?;
        Ok(Now {
            wall_ms: self.clock.now().as_millisecond(),
            operating_ms: self.operating_time.now_ms(),
        })
    }

    async fn begin(&self) -> Answer<Transaction<'static, Postgres>> {
        Ok(self.pool.begin().await?)
    }

    /// A transaction that has its turn.
    async fn begin_in_turn(&self, turn: Turn) -> Answer<Transaction<'static, Postgres>> {
        let mut transaction = self.begin().await?;
        turn.take(&mut transaction).await?;
        Ok(transaction)
    }
}

fn pool(connections: u32) -> PgPoolOptions {
    PgPoolOptions::new()
        .max_connections(connections)
        .acquire_timeout(CONNECTION_PATIENCE)
        .idle_timeout(IDLE)
        .max_lifetime(None)
        .test_before_acquire(false)
        // One that was used just now is most likely there: a query would cost as much as the
        // question whether it is.
        .before_acquire(|connection, before| {
            let try_it = before.idle_for > TRIED_AFTER;
            Box::pin(async move {
                if try_it {
                    connection.ping().await?;
                }
                Ok(true)
            })
        })
}
