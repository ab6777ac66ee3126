//! Databases of former versions, and what the schema asks of the SQLite that opens it.

use super::super::inspection::APPLICATION_ID;
use super::super::schema::MIGRATOR;
use super::*;
use std::collections::BTreeSet;

/// A database as version 9 of the schema left it: one job of each state, with all that may
/// belong to it, and a last one that was removed.
const FORMER: &str = "
INSERT INTO keyed_requests (submitter, key, body_hash, job_ids)
VALUES ('lab', 'k', zeroblob(32), '[]');
INSERT INTO jobs (id, created_ms, scenario, title, bodies, solver_version, keyed_request, plan,
                  submitter, scenario_hash)
SELECT printf('00000000-0000-7000-8000-%012d', value), 5000 + value, '{}', 'title ' || value, 1,
       '1', 1, '{}', 'lab', 'hash'
FROM (SELECT 1 AS value UNION SELECT 2 UNION SELECT 3 UNION SELECT 4 UNION SELECT 5 UNION SELECT 6);
INSERT INTO labels SELECT 'label', id FROM jobs;
UPDATE jobs SET status = 'running', started_ms = 6000, attempt = 1, lease_owner = 'a',
       lease_expires_ms = 1700000000000, lease_token = 1
WHERE sequence > 1;
INSERT INTO attempts (job_id, attempt, owner, started_ms) SELECT id, 1, 'a', 6000 FROM jobs
WHERE sequence > 1;
INSERT INTO trajectory_chunks
SELECT id, 0, 0, 3, 0, 1, 'planes-zstd-1', zeroblob(32), x'0102' FROM jobs;
INSERT INTO run_states SELECT id, 1, 6000, 0.5, 3, zeroblob(32), 2, zeroblob(32) FROM jobs;
INSERT INTO run_state_pieces SELECT id, 0, x'03' FROM jobs;
UPDATE jobs SET status = 'successful', finished_ms = 7000, outcome = '{}', lease_owner = NULL,
       lease_expires_ms = NULL WHERE sequence = 3;
UPDATE jobs SET status = 'failed', finished_ms = 7000, problem = '{}', lease_owner = NULL,
       lease_expires_ms = NULL WHERE sequence = 4;
UPDATE jobs SET status = 'dismissed', finished_ms = 7000, lease_owner = NULL,
       lease_expires_ms = NULL WHERE sequence >= 5;
UPDATE jobs SET not_before_ms = 1700000000000 WHERE sequence = 1;
DELETE FROM jobs WHERE sequence = 6;
";

/// Makes such a database.
pub(super) async fn former(path: &Path) {
    let url = format!("sqlite://{}?mode=rwc", path.display());
    let mut connection = SqliteConnection::connect(&url).await.unwrap();
    MIGRATOR
        .run_direct(Some(9), &mut connection, false)
        .await
        .unwrap();
    sqlx::raw_sql(FORMER)
        .execute(&mut connection)
        .await
        .unwrap();
    connection.close().await.unwrap();
}

/// Every row of the tables that the migration does not mean to change, and of the jobs what
/// both versions have.
async fn rows(path: &Path) -> Vec<String> {
    let mut connection = connect(path).await;
    let mut rows = Vec::new();
    for statement in [
        "SELECT json_array(sequence, id, status, created_ms, started_ms, finished_ms, scenario,
             title, bodies, scenario_hash, plan, submitter, keyed_request, solver_version,
             attempt, failed_attempts, lease_owner, lease_token, outcome, problem) FROM jobs",
        "SELECT json_array(job_id, attempt, owner, started_ms, ended_ms, ending) FROM attempts",
        "SELECT json_array(job_id, body, first_sample, samples, hex(data)) FROM trajectory_chunks",
        "SELECT json_array(job_id, attempt, time_s, samples) FROM run_states",
        "SELECT json_array(job_id, piece, hex(data)) FROM run_state_pieces",
        "SELECT json_array(label, job_id) FROM labels ORDER BY job_id",
        "SELECT json_array(sequence, job_id, status, attempt) FROM events",
        "SELECT json_array(sequence, submitter, key, job_ids) FROM keyed_requests",
        "SELECT json_array(name, seq) FROM sqlite_sequence ORDER BY name",
    ] {
        let found: Vec<String> = sqlx::query_scalar(statement)
            .fetch_all(&mut connection)
            .await
            .unwrap();
        assert!(!found.is_empty(), "{statement}");
        rows.extend(found);
    }
    rows
}

#[tokio::test]
async fn a_database_of_a_former_version_keeps_all_its_rows() {
    let directory = TempDir::new().unwrap();
    let path = directory.path().join("test.db");
    former(&path).await;
    let before = rows(&path).await;
    let fixture = Fixture::within(directory, open).await;
    assert_eq!(rows(&path).await, before);

    let mut past = past(&fixture).await;
    let broken: Vec<String> = sqlx::query_scalar("SELECT \"table\" FROM pragma_foreign_key_check")
        .fetch_all(&mut past)
        .await
        .unwrap();
    assert!(broken.is_empty(), "{broken:?}");
    for (setting, expected) in [
        ("PRAGMA application_id", APPLICATION_ID),
        ("PRAGMA auto_vacuum", 2),
    ] {
        let set: i64 = sqlx::query_scalar(setting)
            .fetch_one(&mut past)
            .await
            .unwrap();
        assert_eq!(set, expected, "{setting}");
    }

    // The triggers are there: the jobs go on, and what is removed goes with all that it has.
    let next = fixture.submit().await;
    let lease = fixture.claim("b").await;
    assert_eq!(
        lease.job.to_string(),
        "00000000-0000-7000-8000-000000000001"
    );
    assert_eq!(fixture.claim("b").await.job, next);
    assert_eq!(fixture.store.reclaim_own("a").await.unwrap(), 1);
    assert!(fixture.succeed(lease).await);
    let state = fixture.store.state(lease.job).await.unwrap();
    assert_eq!(state, None, "it never goes on");
}

#[tokio::test]
async fn jobs_that_ended_under_a_former_version_are_kept_from_the_upgrade_on() {
    let directory = TempDir::new().unwrap();
    former(&directory.path().join("test.db")).await;
    let fixture = Fixture::within(directory, open).await;
    assert_eq!(fixture.store.remove_ended(60_000).await.unwrap(), 0);
    fixture.pass(std::time::Duration::from_secs(60));
    assert_eq!(fixture.store.remove_ended(60_000).await.unwrap(), 3);
    let orphans: i64 = sqlx::query_scalar(
        "SELECT count(*) FROM trajectory_chunks WHERE job_id NOT IN (SELECT id FROM jobs)",
    )
    .fetch_one(&mut past(&fixture).await)
    .await
    .unwrap();
    assert_eq!(orphans, 0);
}

/// Functions that the schema may call: what they answer does not depend on the version of
/// SQLite, so that any version restores a dump.
const FUNCTIONS: [&str; 3] = ["coalesce", "length", "raise"];

/// Words that stand before a bracket and are no functions.
const WORDS: [&str; 8] = [
    "check", "in", "key", "unique", "exists", "values", "and", "or",
];

#[tokio::test]
async fn the_schema_calls_no_function_that_depends_on_the_version_of_sqlite() {
    let fixture = Fixture::new(open).await;
    let mut past = past(&fixture).await;
    let schema: Vec<(String, String)> =
        sqlx::query_as("SELECT name, sql FROM sqlite_schema WHERE sql IS NOT NULL")
            .fetch_all(&mut past)
            .await
            .unwrap();
    let tables: BTreeSet<_> = schema.iter().map(|(name, _)| name.as_str()).collect();
    let mut called = BTreeSet::new();
    for (name, sql) in &schema {
        for function in called_in(sql) {
            let known = WORDS.contains(&function.as_str()) || tables.contains(function.as_str());
            if !known {
                assert!(
                    FUNCTIONS.contains(&function.as_str()),
                    "{name} calls {function}"
                );
                called.insert(function);
            }
        }
    }
    assert!(called.contains("length"), "none is recognised: {called:?}");
}

/// Words that stand before an opening bracket, outside comments.
fn called_in(sql: &str) -> Vec<String> {
    let lines = sql.lines().map(|line| line.split("--").next().unwrap());
    let text = lines.collect::<Vec<_>>().join(" ");
    let (before_last, _) = text.rsplit_once('(').unwrap_or_default();
    let before_brackets = before_last.split('(').map(str::trim_end);
    let word = |before: &str| {
        let word = before.rsplit(|c: char| !c.is_alphanumeric() && c != '_');
        word.map(str::to_lowercase).next()
    };
    let words = before_brackets.filter_map(word);
    words.filter(|word| !word.is_empty()).collect()
}
