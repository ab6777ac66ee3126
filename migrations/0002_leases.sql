-- A running job is leased: to whom, until when, and under which fencing token.
-- The token grows whenever the job changes hands, and every write of a worker
-- names it, so one that lost its job can't write into the next run.
--
-- Jobs that an older version left running have no lease; they are run again.
UPDATE jobs
SET status = 'accepted', started_ms = NULL, fraction = 0, simulated_time_s = 0, steps = 0,
    substeps = 0, point_steps_per_s = 0, eta_s = NULL
WHERE status = 'running';

-- A setback is an attempt that ended through no fault of the scenario: the
-- process died, the lease ran out, the database failed. Counted are those in a
-- row: a state saved in between shows that the job gets on.
ALTER TABLE jobs RENAME COLUMN cut_offs TO setbacks;

ALTER TABLE jobs ADD COLUMN lease_owner TEXT;
ALTER TABLE jobs ADD COLUMN lease_expires_ms INTEGER;
ALTER TABLE jobs ADD COLUMN lease_token INTEGER NOT NULL DEFAULT 0 CHECK (lease_token >= 0);
-- After a setback the job waits until then.
ALTER TABLE jobs ADD COLUMN not_before_ms INTEGER NOT NULL DEFAULT 0;
-- Solver threads of the last attempt.
ALTER TABLE jobs ADD COLUMN threads INTEGER CHECK (threads > 0);
-- Fingerprint of all that a successful run recorded, as hexadecimal digits.
ALTER TABLE jobs ADD COLUMN fingerprint TEXT CHECK (length(fingerprint) = 64);

CREATE TRIGGER jobs_running_are_leased
BEFORE UPDATE ON jobs
WHEN OLD.status IN ('accepted', 'running')
 AND (NEW.status = 'running') <> (NEW.lease_owner IS NOT NULL AND NEW.lease_expires_ms IS NOT NULL)
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

-- Every time a worker took a job up, and how that ended.
CREATE TABLE attempts (
    job_id         TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    attempt        INTEGER NOT NULL CHECK (attempt > 0),
    owner          TEXT    NOT NULL,
    started_ms     INTEGER NOT NULL,
    -- The simulated time it went on from; null: from the start.
    resumed_from_s REAL    CHECK (resumed_from_s > 0),
    ended_ms       INTEGER,
    ending         TEXT    CHECK (ending IN ('successful', 'failed', 'dismissed', 'handed-back',
                                             'cut-off', 'expired', 'infrastructure')),
    detail         TEXT,
    PRIMARY KEY (job_id, attempt),
    CHECK ((ended_ms IS NULL) = (ending IS NULL))
) STRICT;

-- Whatever the code does: no job is run to its end twice.
CREATE UNIQUE INDEX attempts_to_the_end ON attempts (job_id) WHERE ending = 'successful';

-- The saved state of a running or waiting job: where the next attempt goes on.
-- Written together with the results up to it.
CREATE TABLE run_states (
    job_id      TEXT    NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    attempt     INTEGER NOT NULL CHECK (attempt > 0),
    saved_ms    INTEGER NOT NULL,
    -- Simulated time, and samples recorded by then.
    time_s      REAL    NOT NULL CHECK (time_s > 0),
    samples     INTEGER NOT NULL CHECK (samples > 0),
    fingerprint BLOB    NOT NULL CHECK (length(fingerprint) = 32),
    -- Length before compression, and BLAKE3 of the compressed bytes.
    bytes       INTEGER NOT NULL CHECK (bytes > 0),
    checksum    BLOB    NOT NULL CHECK (length(checksum) = 32)
) STRICT;

-- The compressed bytes, cut into pieces: one value of SQLite has its limit.
CREATE TABLE run_state_pieces (
    job_id TEXT    NOT NULL REFERENCES run_states (job_id) ON DELETE CASCADE,
    piece  INTEGER NOT NULL CHECK (piece >= 0),
    data   BLOB    NOT NULL,
    PRIMARY KEY (job_id, piece)
) STRICT;

-- A job that has ended never goes on.
CREATE TRIGGER jobs_ended_keep_no_state
AFTER UPDATE OF status ON jobs
WHEN NEW.status IN ('successful', 'failed', 'dismissed')
BEGIN
    DELETE FROM run_states WHERE job_id = NEW.id;
END;
