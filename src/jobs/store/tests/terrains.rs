//! Rules for every driver that keeps terrains, one per test.

use super::studies::new_study;
use super::*;
use crate::jobs::store::terrains::PIECE_BYTES;
use crate::studies::study::{StudyId, StudyStatus};
use crate::terrains::TerrainHash;

conformance! {
    a_terrain_is_kept_once_and_its_file_comes_back_in_pieces
    terrains_are_listed_newest_first
    a_terrain_that_a_job_names_stays_until_the_job_is_removed
    a_terrain_that_a_study_names_stays_until_the_study_is_removed
    nothing_is_kept_that_names_no_terrain
    a_job_and_the_removal_of_its_terrain_do_not_both_succeed
}

impl Fixture {
    async fn put(&self, file: &[u8]) -> TerrainHash {
        let terrain = new_terrain(file);
        assert!(self.store.put_terrain(&terrain).await.unwrap());
        terrain.hash
    }

    async fn file(&self, hash: TerrainHash) -> Vec<Vec<u8>> {
        let mut pieces = Vec::new();
        for piece in 0.. {
            match self.store.terrain_piece(hash, piece).await.unwrap() {
                Some(data) => pieces.push(data),
                None => break,
            }
        }
        pieces
    }

    async fn remove(&self, hash: TerrainHash) -> TerrainRemoval {
        self.store.remove_terrain(hash).await.unwrap()
    }
}

fn new_terrain(file: &[u8]) -> NewTerrain<'_> {
    NewTerrain {
        hash: TerrainHash::of(file),
        file,
        description: "{}",
        submitter: Some("a"),
    }
}

fn job_on(terrains: &[TerrainHash]) -> NewJob {
    NewJob {
        terrains: terrains.to_vec(),
        ..new_job()
    }
}

fn in_use(jobs: u64, studies: u64) -> TerrainRemoval {
    TerrainRemoval::InUse { jobs, studies }
}

async fn a_terrain_is_kept_once_and_its_file_comes_back_in_pieces(fixture: &Fixture) {
    let file: Vec<u8> = (0..PIECE_BYTES + 3).map(|place| place as u8).collect();
    let hash = fixture.put(&file).await;
    let again = NewTerrain {
        submitter: Some("b"),
        ..new_terrain(&file)
    };
    fixture.pass(Duration::from_secs(5));
    assert!(!fixture.store.put_terrain(&again).await.unwrap());
    let stored = fixture.store.terrain(hash).await.unwrap().unwrap();
    assert_eq!((stored.hash, stored.bytes), (hash, file.len() as u64));
    assert_eq!(stored.submitter.as_deref(), Some("a"), "the first");
    assert_eq!(stored.created.as_second(), 1_700_000_000);
    let pieces = fixture.file(hash).await;
    assert_eq!(pieces.len(), 2);
    assert!(pieces.concat() == file);

    assert_eq!(fixture.remove(hash).await, TerrainRemoval::Removed);
    assert_eq!(fixture.remove(hash).await, TerrainRemoval::Unknown);
    assert_eq!(fixture.store.terrain(hash).await.unwrap(), None);
    assert!(fixture.file(hash).await.is_empty());
}

async fn terrains_are_listed_newest_first(fixture: &Fixture) {
    let mut hashes = Vec::new();
    for file in [b"a", b"b", b"c"] {
        hashes.push(fixture.put(file).await);
    }
    let page = |before| TerrainPage { before, limit: 2 };
    let first = fixture.store.terrains(&page(None)).await.unwrap();
    let names =
        |terrains: &[StoredTerrain]| terrains.iter().map(|one| one.hash).collect::<Vec<_>>();
    assert_eq!(names(&first), [hashes[2], hashes[1]]);
    let rest = page(Some(first[1].sequence));
    let rest = fixture.store.terrains(&rest).await.unwrap();
    assert_eq!(names(&rest), [hashes[0]]);
}

async fn a_terrain_that_a_job_names_stays_until_the_job_is_removed(fixture: &Fixture) {
    let hash = fixture.put(b"a").await;
    // The same raster may serve as two parts of a scenario.
    let jobs = [job_on(&[hash, hash]), job_on(&[])];
    let submitted = fixture.store.submit(&submission(&jobs)).await.unwrap();
    assert_eq!(submitted, Submitted::Accepted);
    assert_eq!(fixture.remove(hash).await, in_use(1, 0));
    fixture.store.dismiss(jobs[0].id).await.unwrap();
    assert_eq!(fixture.remove(hash).await, in_use(1, 0));
    fixture.store.remove(jobs[0].id).await.unwrap();
    assert_eq!(fixture.remove(hash).await, TerrainRemoval::Removed);
}

async fn a_terrain_that_a_study_names_stays_until_the_study_is_removed(fixture: &Fixture) {
    let hash = fixture.put(b"a").await;
    let study = StudyId::new();
    let new = NewStudy {
        terrains: &[hash],
        ..new_study(study, "a")
    };
    let submitted = fixture.store.add_study(&new).await.unwrap();
    assert_eq!(submitted, StudySubmitted::Accepted);
    assert_eq!(fixture.remove(hash).await, in_use(0, 1));
    let member = NewMember {
        level: 0,
        member: 0,
        work: MemberWork::Job(Box::new(job_on(&[hash]))),
    };
    fixture.store.add_members(study, &[member]).await.unwrap();
    assert_eq!(fixture.remove(hash).await, in_use(1, 1));
    let end = StudyEnd {
        status: StudyStatus::Dismissed,
        problem: None,
        document: None,
    };
    fixture.store.end_study(study, end).await.unwrap();
    fixture.store.remove_study(study).await.unwrap();
    assert_eq!(fixture.remove(hash).await, in_use(1, 0));
    assert_eq!(fixture.store.remove_orphans().await.unwrap(), 1);
    assert_eq!(fixture.remove(hash).await, TerrainRemoval::Removed);
}

async fn nothing_is_kept_that_names_no_terrain(fixture: &Fixture) {
    let hash = TerrainHash::of(b"nowhere");
    let jobs = [job_on(&[]), job_on(&[hash])];
    let submitted = fixture.store.submit(&submission(&jobs)).await.unwrap();
    assert_eq!(submitted, Submitted::NoTerrain(hash));
    assert_eq!(fixture.store.status(jobs[0].id).await.unwrap(), None);
    let study = StudyId::new();
    let new = NewStudy {
        terrains: &[hash],
        ..new_study(study, "a")
    };
    let submitted = fixture.store.add_study(&new).await.unwrap();
    assert_eq!(submitted, StudySubmitted::NoTerrain(hash));
    assert!(fixture.store.study(study).await.unwrap().is_none());
}

async fn a_job_and_the_removal_of_its_terrain_do_not_both_succeed(fixture: &Fixture) {
    for round in 0..20_u8 {
        let hash = fixture.put(&[round]).await;
        let jobs = [job_on(&[hash])];
        let submission = submission(&jobs);
        let (submitted, removal) = tokio::join!(
            fixture.store.submit(&submission),
            fixture.store.remove_terrain(hash)
        );
        let kept = removal.unwrap() == in_use(1, 0);
        let expected = match kept {
            true => Submitted::Accepted,
            false => Submitted::NoTerrain(hash),
        };
        assert_eq!(submitted.unwrap(), expected);
        assert_eq!(fixture.store.terrain(hash).await.unwrap().is_some(), kept);
    }
}
