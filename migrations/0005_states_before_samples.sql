-- A run behind error bars comes before the answer, whose samples alone are kept: its
-- state is saved when there are none yet. States of before are another build's, which
-- none goes on from, so none is taken over.
DROP TRIGGER jobs_ended_keep_no_state;
DROP TABLE run_state_pieces;
DROP TABLE run_states;

-- The saved state of a running or waiting job: where the next attempt goes on.
-- Written together with the results up to it.
CREATE TABLE run_states (
    job_id      TEXT    NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    attempt     INTEGER NOT NULL CHECK (attempt > 0),
    saved_ms    INTEGER NOT NULL,
    -- Simulated time of the run in hand, and samples recorded by then.
    time_s      REAL    NOT NULL CHECK (time_s > 0),
    samples     INTEGER NOT NULL CHECK (samples >= 0),
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
