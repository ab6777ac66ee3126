//! Backups of a database in use.

use super::super::backup::{BackupError, back_up};
use super::super::file::beside;
use super::upgrade::former;
use super::*;
use std::fs;

#[tokio::test(flavor = "multi_thread", worker_threads = 2)]
async fn a_backup_of_a_database_in_use_has_all_that_was_acknowledged() {
    let fixture = Arc::new(Fixture::new(open).await);
    let database = fixture.directory.path().join("test.db");
    let elsewhere = TempDir::new().unwrap();
    let destination = elsewhere.path().join("backup.db");
    let mut before = Vec::new();
    for _ in 0..50 {
        before.push(fixture.submit().await);
    }
    let lease = fixture.claim("a").await;
    fixture.store.keep(lease, &results(3)).await.unwrap();
    let busy = Arc::clone(&fixture);
    let submitting = tokio::spawn(async move {
        for _ in 0..200 {
            busy.submit().await;
        }
    });
    let made = back_up(&database, &destination, false).await.unwrap();
    submitting.await.unwrap();

    let names = fs::read_dir(elsewhere.path()).unwrap().count();
    assert_eq!(names, 1, "nothing else is left there");
    assert_eq!(made.bytes, fs::metadata(&destination).unwrap().len());
    assert!((50..=250).contains(&made.jobs), "{made:?}");
    let restored = SqliteStore::open(&destination).await.unwrap();
    for id in before {
        assert!(restored.status(id).await.unwrap().is_some());
    }
    assert_eq!(restored.samples(lease.job, 0).await.unwrap(), 3);
    assert_eq!(restored.reclaim_own("a").await.unwrap(), 1);
    restored.close().await;
}

#[cfg(unix)]
#[tokio::test]
async fn a_backup_is_its_owner_s_alone_and_replaces_nothing_unasked() {
    use std::os::unix::fs::PermissionsExt;
    let fixture = Fixture::new(open).await;
    let database = fixture.directory.path().join("test.db");
    let destination = fixture.directory.path().join("backup.db");
    fs::write(&destination, "precious").unwrap();
    let refused = back_up(&database, &destination, false).await;
    assert!(
        matches!(refused, Err(BackupError::Exists(_))),
        "{refused:?}"
    );
    assert_eq!(fs::read(&destination).unwrap(), b"precious");
    for end in ["", "-wal", "-shm", "-journal", ".lock"] {
        let own = beside(&database, end);
        let before = fs::read(&own).ok();
        let itself = back_up(&database, &own, true).await;
        assert!(matches!(itself, Err(BackupError::Itself(_))), "{itself:?}");
        assert!(fs::read(&own).ok() == before, "{end}");
    }
    let nothing = back_up(&fixture.directory.path().join("no.db"), &destination, true).await;
    assert!(
        matches!(nothing, Err(BackupError::Missing(_))),
        "{nothing:?}"
    );

    back_up(&database, &destination, true).await.unwrap();
    let mode = fs::metadata(&destination).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o600);
}

#[tokio::test]
async fn a_backup_of_a_damaged_database_is_not_kept() {
    let fixture = Fixture::new(open).await;
    let lease_of = fixture.submit().await;
    let lease = fixture.claim("a").await;
    assert_eq!(lease.job, lease_of);
    fixture.store.keep(lease, &results(3)).await.unwrap();
    sqlx::query("UPDATE trajectory_chunks SET data = zeroblob(length(data))")
        .execute(&mut past(&fixture).await)
        .await
        .unwrap();
    let database = fixture.directory.path().join("test.db");
    let destination = fixture.directory.path().join("backup.db");
    let unsound = back_up(&database, &destination, false).await.unwrap_err();
    assert!(
        unsound.to_string().contains(&lease.job.to_string()),
        "{unsound}"
    );
    assert!(!destination.exists());
}

#[tokio::test]
async fn a_backup_of_a_former_version_can_give_space_back() {
    let directory = TempDir::new().unwrap();
    let database = directory.path().join("former.db");
    former(&database).await;
    // Its block is made up.
    sqlx::query("DELETE FROM trajectory_chunks")
        .execute(&mut connect(&database).await)
        .await
        .unwrap();
    let destination = directory.path().join("backup.db");
    let made = back_up(&database, &destination, false).await.unwrap();
    assert_eq!(made.jobs, 5);
    for (path, expected) in [(&database, 0), (&destination, 2)] {
        let set: i64 = sqlx::query_scalar("PRAGMA auto_vacuum")
            .fetch_one(&mut connect(path).await)
            .await
            .unwrap();
        assert_eq!(set, expected, "{path:?}");
    }
}
