-- Jobs, their results, and studies, for PostgreSQL. What the tables mean is told in the migrations
-- for SQLite, in the folder above; here stands what differs.
--
-- Several services and workers write at the same time. Rows are locked, not the database: each
-- transaction that changes a job locks its row first.

-- Operating time of all services and workers together: see docs/decisions/0056.
CREATE TABLE operating_time (
    id       BIGINT PRIMARY KEY CHECK (id = 1),
    total_ms BIGINT NOT NULL CHECK (total_ms >= 0)
) WITH (fillfactor = 50);
INSERT INTO operating_time (id, total_ms) VALUES (1, 0);

CREATE TABLE jobs (
    sequence          BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
    id                UUID    NOT NULL UNIQUE,
    status            TEXT    NOT NULL DEFAULT 'accepted'
                      CHECK (status IN ('accepted', 'running', 'successful', 'failed', 'dismissed')),
    -- Jobs of priority 1, the members of studies, are claimed when none of priority 0 waits.
    priority          BIGINT  NOT NULL DEFAULT 0 CHECK (priority IN (0, 1)),
    -- Work that the plan foresees [point-steps]; a pack of jobs is claimed by it.
    planned_work      BIGINT  NOT NULL CHECK (planned_work >= 0),
    -- Memory that it foresees [bytes]; a worker claims no job that it has no memory for.
    planned_memory_bytes BIGINT NOT NULL CHECK (planned_memory_bytes >= 0),
    -- Times of day: milliseconds since 1970-01-01 UTC.
    created_ms        BIGINT  NOT NULL,
    started_ms        BIGINT,
    finished_ms       BIGINT,
    -- Operating times.
    created_operating_ms BIGINT NOT NULL,
    ended_operating_ms   BIGINT,
    scenario          TEXT    NOT NULL,
    title             TEXT    NOT NULL,
    bodies            BIGINT  NOT NULL CHECK (bodies >= 0),
    scenario_hash     TEXT    NOT NULL,
    plan              TEXT,
    submitter         TEXT,
    keyed_request     BIGINT,
    solver_version    TEXT    NOT NULL,
    solver_commit     TEXT    NOT NULL DEFAULT '',
    instructions      TEXT    NOT NULL DEFAULT '',
    threads           BIGINT  CHECK (threads > 0),
    attempt           BIGINT  NOT NULL DEFAULT 0 CHECK (attempt >= 0),
    failed_attempts   BIGINT  NOT NULL DEFAULT 0 CHECK (failed_attempts BETWEEN 0 AND attempt),
    not_before_operating_ms BIGINT NOT NULL DEFAULT 0,
    lease_owner       TEXT,
    lease_expires_operating_ms BIGINT,
    lease_token       BIGINT  NOT NULL DEFAULT 0 CHECK (lease_token >= 0),
    -- True once the worker of a claimed job has begun its attempt.
    begun             BOOLEAN NOT NULL DEFAULT false,
    fraction          DOUBLE PRECISION NOT NULL DEFAULT 0 CHECK (fraction BETWEEN 0 AND 1),
    simulated_time_s  DOUBLE PRECISION NOT NULL DEFAULT 0 CHECK (simulated_time_s >= 0),
    steps             BIGINT  NOT NULL DEFAULT 0 CHECK (steps >= 0),
    substeps          BIGINT  NOT NULL DEFAULT 0 CHECK (substeps >= 0),
    point_steps_per_s DOUBLE PRECISION NOT NULL DEFAULT 0 CHECK (point_steps_per_s >= 0),
    eta_s             DOUBLE PRECISION CHECK (eta_s >= 0),
    outcome           TEXT,
    problem           TEXT,
    fingerprint       TEXT    CHECK (length(fingerprint) = 64),

    CHECK (started_ms IS NOT NULL OR status IN ('accepted', 'dismissed')),
    CHECK (started_ms IS NULL OR status <> 'accepted'),
    CHECK ((finished_ms IS NOT NULL) = (status IN ('successful', 'failed', 'dismissed'))),
    CHECK ((ended_operating_ms IS NOT NULL) = (finished_ms IS NOT NULL)),
    CHECK ((outcome IS NOT NULL) = (status = 'successful')),
    CHECK ((problem IS NOT NULL) = (status = 'failed')),
    -- A running job has a lease, and no other has.
    CHECK ((status = 'running') = (lease_owner IS NOT NULL)),
    CHECK ((status = 'running') = (lease_expires_operating_ms IS NOT NULL))
-- Room for new versions of a row beside the old one, which no index then learns of; documents are
-- kept elsewhere, so that a heartbeat does not copy them.
) WITH (fillfactor = 70, toast_tuple_target = 128);

-- Claiming asks for the oldest accepted job of the first priority.
CREATE INDEX jobs_by_turn ON jobs (priority, sequence) WHERE status = 'accepted';
-- Running jobs by their processes: for leases that have run out.
CREATE INDEX jobs_leased ON jobs (lease_owner) WHERE lease_owner IS NOT NULL;
CREATE INDEX jobs_by_status ON jobs (status, sequence, created_ms);
CREATE INDEX jobs_by_scenario ON jobs (scenario_hash, status);
CREATE INDEX jobs_by_submitter ON jobs (submitter, status, priority) WHERE submitter IS NOT NULL;
CREATE INDEX jobs_by_keyed_request ON jobs (keyed_request) WHERE keyed_request IS NOT NULL;
CREATE INDEX jobs_by_end ON jobs (ended_operating_ms) WHERE ended_operating_ms IS NOT NULL;

CREATE TABLE attempts (
    job_id         UUID    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    attempt        BIGINT  NOT NULL CHECK (attempt > 0),
    owner          TEXT    NOT NULL,
    started_ms     BIGINT  NOT NULL,
    resumed_from_s DOUBLE PRECISION CHECK (resumed_from_s > 0),
    ended_ms       BIGINT,
    ending         TEXT    CHECK (ending IN ('successful', 'failed', 'dismissed', 'handed-back',
                                             'cut-off', 'expired', 'infrastructure')),
    detail         TEXT,
    PRIMARY KEY (job_id, attempt),
    CHECK ((ended_ms IS NULL) = (ending IS NULL))
) WITH (fillfactor = 70);

-- Whatever the code does: no job is run to its end twice.
CREATE UNIQUE INDEX attempts_to_the_end ON attempts (job_id) WHERE ending = 'successful';

-- Ended attempts by kind of end, those of removed jobs included: a counter never falls. Each
-- writer adds to one of several rows, so that none waits for another.
CREATE TABLE attempt_totals (
    ending TEXT   NOT NULL,
    slot   BIGINT NOT NULL,
    total  BIGINT NOT NULL CHECK (total >= 0),
    PRIMARY KEY (ending, slot)
) WITH (fillfactor = 50);

CREATE TABLE run_states (
    job_id      UUID   NOT NULL PRIMARY KEY REFERENCES jobs (id) ON DELETE CASCADE,
    attempt     BIGINT NOT NULL CHECK (attempt > 0),
    saved_ms    BIGINT NOT NULL,
    time_s      DOUBLE PRECISION NOT NULL CHECK (time_s > 0),
    samples     BIGINT NOT NULL CHECK (samples >= 0),
    fingerprint BYTEA  NOT NULL CHECK (length(fingerprint) = 32),
    bytes       BIGINT NOT NULL CHECK (bytes > 0),
    checksum    BYTEA  NOT NULL CHECK (length(checksum) = 32)
);

CREATE TABLE run_state_pieces (
    job_id UUID   NOT NULL REFERENCES run_states (job_id) ON DELETE CASCADE,
    piece  BIGINT NOT NULL CHECK (piece >= 0),
    data   BYTEA  NOT NULL,
    PRIMARY KEY (job_id, piece)
);
-- Compressed before.
ALTER TABLE run_state_pieces ALTER data SET STORAGE EXTERNAL;

CREATE TABLE trajectory_chunks (
    job_id       UUID   NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    body         BIGINT NOT NULL CHECK (body >= 0),
    first_sample BIGINT NOT NULL CHECK (first_sample >= 0),
    samples      BIGINT NOT NULL CHECK (samples > 0),
    first_time_s DOUBLE PRECISION NOT NULL,
    last_time_s  DOUBLE PRECISION NOT NULL CHECK (last_time_s >= first_time_s),
    encoding     TEXT   NOT NULL CHECK (encoding = 'planes-zstd-1'),
    checksum     BYTEA  NOT NULL CHECK (length(checksum) = 32),
    data         BYTEA  NOT NULL,
    PRIMARY KEY (job_id, body, first_sample)
);
ALTER TABLE trajectory_chunks ALTER data SET STORAGE EXTERNAL;

CREATE TABLE flow_snapshots (
    job_id   UUID   NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    time_s   DOUBLE PRECISION NOT NULL CHECK (time_s >= 0),
    points   BIGINT NOT NULL CHECK (points >= 0),
    thinning BIGINT NOT NULL CHECK (thinning > 0),
    kept     BIGINT NOT NULL CHECK (kept >= 0),
    encoding TEXT   NOT NULL CHECK (encoding = 'planes-zstd-1'),
    checksum BYTEA  NOT NULL CHECK (length(checksum) = 32),
    data     BYTEA  NOT NULL,
    PRIMARY KEY (job_id, time_s)
);
ALTER TABLE flow_snapshots ALTER data SET STORAGE EXTERNAL;

CREATE TABLE keyed_requests (
    sequence  BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
    submitter TEXT   NOT NULL,
    key       TEXT   NOT NULL CHECK (length(key) BETWEEN 1 AND 255),
    body_hash BYTEA  NOT NULL CHECK (length(body_hash) = 32),
    job_ids   TEXT   NOT NULL,
    answer_status   BIGINT CHECK (answer_status BETWEEN 200 AND 299),
    answer_location TEXT,
    answer_body     BYTEA,
    released_operating_ms BIGINT,
    stored_bytes    BIGINT NOT NULL,
    UNIQUE (submitter, key)
);

CREATE INDEX keyed_requests_by_release ON keyed_requests (released_operating_ms)
WHERE released_operating_ms IS NOT NULL;
CREATE INDEX keyed_requests_released ON keyed_requests (submitter, sequence, stored_bytes)
WHERE released_operating_ms IS NOT NULL;

CREATE TABLE labels (
    label      TEXT   NOT NULL CHECK (length(label) BETWEEN 1 AND 64),
    job_id     UUID   NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    sequence   BIGINT NOT NULL,
    status     TEXT   NOT NULL,
    created_ms BIGINT NOT NULL,
    PRIMARY KEY (label, sequence)
);

CREATE INDEX labels_by_job ON labels (job_id);
CREATE INDEX labels_by_status ON labels (label, status, sequence, created_ms);

-- Changes of state. Transactions end in another order than they begin, so a number drawn when a
-- change is written could become visible after a higher one, and whoever asks for what came after
-- that would miss it. Changes are therefore written without a number, and numbered by those who read
-- them, one at a time.
CREATE TABLE events (
    place    BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
    sequence BIGINT UNIQUE,
    job_id   UUID   NOT NULL,
    status   TEXT   NOT NULL,
    attempt  BIGINT NOT NULL
) WITH (fillfactor = 80);

CREATE INDEX events_to_be_numbered ON events (place) WHERE sequence IS NULL;
CREATE INDEX events_by_job ON events (job_id, sequence);
CREATE INDEX events_of_removals ON events (sequence) WHERE status = 'removed';

-- Number of the last event ever.
CREATE TABLE last_event (
    id       BIGINT PRIMARY KEY CHECK (id = 1),
    sequence BIGINT NOT NULL CHECK (sequence >= 0)
) WITH (fillfactor = 50);
INSERT INTO last_event (id, sequence) VALUES (1, 0);

CREATE TABLE webhooks (
    name     TEXT   PRIMARY KEY CHECK (length(name) BETWEEN 1 AND 100),
    position BIGINT NOT NULL CHECK (position >= 0)
);

CREATE TABLE probes (
    id         BIGINT PRIMARY KEY CHECK (id = 1),
    written_ms BIGINT NOT NULL,
    room       BYTEA  NOT NULL
);

CREATE TABLE studies (
    sequence           BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
    id                 UUID   NOT NULL UNIQUE,
    status             TEXT   NOT NULL DEFAULT 'running'
                       CHECK (status IN ('running', 'successful', 'failed', 'dismissed')),
    created_ms         BIGINT NOT NULL,
    finished_ms        BIGINT,
    ended_operating_ms BIGINT,
    title              TEXT   NOT NULL,
    document           TEXT   NOT NULL,
    submitter          TEXT,
    key                TEXT   CHECK (length(key) BETWEEN 1 AND 255),
    request_hash       BYTEA  CHECK (length(request_hash) = 32),
    problem            TEXT,
    -- Members made on each level, the coarsest first, and members whose outcome is noted: counting
    -- a million rows at each look would take longer than the look.
    made_on_levels     BIGINT[] NOT NULL DEFAULT '{}',
    noted              BIGINT NOT NULL DEFAULT 0 CHECK (noted >= 0),

    CHECK ((finished_ms IS NOT NULL) = (status <> 'running')),
    CHECK ((ended_operating_ms IS NOT NULL) = (status <> 'running')),
    CHECK ((problem IS NOT NULL) = (status = 'failed')),
    CHECK ((key IS NOT NULL) = (request_hash IS NOT NULL))
);

CREATE UNIQUE INDEX studies_by_key ON studies (coalesce(submitter, ''), key) WHERE key IS NOT NULL;
CREATE INDEX studies_by_status ON studies (status, sequence);
CREATE INDEX studies_by_end ON studies (ended_operating_ms) WHERE ended_operating_ms IS NOT NULL;

CREATE TABLE study_members (
    study   BIGINT NOT NULL REFERENCES studies (sequence) ON DELETE CASCADE,
    level   BIGINT NOT NULL CHECK (level >= 0),
    member  BIGINT NOT NULL CHECK (member >= 0),
    job_id  UUID,
    outcome TEXT,
    PRIMARY KEY (study, level, member),
    CHECK (job_id IS NOT NULL OR outcome IS NOT NULL)
) WITH (fillfactor = 70);

CREATE INDEX study_members_by_job ON study_members (job_id);
CREATE INDEX study_members_in_work ON study_members (study) WHERE outcome IS NULL;

CREATE TABLE orphaned_jobs (
    job_id UUID NOT NULL PRIMARY KEY
);

-- Numbers of the first jobs in turn that no other transaction is claiming; their rows are locked.
--
-- The server is kept from reading all jobs that wait and sorting them, which it takes for cheaper while
-- it believes that they are few: it counts them only now and then, and 8,000 were sorted at each claim.
CREATE FUNCTION first_jobs(
    now_operating_ms BIGINT, up_for_ms BIGINT, first_wait_ms BIGINT, second_wait_ms BIGINT,
    memory_bytes BIGINT, jobs_at_most BIGINT
) RETURNS SETOF BIGINT LANGUAGE plpgsql
SET enable_seqscan = off SET enable_bitmapscan = off SET enable_sort = off
AS $$
BEGIN
    RETURN QUERY
    SELECT sequence FROM jobs
    WHERE status = 'accepted' AND not_before_operating_ms <= now_operating_ms
      AND planned_memory_bytes <= memory_bytes
      AND (failed_attempts = 0
           OR up_for_ms >= CASE WHEN failed_attempts = 1 THEN first_wait_ms ELSE second_wait_ms END)
    ORDER BY priority, sequence LIMIT jobs_at_most FOR UPDATE SKIP LOCKED;
END $$;

-- Rules that hold whatever the code does.

CREATE FUNCTION jobs_start_accepted() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    RAISE EXCEPTION 'a job starts as accepted';
END $$;
CREATE TRIGGER jobs_start_accepted BEFORE INSERT ON jobs
FOR EACH ROW WHEN (NEW.status <> 'accepted') EXECUTE FUNCTION jobs_start_accepted();

CREATE FUNCTION jobs_final_states_are_sinks() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    RAISE EXCEPTION 'the job has ended';
END $$;
CREATE TRIGGER jobs_final_states_are_sinks
BEFORE UPDATE OF status, finished_ms, ended_operating_ms, outcome, problem ON jobs
FOR EACH ROW WHEN (OLD.status IN ('successful', 'failed', 'dismissed'))
EXECUTE FUNCTION jobs_final_states_are_sinks();

CREATE FUNCTION jobs_end_from_running() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    RAISE EXCEPTION 'the job is not running';
END $$;
CREATE TRIGGER jobs_end_from_running BEFORE UPDATE OF status ON jobs
FOR EACH ROW WHEN (OLD.status = 'accepted' AND NEW.status IN ('successful', 'failed'))
EXECUTE FUNCTION jobs_end_from_running();

CREATE FUNCTION jobs_tokens_grow() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    RAISE EXCEPTION 'a fencing token is never used twice';
END $$;
CREATE TRIGGER jobs_tokens_grow BEFORE UPDATE OF status, lease_token ON jobs
FOR EACH ROW WHEN (NEW.lease_token < OLD.lease_token
    OR (OLD.status = 'accepted' AND NEW.status = 'running' AND NEW.lease_token = OLD.lease_token))
EXECUTE FUNCTION jobs_tokens_grow();

-- What follows from a change of a job's state: an event, its labels, and no saved state once it has
-- ended.
CREATE FUNCTION jobs_change() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    INSERT INTO events (job_id, status, attempt) VALUES (NEW.id, NEW.status, NEW.attempt);
    IF TG_OP = 'UPDATE' THEN
        UPDATE labels SET status = NEW.status WHERE job_id = NEW.id;
        IF NEW.status IN ('successful', 'failed', 'dismissed') THEN
            DELETE FROM run_states WHERE job_id = NEW.id;
        END IF;
    END IF;
    RETURN NULL;
END $$;
CREATE TRIGGER jobs_are_new AFTER INSERT ON jobs
FOR EACH ROW EXECUTE FUNCTION jobs_change();
CREATE TRIGGER jobs_change AFTER UPDATE OF status ON jobs
FOR EACH ROW WHEN (NEW.status <> OLD.status) EXECUTE FUNCTION jobs_change();

-- Of a removed job only the removal is left, and that for 100,000 events; its key is released once
-- the last of its jobs is removed.
CREATE FUNCTION jobs_are_removed() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    DELETE FROM events WHERE job_id = OLD.id;
    INSERT INTO events (job_id, status, attempt) VALUES (OLD.id, 'removed', OLD.attempt);
    DELETE FROM events
    WHERE status = 'removed'
      AND sequence <= (SELECT last_event.sequence FROM last_event) - 100000;
    IF OLD.keyed_request IS NOT NULL THEN
        UPDATE keyed_requests SET released_operating_ms = (SELECT total_ms FROM operating_time)
        WHERE sequence = OLD.keyed_request
          AND NOT EXISTS (SELECT 1 FROM jobs WHERE keyed_request = OLD.keyed_request);
    END IF;
    RETURN NULL;
END $$;
CREATE TRIGGER jobs_are_removed AFTER DELETE ON jobs
FOR EACH ROW EXECUTE FUNCTION jobs_are_removed();

CREATE FUNCTION ended_attempts_are_counted() RETURNS trigger LANGUAGE plpgsql AS $$
BEGIN
    INSERT INTO attempt_totals (ending, slot, total)
    VALUES (NEW.ending, pg_backend_pid() % 1024, 1)
    ON CONFLICT (ending, slot) DO UPDATE SET total = attempt_totals.total + 1;
    RETURN NULL;
END $$;
CREATE TRIGGER ended_attempts_are_counted AFTER UPDATE OF ending ON attempts
FOR EACH ROW WHEN (OLD.ending IS NULL AND NEW.ending IS NOT NULL)
EXECUTE FUNCTION ended_attempts_are_counted();
