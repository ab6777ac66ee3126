//! The queue alone, with members that take no time: claims and ends by many workers at once, while
//! the tables grow.

use super::cluster::Server;
use crate::{at_length, tell};
use scree::jobs::clock::SystemClock;
use scree::jobs::job::JobId;
use scree::jobs::store::postgres::{Part, PostgresStore};
use scree::jobs::store::{
    AttemptStart, Claimant, JobStore, Lease, NewChunk, NewResults, Pack, Renewal, Room, Solver,
    Submission, TerrainStore,
};
use scree::jobs::submit::{Means, NewJob, validate};
use scree::results::chunk::Block;
use scree::runs::Progress;
use scree::terrains::ScenarioReader;
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use tokio::runtime::Runtime;

const FINGERPRINT: &str = "0123456789abcdef0123456789abcdef0123456789abcdef0123456789abcdef";

/// Jobs claimed and ended for one measurement.
const MEASURED: usize = 1_300;

/// Measurements of which the best counts: other work on the machine only slows them down.
const ROUNDS: usize = 3;

const PACK: Pack = Pack {
    jobs: 32,
    work: u64::MAX >> 1,
};

fn claimant(owner: &str, pack: Pack) -> Claimant {
    Claimant {
        owner: owner.to_owned(),
        lease_duration: Duration::from_secs(30),
        solver: Solver {
            version: "1",
            commit: "c",
            instructions: "none",
        },
        up_for: Duration::from_secs(60),
        pack,
        memory_bytes: u64::MAX >> 1,
    }
}

async fn open(url: &str, part: Part, connections: u32) -> Arc<PostgresStore> {
    let clock = Arc::new(SystemClock::default());
    Arc::new(
        PostgresStore::open(url, part, connections, clock)
            .await
            .expect("a database"),
    )
}

/// A job of the size that members of studies have.
async fn member(store: &Arc<PostgresStore>) -> NewJob {
    let means = Means {
        threads_per_worker: 1,
        point_steps: None,
        memory_bytes: u64::MAX,
    };
    let scenario = crate::served::scene(1.0).to_string();
    let reader = ScenarioReader::new(Arc::clone(store) as Arc<dyn TerrainStore>);
    let checked = move || validate(&scenario, (&means, &reader), Vec::new());
    let member = tokio::task::spawn_blocking(checked).await;
    member.expect("it ends").expect("a valid scenario")
}

async fn submit(store: &PostgresStore, member: &NewJob, count: usize) {
    let room = Room {
        queue: u32::MAX,
        submitter: None,
    };
    for first in (0..count).step_by(1_000) {
        let jobs: Vec<_> = (first..count.min(first + 1_000))
            .map(|_| NewJob {
                id: JobId::new(),
                ..member.clone()
            })
            .collect();
        let submission = Submission {
            jobs: &jobs,
            submitter: None,
            key: None,
            room,
        };
        JobStore::submit(store, &submission).await.expect("room");
    }
}

/// Claims and ends jobs with all workers at once until so many have ended; returns jobs per second.
async fn drain(workers: &[Arc<PostgresStore>], pack: Pack, count: usize) -> f64 {
    let left = Arc::new(AtomicUsize::new(count));
    let began = Instant::now();
    let tasks = workers.iter().enumerate().map(|(number, store)| {
        let (store, left) = (Arc::clone(store), Arc::clone(&left));
        let claimant = claimant(&format!("worker {number}"), pack);
        tokio::spawn(async move {
            while left.load(Ordering::Relaxed) > 0 {
                let claims = JobStore::claim(&*store, &claimant).await.expect("a claim");
                if claims.is_empty() {
                    return;
                }
                for claim in &claims {
                    let ended = JobStore::succeed(&*store, claim.lease, "{}", FINGERPRINT);
                    assert!(ended.await.expect("an end"));
                }
                let done = claims.len();
                let subtract = |left: usize| Some(left.saturating_sub(done));
                let _ = left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, subtract);
            }
        })
    });
    for task in tasks.collect::<Vec<_>>() {
        task.await.expect("a worker");
    }
    count as f64 / began.elapsed().as_secs_f64()
}

/// Rows from 1e3 to 1e6 (to 1e4 in the short form): the rate of claims and ends must not depend on
/// them.
#[test]
#[ignore = "needs PostgreSQL; .ci/run runs it"]
fn claims_do_not_slow_down_as_rows_become_many() {
    let _turn = crate::turn();
    let runtime = Runtime::new().expect("a runtime");
    let server = Server::start();
    let largest = at_length(10_000, 1_000_000);
    runtime.block_on(async {
        let service = open(&server.url, Part::Service, 8).await;
        let mut workers = Vec::new();
        for _ in 0..16 {
            workers.push(open(&server.url, Part::Worker, 1).await);
        }
        let member = member(&service).await;
        // One to copy.
        submit(&service, &member, 1).await;
        let (mut rows, mut rates) = (1, Vec::new());
        let mut target = 1_000;
        while target <= largest {
            // Half of the rows have ended, and half wait. The server has time to settle, as it has
            // where rows come one by one.
            fill(&server.url, target.saturating_sub(rows));
            psql(&server.url, "CHECKPOINT");
            psql(&server.url, "VACUUM ANALYZE");
            let before = figures(&server.url);
            let mut best = [0.0_f64; 3];
            for _ in 0..ROUNDS {
                let began = Instant::now();
                submit(&service, &member, 2 * MEASURED).await;
                let submitted = 2.0 * MEASURED as f64 / began.elapsed().as_secs_f64();
                let single = drain(&workers, Pack::SINGLE, MEASURED).await;
                let packed = drain(&workers, PACK, MEASURED).await;
                for (best, now) in best.iter_mut().zip([submitted, single, packed]) {
                    *best = best.max(now);
                }
            }
            rows = target + 2 * ROUNDS * MEASURED;
            let [submitted, single, packed] = best;
            rates.push(single);
            tell(&format!(
                "{target} rows: submitted {submitted:.0} a second; 16 workers claim and end \
                 {single:.0} a second one by one, {packed:.0} in packs of 32; {before}"
            ));
            target *= 10;
        }
        let (least, most) = rates
            .iter()
            .fold((f64::MAX, 0.0_f64), |(least, most), rate| {
                (least.min(*rate), most.max(*rate))
            });
        tell(&format!("slowest over fastest: {:.2}", least / most));
        // The short form runs beside other work.
        let bar = [0.5, 0.7][at_length(0, 1)];
        assert!(least / most >= bar, "{rates:?}");
    });
}

/// A worker alone takes members of a second, in packs of two, from the claim to the end: the time that
/// it waits for the database.
#[test]
#[ignore = "needs PostgreSQL; .ci/run runs it"]
fn the_queue_takes_less_than_a_hundredth_of_members_of_a_second() {
    let _turn = crate::turn();
    let runtime = Runtime::new().expect("a runtime");
    let server = Server::start();
    let jobs = at_length(100, 1_000);
    let per_job_s = runtime.block_on(async {
        let service = open(&server.url, Part::Service, 8).await;
        submit(&service, &member(&service).await, jobs).await;
        let worker = open(&server.url, Part::Worker, 2).await;
        let pack = Pack {
            jobs: 2,
            work: u64::MAX >> 1,
        };
        let began = Instant::now();
        for _ in 0..jobs / 2 {
            let claims = JobStore::claim(&*worker, &claimant("alone", pack)).await;
            for claim in claims.expect("a claim") {
                run(&worker, claim.lease).await;
            }
        }
        began.elapsed().as_secs_f64() / jobs as f64
    });
    tell(&format!(
        "a member's claim (half a pack of two), begin, heartbeat, two writes of records and end: \
         {:.2} ms",
        1e3 * per_job_s
    ));
    assert!(per_job_s < 0.01, "{per_job_s} s");
}

/// All that a worker asks of the database for a job that takes a second.
async fn run(store: &PostgresStore, lease: Lease) {
    let begun = JobStore::begin(store, lease, &AttemptStart::Afresh, 1);
    assert!(begun.await.expect("a beginning"));
    let progress = Progress::default();
    let renewed = JobStore::renew(store, lease, Duration::from_secs(30), &progress);
    assert_eq!(renewed.await.expect("a renewal"), Renewal::Held);
    for samples in [100, 200] {
        let results = NewResults {
            chunks: vec![NewChunk {
                body: 0,
                first_sample: 0,
                samples,
                first_time_s: 0.0,
                last_time_s: 1.0,
                block: Block::seal_quickly(&vec![7; 85 * samples]).expect("a block"),
            }],
            ..NewResults::default()
        };
        assert!(JobStore::keep(store, lease, &results).await.expect("kept"));
    }
    let ended = JobStore::succeed(store, lease, "{}", FINGERPRINT);
    assert!(ended.await.expect("an end"));
}

/// Adds rows like those of submitted jobs, and ends half of them as workers do.
fn fill(url: &str, rows: usize) {
    let statements = format!(
        "INSERT INTO jobs (id, priority, planned_work, planned_memory_bytes, created_ms,
                           created_operating_ms, scenario, title, bodies, scenario_hash, plan,
                           solver_version)
         SELECT gen_random_uuid(), priority, planned_work, planned_memory_bytes, created_ms,
                created_operating_ms, scenario, title, bodies, scenario_hash, plan, solver_version
         FROM (SELECT * FROM jobs LIMIT 1) AS one, generate_series(1, {rows});
         UPDATE jobs SET status = 'running', started_ms = 1, attempt = 1, lease_token = 1,
                lease_owner = 'x', lease_expires_operating_ms = 1
         WHERE status = 'accepted' AND sequence % 2 = 0;
         INSERT INTO attempts (job_id, attempt, owner, started_ms)
         SELECT id, 1, 'x', 1 FROM jobs WHERE status = 'running';
         UPDATE jobs SET status = 'successful', finished_ms = 2, ended_operating_ms = 2,
                outcome = '{{}}', fingerprint = repeat('0', 64),
                lease_owner = NULL, lease_expires_operating_ms = NULL
         WHERE status = 'running';"
    );
    psql(url, &statements);
}

/// Sizes of tables and indexes, as the server tells them.
fn figures(url: &str) -> String {
    psql(
        url,
        "SELECT 'tables ' || pg_size_pretty(sum(pg_table_size(oid))::bigint)
             || ', indexes ' || pg_size_pretty(sum(pg_indexes_size(oid))::bigint)
         FROM pg_class WHERE relname IN ('jobs', 'events', 'attempts')",
    )
}

fn psql(url: &str, statements: &str) -> String {
    let answer = Command::new("psql")
        .args([
            url,
            "--quiet",
            "--tuples-only",
            "--no-align",
            "--set=ON_ERROR_STOP=1",
        ])
        .args(["--command", statements])
        .stderr(Stdio::inherit())
        .output()
        .expect("psql, which comes with the server");
    assert!(answer.status.success());
    String::from_utf8_lossy(&answer.stdout).trim().to_owned()
}
