-- Who submitted a job, how it is labelled, and which other jobs are the same.

-- BLAKE3 of the scenario's JSON with every default filled in, as hexadecimal
-- digits; '' for jobs from before.
ALTER TABLE jobs ADD COLUMN scenario_hash TEXT NOT NULL DEFAULT '';
-- Commit of the program that ran it; '' before the start.
ALTER TABLE jobs ADD COLUMN solver_commit TEXT NOT NULL DEFAULT '';
-- Instructions its fast path used; '' before the start.
ALTER TABLE jobs ADD COLUMN instructions TEXT NOT NULL DEFAULT '';
-- Name of the access token it came with; null where none is asked for.
ALTER TABLE jobs ADD COLUMN submitter TEXT;
-- The request it came with, if that had an Idempotency-Key.
ALTER TABLE jobs ADD COLUMN keyed_request INTEGER;

CREATE INDEX jobs_by_scenario ON jobs (scenario_hash, status);
CREATE INDEX jobs_by_submitter ON jobs (submitter, status) WHERE submitter IS NOT NULL;
CREATE INDEX jobs_by_keyed_request ON jobs (keyed_request) WHERE keyed_request IS NOT NULL;
CREATE INDEX jobs_by_end ON jobs (finished_ms) WHERE finished_ms IS NOT NULL;

-- Requests with an Idempotency-Key: the same key brings the same jobs, for as
-- long as one of them is there.
CREATE TABLE keyed_requests (
    sequence  INTEGER PRIMARY KEY AUTOINCREMENT,
    -- '' where no token is asked for.
    submitter TEXT    NOT NULL,
    key       TEXT    NOT NULL CHECK (length(key) BETWEEN 1 AND 255),
    body_hash BLOB    NOT NULL CHECK (length(body_hash) = 32),
    UNIQUE (submitter, key)
) STRICT;

CREATE TRIGGER keys_go_with_their_jobs
AFTER DELETE ON jobs WHEN OLD.keyed_request IS NOT NULL
BEGIN
    DELETE FROM keyed_requests
    WHERE sequence = OLD.keyed_request
      AND NOT EXISTS (SELECT 1 FROM jobs WHERE keyed_request = OLD.keyed_request);
END;

CREATE TABLE labels (
    label  TEXT NOT NULL CHECK (length(label) BETWEEN 1 AND 64),
    job_id TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    PRIMARY KEY (label, job_id)
) STRICT, WITHOUT ROWID;

CREATE INDEX labels_by_job ON labels (job_id);

-- Every change of a job's state, for those who follow along. Never used twice,
-- so that whoever was away can ask for what came after.
CREATE TABLE events (
    sequence INTEGER PRIMARY KEY AUTOINCREMENT,
    job_id   TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    status   TEXT    NOT NULL,
    attempt  INTEGER NOT NULL
) STRICT;

CREATE INDEX events_by_job ON events (job_id, sequence);

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

-- What the service writes to find out whether it can.
CREATE TABLE probes (
    id         INTEGER PRIMARY KEY CHECK (id = 1),
    written_ms INTEGER NOT NULL,
    room       BLOB    NOT NULL
) STRICT;
