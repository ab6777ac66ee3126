//! A worker that is cut off from the database for longer than its lease, with its writes on the way:
//! when they arrive, they are refused.

use super::{Part, PostgresStore, open, url};
use crate::jobs::failure::Failure;
use crate::jobs::store::tests::{FINGERPRINT, Fixture, LEASE, claimant, results_and_state};
use crate::jobs::store::{AttemptStart, JobStore, Lease};
use std::sync::Arc;
use std::time::Duration;
use tokio::io::{AsyncReadExt, AsyncWriteExt};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::watch;
use tokio::task::JoinHandle;
use tokio::time::sleep;

/// Number of times that the worker is cut off.
const RACES: u32 = 200;

/// A network between a worker and its database that can stand still.
struct Network {
    port: u16,
    open: watch::Sender<bool>,
}

impl Network {
    /// In front of the server at this address.
    async fn to(server: String) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").await.unwrap();
        let port = listener.local_addr().unwrap().port();
        let (open, is_open) = watch::channel(true);
        tokio::spawn(async move {
            while let Ok((client, _)) = listener.accept().await {
                let server = TcpStream::connect(&server).await.unwrap();
                let (from_client, to_client) = client.into_split();
                let (from_server, to_server) = server.into_split();
                tokio::spawn(carry(from_client, to_server, is_open.clone()));
                tokio::spawn(carry(from_server, to_client, is_open.clone()));
            }
        });
        Self { port, open }
    }
}

async fn carry(
    mut from: impl AsyncReadExt + Unpin,
    mut to: impl AsyncWriteExt + Unpin,
    mut is_open: watch::Receiver<bool>,
) {
    let mut bytes = vec![0; 1 << 16];
    while let Ok(count @ 1..) = from.read(&mut bytes).await {
        if is_open.wait_for(|open| *open).await.is_err()
            || to.write_all(&bytes[..count]).await.is_err()
        {
            return;
        }
    }
}

/// Any kind of write of a worker; true if it was accepted.
async fn write(store: &PostgresStore, lease: Lease, race: u32) -> bool {
    match race % 5 {
        0 => JobStore::keep(store, lease, &results_and_state(9)).await,
        1 => JobStore::succeed(store, lease, "{\"by\":\"cut off\"}", FINGERPRINT).await,
        2 => JobStore::fail(store, lease, &Failure::internal("cut off")).await,
        3 => JobStore::release(store, lease).await,
        _ => JobStore::begin(store, lease, &AttemptStart::Afresh, 1).await,
    }
    .unwrap()
}

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
#[ignore = "needs a PostgreSQL server, TEST_POSTGRES_URL"]
async fn a_worker_that_was_cut_off_writes_nothing_stale() {
    let fixture = Fixture::new(open).await;
    let url = url(fixture.directory.path()).await;
    let (login, rest) = url.rsplit_once('@').unwrap();
    let (server, name) = rest.split_once('/').unwrap();
    let network = Network::to(server.to_owned()).await;
    let through = format!("{login}@127.0.0.1:{}/{name}", network.port);
    let clock = fixture.clock.clone();
    let cut_off = PostgresStore::open(&through, Part::Worker, 2, clock).await;
    let cut_off = Arc::new(cut_off.unwrap());
    let mut stale = 0;
    for race in 0..RACES {
        let id = fixture.submit().await;
        let lease = JobStore::claim(&*cut_off, &claimant("cut off"))
            .await
            .unwrap()[0]
            .lease;
        assert_eq!(lease.job, id);

        network.open.send_replace(false);
        let store = Arc::clone(&cut_off);
        let writing: JoinHandle<bool> =
            tokio::spawn(async move { write(&store, lease, race).await });
        // The write is on its way; at times the other worker has not ended when it arrives.
        sleep(Duration::from_millis(1)).await;
        fixture.pass(LEASE);
        assert_eq!(fixture.store.reclaim_expired("b").await.unwrap(), 1);
        fixture.pass(Duration::from_secs(10));
        let fresh = fixture.claim("b").await;
        assert_eq!(fresh.job, id);
        let results = results_and_state(5);
        assert!(fixture.store.keep(fresh, &results).await.unwrap());
        if race % 2 == 0 {
            network.open.send_replace(true);
        }
        assert!(fixture.succeed(fresh).await);
        network.open.send_replace(true);
        stale += u32::from(writing.await.unwrap());

        assert_eq!(fixture.job(id).await.outcome.unwrap().get(), "{}");
        assert_eq!(fixture.endings(id).await, ["expired", "successful"]);
        let snapshot = fixture.store.snapshot(id, None).await.unwrap().unwrap();
        assert_eq!(snapshot.time_s, 5.0);
    }
    assert_eq!(stale, 0, "of {RACES} races");
}
