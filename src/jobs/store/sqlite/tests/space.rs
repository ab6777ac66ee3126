//! Space of removed jobs.

use super::*;
use crate::jobs::store::NewChunk;
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
