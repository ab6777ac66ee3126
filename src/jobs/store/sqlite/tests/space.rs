//! Space of removed jobs.

use super::*;
use crate::jobs::job::JobId;
use crate::jobs::store::tests::{claimant, new_job, submission};
use crate::jobs::store::{NewChunk, Removal, Submitted};
use crate::results::chunk::Block;
use std::fs;

/// Results of about 2 MiB that do not compress.
fn large_results() -> NewResults {
    let chunk = |first_sample: usize| {
        let mut data = vec![0; 256 << 10];
        blake3::Hasher::new().finalize_xof().fill(&mut data);
        NewChunk {
            body: 0,
            first_sample,
            samples: 1,
            first_time_s: first_sample as f64,
            last_time_s: first_sample as f64,
            block: Block {
                checksum: *blake3::hash(&data).as_bytes(),
                data,
            },
        }
    };
    NewResults {
        chunks: (0..8).map(chunk).collect(),
        ..results(1)
    }
}

#[tokio::test]
async fn a_file_shrinks_once_its_jobs_are_removed() {
    let fixture = Fixture::new(open).await;
    let bytes = || {
        let path = fixture.directory.path().join("test.db");
        fs::metadata(path).unwrap().len()
    };
    let mut ended = Vec::new();
    for _ in 0..20 {
        ended.push(fixture.submit().await);
        let lease = fixture.claim("a").await;
        assert!(fixture.store.keep(lease, &large_results()).await.unwrap());
        assert!(fixture.succeed(lease).await);
    }
    let kept = ended.pop().unwrap();
    for id in ended {
        fixture.store.remove(id).await.unwrap();
    }
    let full = bytes();
    assert!(full > 30 << 20, "{full}");
    for _ in 0..100 {
        fixture.store.maintain().await.unwrap();
    }
    let left = bytes();
    assert!(left < 8 << 20, "{left} of {full}");
    let chunk = fixture.store.samples(kept, 0).await.unwrap();
    assert_eq!(chunk, 8);
}

#[tokio::test]
async fn in_a_full_database_jobs_are_still_dismissed_ended_and_removed() {
    let directory = TempDir::new().unwrap();
    let path = directory.path().join("test.db");
    let clock = Arc::new(SystemClock::default());
    let store = SqliteStore::open_with(&path, Some(1 << 20), clock).await;
    let store = store.unwrap();
    let mut job = new_job();
    job.scenario = "x".repeat(50_000);
    let mut ids = Vec::new();
    let refused = loop {
        job.id = JobId::new();
        let jobs = [job.clone()];
        match JobStore::submit(&store, &submission(&jobs)).await {
            Ok(_) => ids.push(job.id),
            Err(error) => break error,
        }
    };
    assert_eq!(refused.kind(), StoreErrorKind::Full, "{refused}");
    assert!((10..25).contains(&ids.len()), "{}", ids.len());
    let claim = JobStore::claim(&store, &claimant("a")).await.unwrap();
    let lease = claim[0].lease;
    let kept = JobStore::keep(&store, lease, &large_results()).await;
    assert_eq!(kept.unwrap_err().kind(), StoreErrorKind::Full);
    let failure = Failure::internal("x");
    assert!(JobStore::fail(&store, lease, &failure).await.unwrap());
    for id in &ids {
        JobStore::dismiss(&store, *id).await.unwrap();
        let removed = JobStore::remove(&store, *id).await.unwrap();
        assert_eq!(removed, Removal::Removed);
    }
    job.id = JobId::new();
    let jobs = [job];
    let submitted = JobStore::submit(&store, &submission(&jobs)).await.unwrap();
    assert_eq!(submitted, Submitted::Accepted);
    JobStore::close(&store).await;
}
