-- Jobs of priority 1, the members of studies, are claimed when none of priority 0 waits.
ALTER TABLE jobs ADD COLUMN priority INTEGER NOT NULL DEFAULT 0 CHECK (priority IN (0, 1));

-- Claiming asks for the oldest accepted job of the first priority.
CREATE INDEX jobs_by_turn ON jobs (priority, sequence) WHERE status = 'accepted';

-- Jobs of a submitter are counted by priority.
DROP INDEX jobs_by_submitter;
CREATE INDEX jobs_by_submitter ON jobs (submitter, status, priority) WHERE submitter IS NOT NULL;

-- A study: one scenario with uncertain inputs, computed many times. Its members are ordinary
-- jobs; what they are follows from the study and their numbers alone.
CREATE TABLE studies (
    sequence           INTEGER PRIMARY KEY AUTOINCREMENT,
    id                 TEXT    NOT NULL UNIQUE CHECK (length(id) = 36),
    status             TEXT    NOT NULL DEFAULT 'running'
                       CHECK (status IN ('running', 'successful', 'failed', 'dismissed')),
    created_ms         INTEGER NOT NULL,
    finished_ms        INTEGER,
    -- Operating time of its end; retention counts from there.
    ended_operating_ms INTEGER,
    title              TEXT    NOT NULL,
    -- The study's JSON, as enlarged last.
    document           TEXT    NOT NULL,
    -- Name of the access token it came with; null where none is asked for.
    submitter          TEXT,
    -- Idempotency-Key of its request, and BLAKE3 of the request.
    key                TEXT    CHECK (length(key) BETWEEN 1 AND 255),
    request_hash       BLOB    CHECK (length(request_hash) = 32),
    -- Why it failed, as JSON.
    problem            TEXT,

    CHECK ((finished_ms IS NOT NULL) = (status <> 'running')),
    CHECK ((ended_operating_ms IS NOT NULL) = (status <> 'running')),
    CHECK ((problem IS NOT NULL) = (status = 'failed')),
    CHECK ((key IS NOT NULL) = (request_hash IS NOT NULL))
) STRICT;

CREATE UNIQUE INDEX studies_by_key ON studies (coalesce(submitter, ''), key) WHERE key IS NOT NULL;
CREATE INDEX studies_by_status ON studies (status, sequence);
CREATE INDEX studies_by_end ON studies (ended_operating_ms) WHERE ended_operating_ms IS NOT NULL;

-- Members of studies that have been made. Several studies may share a job.
CREATE TABLE study_members (
    study   INTEGER NOT NULL REFERENCES studies (sequence) ON DELETE CASCADE,
    -- Grid level, from the coarsest.
    level   INTEGER NOT NULL CHECK (level >= 0),
    member  INTEGER NOT NULL CHECK (member >= 0),
    -- Null if the member's scenario is not allowed, which is its outcome then.
    job_id  TEXT    CHECK (length(job_id) = 36),
    -- Outcome of the member in short, as JSON, once its job has ended: it outlives the job.
    outcome TEXT,
    PRIMARY KEY (study, level, member),
    CHECK (job_id IS NOT NULL OR outcome IS NOT NULL)
) STRICT, WITHOUT ROWID;

CREATE INDEX study_members_by_job ON study_members (job_id);
-- Members are counted without reading their outcomes.
CREATE INDEX study_members_of_study ON study_members (study, job_id);
CREATE INDEX study_members_in_work ON study_members (study) WHERE outcome IS NULL;

-- Jobs of removed studies that no other study needs: they are removed a few at a time.
CREATE TABLE orphaned_jobs (
    job_id TEXT NOT NULL PRIMARY KEY
) STRICT, WITHOUT ROWID;
