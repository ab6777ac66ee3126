-- A job is one scenario to be computed once. Its row is the queue: workers
-- claim the oldest accepted row. The words for its states are those of
-- OGC API - Processes:
--
--   accepted    waiting for a worker
--   running     a worker of this process computes it
--   successful  computed to the end; `outcome` holds the answer
--   failed      ended without an answer; `problem` says why
--   dismissed   a client called it off; what was computed by then is kept
--
-- The last three are final. Times are milliseconds since 1970-01-01 UTC.
CREATE TABLE jobs (
    -- Order of submission; never used twice, so a page cursor stays valid.
    sequence          INTEGER PRIMARY KEY AUTOINCREMENT,
    id                TEXT    NOT NULL UNIQUE CHECK (length(id) = 36),
    status            TEXT    NOT NULL DEFAULT 'accepted'
                      CHECK (status IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
    created_ms        INTEGER NOT NULL,
    started_ms        INTEGER,
    finished_ms       INTEGER,
    -- The scenario with every default filled in, as JSON, and two facts of it.
    scenario          TEXT    NOT NULL CHECK (json_valid(scenario)),
    title             TEXT    NOT NULL,
    bodies            INTEGER NOT NULL CHECK (bodies >= 0),
    -- The solver that runs it; until the start, the one that checked it.
    solver_version    TEXT    NOT NULL,
    -- How often a worker took it up. Every write of a worker names the attempt
    -- it belongs to, so a worker that lost its job can't write into the next one.
    attempt           INTEGER NOT NULL DEFAULT 0 CHECK (attempt >= 0),
    -- How often the process died while running it.
    cut_offs          INTEGER NOT NULL DEFAULT 0 CHECK (cut_offs BETWEEN 0 AND attempt),
    -- Progress, as last reported.
    fraction          REAL    NOT NULL DEFAULT 0 CHECK (fraction BETWEEN 0 AND 1),
    simulated_time_s  REAL    NOT NULL DEFAULT 0 CHECK (simulated_time_s >= 0),
    steps             INTEGER NOT NULL DEFAULT 0 CHECK (steps >= 0),
    substeps          INTEGER NOT NULL DEFAULT 0 CHECK (substeps >= 0),
    point_steps_per_s REAL    NOT NULL DEFAULT 0 CHECK (point_steps_per_s >= 0),
    eta_s             REAL             CHECK (eta_s >= 0),
    -- How it ended, as JSON.
    outcome           TEXT             CHECK (json_valid(outcome)),
    problem           TEXT             CHECK (json_valid(problem)),

    CHECK (started_ms IS NOT NULL OR status IN ('accepted', 'dismissed')),
    CHECK (started_ms IS NULL OR status <> 'accepted'),
    CHECK ((finished_ms IS NOT NULL) = (status IN ('successful', 'failed', 'dismissed'))),
    CHECK ((outcome IS NOT NULL) = (status = 'successful')),
    CHECK ((problem IS NOT NULL) = (status = 'failed'))
) STRICT;

-- Claiming asks for the oldest accepted job, listing for the newest of a state.
CREATE INDEX jobs_by_status ON jobs (status, sequence);

-- Every job starts as accepted.
CREATE TRIGGER jobs_start_accepted
BEFORE INSERT ON jobs WHEN NEW.status <> 'accepted'
BEGIN
    SELECT RAISE(ABORT, 'a job starts as accepted');
END;

-- A final state is a sink: whatever asks for it, the job never leaves it, and
-- how and when it ended stays as it was.
CREATE TRIGGER jobs_final_states_are_sinks
BEFORE UPDATE OF status, finished_ms, outcome, problem ON jobs
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

-- Stretches of one body's trajectory, in blocks of many samples (see
-- `src/results/chunk.rs`). The last chunk of a running job is replaced by a
-- longer one at each flush until it is full.
CREATE TABLE trajectory_chunks (
    job_id       TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    body         INTEGER NOT NULL CHECK (body >= 0),
    first_sample INTEGER NOT NULL CHECK (first_sample >= 0),
    samples      INTEGER NOT NULL CHECK (samples > 0),
    first_time_s REAL    NOT NULL,
    last_time_s  REAL    NOT NULL CHECK (last_time_s >= first_time_s),
    encoding     TEXT    NOT NULL CHECK (encoding = 'planes-zstd-1'),
    checksum     BLOB    NOT NULL CHECK (length(checksum) = 32),
    data         BLOB    NOT NULL,
    UNIQUE (job_id, body, first_sample)
) STRICT;

-- Snapshots of the flow, one row each (see `src/results/flow.rs`).
CREATE TABLE flow_snapshots (
    job_id   TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    time_s   REAL    NOT NULL CHECK (time_s >= 0),
    points   INTEGER NOT NULL CHECK (points >= 0),
    thinning INTEGER NOT NULL CHECK (thinning > 0),
    kept     INTEGER NOT NULL CHECK (kept >= 0),
    encoding TEXT    NOT NULL CHECK (encoding = 'planes-zstd-1'),
    checksum BLOB    NOT NULL CHECK (length(checksum) = 32),
    data     BLOB    NOT NULL,
    UNIQUE (job_id, time_s)
) STRICT;
