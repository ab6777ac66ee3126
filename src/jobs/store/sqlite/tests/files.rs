//! The file of a database: which are refused before anything is written, and what is noticed
//! while a service uses it.

use super::*;
use crate::jobs::job::JobId;
use crate::jobs::store::sqlite::backup::back_up;
use crate::jobs::store::sqlite::file::beside;
use crate::jobs::store::{Room, Submission};
use std::collections::BTreeMap;
use std::fs;

/// Names and contents of all files of a folder.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap();
    let paths = entries.map(|entry| entry.unwrap().path());
    paths
        .map(|path| (path.clone(), fs::read(&path).unwrap_or_default()))
        .collect()
}

/// Error at the opening of a database, which must leave everything as it was.
async fn refused(path: &Path) -> String {
    let folder = path.parent().unwrap();
    let before = contents(folder);
    let error = SqliteStore::open(path).await.unwrap_err().to_string();
    assert!(contents(folder) == before, "changed: {error}");
    assert!(error.contains(&path.display().to_string()), "{error}");
    error
}

async fn made_by(path: &Path, statements: &'static str) {
    let url = format!("sqlite://{}?mode=rwc", path.display());
    let mut connection = SqliteConnection::connect(&url).await.unwrap();
    sqlx::raw_sql(statements)
        .execute(&mut connection)
        .await
        .unwrap();
    connection.close().await.unwrap();
}

const OTHERS_MIGRATIONS: &str = "CREATE TABLE _sqlx_migrations (
        version BIGINT PRIMARY KEY, description TEXT NOT NULL,
        installed_on TIMESTAMP NOT NULL DEFAULT CURRENT_TIMESTAMP,
        success BOOLEAN NOT NULL, checksum BLOB NOT NULL, execution_time BIGINT NOT NULL);
     INSERT INTO _sqlx_migrations VALUES (1, 'jobs', '2026-01-01', TRUE, x'00', 1);";

#[tokio::test]
async fn a_database_of_another_program_is_left_as_it_is() {
    for statements in [
        "CREATE TABLE cats (name TEXT)",
        "PRAGMA journal_mode = WAL; CREATE TABLE cats (name TEXT)",
        "CREATE TABLE jobs (id TEXT); CREATE TABLE events (id TEXT)",
        "PRAGMA application_id = 7; CREATE TABLE cats (name TEXT)",
        OTHERS_MIGRATIONS,
    ] {
        let directory = TempDir::new().unwrap();
        let path = directory.path().canonicalize().unwrap().join("cats.db");
        made_by(&path, statements).await;
        let refused = refused(&path).await;
        assert!(
            refused.contains("of another program"),
            "{statements}: {refused}"
        );
    }
}

#[tokio::test]
async fn a_file_that_is_no_database_is_left_as_it_is() {
    let directory = TempDir::new().unwrap();
    let path = directory.path().canonicalize().unwrap().join("letter.txt");
    for text in ["Dear Sir or Madam\n", &"x".repeat(10_000)] {
        fs::write(&path, text).unwrap();
        let refused = refused(&path).await;
        assert!(refused.contains("not a database"), "{refused}");
    }
}

#[tokio::test]
async fn a_database_of_a_newer_version_is_left_as_it_is() {
    let fixture = Fixture::new(open).await;
    fixture.store.close().await;
    let path = fixture.directory.path().canonicalize().unwrap();
    let path = path.join("test.db");
    made_by(
        &path,
        "INSERT INTO _sqlx_migrations SELECT 9999, '', '', TRUE, x'00', 1 FROM operating_time",
    )
    .await;
    let refused = refused(&path).await;
    assert!(
        refused.contains("newer version of scree") && refused.contains("9999"),
        "{refused}"
    );
}

#[cfg(unix)]
#[tokio::test]
async fn what_can_be_no_database_is_refused_by_a_sentence() {
    let directory = TempDir::new().unwrap();
    let folder = directory.path().canonicalize().unwrap();
    let dangling = folder.join("dangling.db");
    std::os::unix::fs::symlink(folder.join("nothing"), &dangling).unwrap();
    let linked = folder.join("linked.db");
    SqliteStore::open(&linked).await.unwrap().close().await;
    fs::hard_link(&linked, folder.join("again.db")).unwrap();
    fs::create_dir(folder.join("folder.db")).unwrap();
    for (name, reason) in [
        ("dangling.db", "a link to a file that does not exist"),
        ("linked.db", "2 names (hard links)"),
        ("again.db", "2 names (hard links)"),
        ("folder.db", "not a regular file"),
    ] {
        let refused = refused(&folder.join(name)).await;
        assert!(refused.contains(reason), "{refused}");
    }
    let nowhere = SqliteStore::open(&folder.join("no/such.db")).await;
    let nowhere = nowhere.unwrap_err().to_string();
    assert!(nowhere.contains("directory does not exist"), "{nowhere}");
}

// Others could read the scenarios, and the access tokens' names.
#[cfg(unix)]
#[tokio::test]
async fn files_are_created_for_their_owner_alone() {
    use std::os::unix::fs::PermissionsExt;
    let fixture = Fixture::new(open).await;
    fixture.submit().await;
    let mut names = Vec::new();
    for (path, _) in contents(fixture.directory.path()) {
        let mode = fs::metadata(&path).unwrap().permissions().mode() & 0o777;
        assert_eq!(mode, 0o600, "{path:?}: {mode:o}");
        names.push(path.file_name().unwrap().to_owned());
    }
    let expected = ["test.db", "test.db-shm", "test.db-wal", "test.db.lock"];
    assert_eq!(names, expected);
}

/// Checks that no write is accepted, and that what is there can still be read.
async fn only_reads(fixture: &Fixture, id: JobId, reason: &str) {
    let store = &fixture.store;
    let submission = Submission {
        jobs: &[],
        submitter: None,
        key: None,
        room: Room {
            queue: 9,
            submitter: None,
        },
    };
    for refused in [
        store.submit(&submission).await.map(drop),
        store.dismiss(id).await.map(drop),
        store.probe().await,
        store.maintain().await,
    ] {
        let refused = refused.unwrap_err();
        assert_eq!(refused.kind(), StoreErrorKind::Unavailable, "{refused}");
        assert!(refused.to_string().contains(reason), "{refused}");
    }
    assert_eq!(fixture.status(id).await, JobStatus::Accepted);
}

// Regression: jobs were acknowledged into a file that no longer had a name.
#[cfg(unix)]
#[tokio::test]
async fn a_file_that_goes_while_it_is_used_is_noticed() {
    let fixture = Fixture::new(open).await;
    let id = fixture.submit().await;
    let path = fixture.directory.path().join("test.db");
    let away = fixture.directory.path().join("away.db");
    fs::rename(&path, &away).unwrap();
    only_reads(&fixture, id, "removed or moved").await;
    fs::copy(&away, &path).unwrap();
    only_reads(&fixture, id, "replaced").await;
    fs::rename(&away, &path).unwrap();
    fixture.store.probe().await.unwrap();
    fixture.submit().await;

    // Regression: with any log in its place jobs were acknowledged, and lost.
    let log = fixture.directory.path().join("test.db-wal");
    let away = fixture.directory.path().join("away.db-wal");
    fs::rename(&log, &away).unwrap();
    only_reads(&fixture, id, "write-ahead log").await;
    let copy = fixture.directory.path().join("copy.db");
    let refused = back_up(&path, &copy, false).await.unwrap_err();
    assert!(refused.to_string().contains("(-wal) is gone"), "{refused}");
    fs::write(&log, "").unwrap();
    only_reads(&fixture, id, "write-ahead log").await;
    fs::rename(&away, &log).unwrap();
    fixture.submit().await;
}

// Regression: without the file nothing kept a second service off.
#[cfg(unix)]
#[tokio::test]
async fn a_lock_whose_file_was_removed_is_taken_anew() {
    let fixture = Fixture::new(open).await;
    let path = fixture.directory.path().join("test.db");
    fs::remove_file(beside(&path, ".lock")).unwrap();
    fixture.submit().await;
    let second = SqliteStore::open(&path).await.unwrap_err();
    assert!(matches!(second, StoreError::InUse { .. }), "{second}");
}

#[cfg(unix)]
#[tokio::test]
async fn a_link_to_a_database_is_the_database() {
    let fixture = Fixture::new(open).await;
    let id = fixture.submit().await;
    fixture.store.close().await;
    let link = fixture.directory.path().join("link.db");
    std::os::unix::fs::symlink("test.db", &link).unwrap();
    let store = SqliteStore::open(&link).await.unwrap();
    assert_eq!(store.status(id).await.unwrap(), Some(JobStatus::Accepted));
    let there: Vec<_> = contents(fixture.directory.path()).into_keys().collect();
    assert!(
        there.iter().all(|path| !path.ends_with("link.db-wal")),
        "{there:?}"
    );
    store.close().await;
}
