-- A removal is an event, too, so that whoever follows a job learns of its end. The table of events
-- is made anew, without the reference by which the events of a removed job went with it.
DROP TRIGGER events_of_new_jobs;
DROP TRIGGER events_of_jobs;

CREATE TABLE events_with_removals (
    sequence INTEGER PRIMARY KEY AUTOINCREMENT,
    job_id   TEXT    NOT NULL,
    -- The new state, or 'removed'.
    status   TEXT    NOT NULL,
    attempt  INTEGER NOT NULL
) STRICT;

INSERT INTO events_with_removals (sequence, job_id, status, attempt)
SELECT sequence, job_id, status, attempt FROM events ORDER BY sequence;

-- The number of the last event ever, which may have gone with its job.
DELETE FROM sqlite_sequence WHERE name = 'events_with_removals';
INSERT INTO sqlite_sequence (name, seq)
SELECT 'events_with_removals', seq FROM sqlite_sequence WHERE name = 'events';

DROP TABLE events;
ALTER TABLE events_with_removals RENAME TO events;

CREATE INDEX events_by_job ON events (job_id, sequence);
CREATE INDEX events_of_removals ON events (sequence) WHERE status = 'removed';

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

-- Of a removed job only the removal is left, and that for 100,000 events.
CREATE TRIGGER events_of_removed_jobs
AFTER DELETE ON jobs
BEGIN
    DELETE FROM events WHERE job_id = OLD.id;
    INSERT INTO events (job_id, status, attempt) VALUES (OLD.id, 'removed', OLD.attempt);
    DELETE FROM events
    WHERE status = 'removed' AND sequence <= (SELECT sequence FROM events ORDER BY sequence DESC LIMIT 1) - 100000;
END;
