//! A worker that is cut off from the database for longer than its lease, with its writes on the way:
//! when they arrive, they are refused.

use super::{Part, PostgresStore, open, url};
use crate::jobs::failure::Failure;
use crate::jobs::store::tests::{FINGERPRINT, Fixture, LEASE, claimant, results_and_state};
use crate::jobs::store::{AttemptStart, JobStore, Lease};
use std::io::{Read, Write};
use std::net::{Shutdown, TcpListener, TcpStream};
use std::sync::{Arc, Condvar, Mutex};
use std::time::Duration;
use tokio::task::JoinHandle;
use tokio::time::sleep;

/// Number of times that the worker is cut off.
const RACES: u32 = 200;

/// A network between a worker and its database that can stand still.
struct Network {
    port: u16,
    gate: Arc<Gate>,
}

#[derive(Default)]
struct Gate {
    is_shut: Mutex<bool>,
    changed: Condvar,
}

impl Network {
    /// In front of the server at this address.
    fn to(server: String) -> Self {
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let port = listener.local_addr().unwrap().port();
        let gate = Arc::<Gate>::default();
        let shared = Arc::clone(&gate);
        // Its threads end with the process of the tests.
        std::thread::spawn(move || {
            while let Ok((client, _)) = listener.accept() {
                let server = TcpStream::connect(&server).unwrap();
                let ends = [(&client, &server), (&server, &client)];
                for (from, to) in ends {
                    let (from, to) = (from.try_clone().unwrap(), to.try_clone().unwrap());
                    let gate = Arc::clone(&shared);
                    std::thread::spawn(move || carry(from, to, &gate));
                }
            }
        });
        Self { port, gate }
    }

    fn shut(&self, is_shut: bool) {
        *self.gate.is_shut.lock().unwrap() = is_shut;
        self.gate.changed.notify_all();
    }
}

fn carry(mut from: TcpStream, mut to: TcpStream, gate: &Gate) {
    let mut bytes = vec![0; 1 << 16];
    while let Ok(count @ 1..) = from.read(&mut bytes) {
        let is_shut = gate.is_shut.lock().unwrap();
        drop(
            gate.changed
                .wait_while(is_shut, |is_shut| *is_shut)
                .unwrap(),
        );
        if to.write_all(&bytes[..count]).is_err() {
            break;
        }
    }
    let _ = to.shutdown(Shutdown::Both);
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
    let network = Network::to(server.to_owned());
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

        network.shut(true);
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
            network.shut(false);
        }
        assert!(fixture.succeed(fresh).await);
        network.shut(false);
        stale += u32::from(writing.await.unwrap());

        assert_eq!(fixture.job(id).await.outcome.unwrap().get(), "{}");
        assert_eq!(fixture.endings(id).await, ["expired", "successful"]);
        let snapshot = fixture.store.snapshot(id, None).await.unwrap().unwrap();
        assert_eq!(snapshot.time_s, 5.0);
    }
    assert_eq!(stale, 0, "of {RACES} races");
}
