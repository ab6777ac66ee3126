-- Operating time: the time for which services have had this database open, all together. It
-- grows with a service's monotonic clock, so that no jump of the time of day changes it; time
-- between a stop and the next start does not count. Leases, waits and retention go by it. The
-- time of day is only shown.
CREATE TABLE operating_time (
    id       INTEGER PRIMARY KEY CHECK (id = 1),
    -- As last noted by a service.
    total_ms INTEGER NOT NULL CHECK (total_ms >= 0)
) STRICT;
INSERT INTO operating_time (id, total_ms) VALUES (1, 0);

-- The table of jobs is made anew, with columns for operating time, and without checks by
-- json_valid: what it accepts depends on the version of SQLite that opens the file, so that a
-- dump could not be restored by another one. The service checks JSON as it reads it.
--
-- Foreign keys are off while migrations are applied, so that dropping the old table leaves
-- the rows that refer to it.
CREATE TABLE jobs_with_operating_time (
    -- Order of submission; never used twice, so a page cursor stays valid.
    sequence          INTEGER PRIMARY KEY AUTOINCREMENT,
    id                TEXT    NOT NULL UNIQUE CHECK (length(id) = 36),
    status            TEXT    NOT NULL DEFAULT 'accepted'
                      CHECK (status IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
    -- Times of day: milliseconds since 1970-01-01 UTC.
    created_ms        INTEGER NOT NULL,
    started_ms        INTEGER,
    finished_ms       INTEGER,
    -- Operating times.
    created_operating_ms INTEGER NOT NULL,
    ended_operating_ms   INTEGER,
    -- The scenario with every default filled in, as JSON, and facts of it.
    scenario          TEXT    NOT NULL,
    title             TEXT    NOT NULL,
    bodies            INTEGER NOT NULL CHECK (bodies >= 0),
    -- BLAKE3 of the scenario, as hexadecimal digits; '' for jobs from before.
    scenario_hash     TEXT    NOT NULL DEFAULT '',
    -- What the job was planned to compute and cost when it was accepted, as JSON; null for
    -- jobs from before.
    plan              TEXT,
    -- Name of the access token it came with; null where none is asked for.
    submitter         TEXT,
    -- The request it came with, if that had an Idempotency-Key.
    keyed_request     INTEGER,
    -- The solver that runs it; until the start, the one that checked it.
    solver_version    TEXT    NOT NULL,
    -- Commit of the program, and instructions of its fast path; '' before the start.
    solver_commit     TEXT    NOT NULL DEFAULT '',
    instructions      TEXT    NOT NULL DEFAULT '',
    -- Solver threads of the last attempt.
    threads           INTEGER CHECK (threads > 0),
    -- How often a worker took it up.
    attempt           INTEGER NOT NULL DEFAULT 0 CHECK (attempt >= 0),
    -- Attempts in a row that ended through no fault of the scenario.
    failed_attempts   INTEGER NOT NULL DEFAULT 0 CHECK (failed_attempts BETWEEN 0 AND attempt),
    -- After a failed attempt the job waits until this operating time.
    not_before_operating_ms INTEGER NOT NULL DEFAULT 0,
    -- A running job is leased: to whom, until which operating time, and under which fencing
    -- token.
    lease_owner       TEXT,
    lease_expires_operating_ms INTEGER,
    lease_token       INTEGER NOT NULL DEFAULT 0 CHECK (lease_token >= 0),
    -- Progress, as last reported.
    fraction          REAL    NOT NULL DEFAULT 0 CHECK (fraction BETWEEN 0 AND 1),
    simulated_time_s  REAL    NOT NULL DEFAULT 0 CHECK (simulated_time_s >= 0),
    steps             INTEGER NOT NULL DEFAULT 0 CHECK (steps >= 0),
    substeps          INTEGER NOT NULL DEFAULT 0 CHECK (substeps >= 0),
    point_steps_per_s REAL    NOT NULL DEFAULT 0 CHECK (point_steps_per_s >= 0),
    eta_s             REAL             CHECK (eta_s >= 0),
    -- How it ended, as JSON; fingerprint of all that a successful run recorded, as
    -- hexadecimal digits.
    outcome           TEXT,
    problem           TEXT,
    fingerprint       TEXT    CHECK (length(fingerprint) = 64),

    CHECK (started_ms IS NOT NULL OR status IN ('accepted', 'dismissed')),
    CHECK (started_ms IS NULL OR status <> 'accepted'),
    CHECK ((finished_ms IS NOT NULL) = (status IN ('successful', 'failed', 'dismissed'))),
    CHECK ((ended_operating_ms IS NOT NULL) = (finished_ms IS NOT NULL)),
    CHECK ((outcome IS NOT NULL) = (status = 'successful')),
    CHECK ((problem IS NOT NULL) = (status = 'failed'))
) STRICT;

-- Retention of jobs that have ended before counts from here; waits and leases are over.
INSERT INTO jobs_with_operating_time (
    sequence, id, status, created_ms, started_ms, finished_ms,
    created_operating_ms, ended_operating_ms,
    scenario, title, bodies, scenario_hash, plan, submitter, keyed_request,
    solver_version, solver_commit, instructions, threads, attempt, failed_attempts,
    lease_owner, lease_expires_operating_ms, lease_token,
    fraction, simulated_time_s, steps, substeps, point_steps_per_s, eta_s,
    outcome, problem, fingerprint)
SELECT
    sequence, id, status, created_ms, started_ms, finished_ms,
    0, iif(finished_ms IS NULL, NULL, 0),
    scenario, title, bodies, scenario_hash, plan, submitter, keyed_request,
    solver_version, solver_commit, instructions, threads, attempt, failed_attempts,
    lease_owner, iif(lease_expires_ms IS NULL, NULL, 0), lease_token,
    fraction, simulated_time_s, steps, substeps, point_steps_per_s, eta_s,
    outcome, problem, fingerprint
FROM jobs ORDER BY sequence;

-- The number of the last job ever, which may have been removed.
DELETE FROM sqlite_sequence WHERE name = 'jobs_with_operating_time';
INSERT INTO sqlite_sequence (name, seq)
SELECT 'jobs_with_operating_time', seq FROM sqlite_sequence WHERE name = 'jobs';

DROP TABLE jobs;
ALTER TABLE jobs_with_operating_time RENAME TO jobs;

-- Claiming asks for the oldest accepted job, listing for the newest of a state.
CREATE INDEX jobs_by_status ON jobs (status, sequence);
CREATE INDEX jobs_by_scenario ON jobs (scenario_hash, status);
CREATE INDEX jobs_by_submitter ON jobs (submitter, status) WHERE submitter IS NOT NULL;
CREATE INDEX jobs_by_keyed_request ON jobs (keyed_request) WHERE keyed_request IS NOT NULL;
CREATE INDEX jobs_by_end ON jobs (ended_operating_ms) WHERE ended_operating_ms IS NOT NULL;

-- Every job starts as accepted.
CREATE TRIGGER jobs_start_accepted
BEFORE INSERT ON jobs WHEN NEW.status <> 'accepted'
BEGIN
    SELECT RAISE(ABORT, 'a job starts as accepted');
END;

-- A final state is a sink: whatever asks for it, the job never leaves it, and
-- how and when it ended stays as it was.
CREATE TRIGGER jobs_final_states_are_sinks
BEFORE UPDATE OF status, finished_ms, ended_operating_ms, outcome, problem ON jobs
WHEN OLD.status IN ('successful', 'failed', 'dismissed')
BEGIN
    SELECT RAISE(ABORT, 'the job has ended');
END;

-- Only a running job can succeed or fail.
CREATE TRIGGER jobs_end_from_running
BEFORE UPDATE OF status ON jobs
WHEN OLD.status = 'accepted' AND NEW.status IN ('successful', 'failed')
BEGIN
    SELECT RAISE(ABORT, 'the job is not running');
END;

CREATE TRIGGER jobs_running_are_leased
BEFORE UPDATE ON jobs
WHEN OLD.status IN ('accepted', 'running')
 AND (NEW.status = 'running')
     <> (NEW.lease_owner IS NOT NULL AND NEW.lease_expires_operating_ms IS NOT NULL)
BEGIN
    SELECT RAISE(ABORT, 'a running job has a lease, and no other');
END;

CREATE TRIGGER jobs_tokens_grow
BEFORE UPDATE OF status, lease_token ON jobs
WHEN NEW.lease_token < OLD.lease_token
  OR (OLD.status = 'accepted' AND NEW.status = 'running' AND NEW.lease_token = OLD.lease_token)
BEGIN
    SELECT RAISE(ABORT, 'a fencing token is never used twice');
END;

-- A job that has ended never goes on.
CREATE TRIGGER jobs_ended_keep_no_state
AFTER UPDATE OF status ON jobs
WHEN NEW.status IN ('successful', 'failed', 'dismissed')
BEGIN
    DELETE FROM run_states WHERE job_id = NEW.id;
END;

CREATE TRIGGER keys_go_with_their_jobs
AFTER DELETE ON jobs WHEN OLD.keyed_request IS NOT NULL
BEGIN
    DELETE FROM keyed_requests
    WHERE sequence = OLD.keyed_request
      AND NOT EXISTS (SELECT 1 FROM jobs WHERE keyed_request = OLD.keyed_request);
END;

CREATE TRIGGER events_of_new_jobs
AFTER INSERT ON jobs
BEGIN
    INSERT INTO events (job_id, status, attempt) VALUES (NEW.id, NEW.status, NEW.attempt);
END;

CREATE TRIGGER events_of_jobs
AFTER UPDATE OF status ON jobs WHEN NEW.status <> OLD.status
BEGIN
    INSERT INTO events (job_id, status, attempt) VALUES (NEW.id, NEW.status, NEW.attempt);
END;
