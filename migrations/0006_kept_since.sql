-- Retention counts from the end of a job, which only holds by a clock that was right.
-- What stands in this table when a job ends was noted before: an end that lies before one
-- of these times was taken by a wrong clock, or the other was. Such a job is kept from the next time that the clock
-- has caught up with all that was noted.

-- From when on retention counts; null before the end, and while the clock of the end is
-- in doubt.
ALTER TABLE jobs ADD COLUMN kept_since_ms INTEGER;

-- Of jobs that ended before this version it is only known which were submitted earlier.
UPDATE jobs SET kept_since_ms = finished_ms
FROM (SELECT sequence AS place, max(created_ms) OVER (ORDER BY sequence) AS latest_ms FROM jobs)
WHERE sequence = place AND finished_ms >= latest_ms
  AND finished_ms >= coalesce(started_ms, created_ms);

CREATE INDEX jobs_by_creation ON jobs (created_ms);
CREATE INDEX jobs_by_keeping ON jobs (kept_since_ms) WHERE finished_ms IS NOT NULL;

CREATE TRIGGER jobs_are_kept_since_their_end
AFTER UPDATE OF finished_ms ON jobs
WHEN NEW.finished_ms >= coalesce(NEW.started_ms, NEW.created_ms)
 AND NEW.finished_ms >= (SELECT max(created_ms) FROM jobs)
 AND NEW.finished_ms >= (SELECT max(finished_ms) FROM jobs WHERE finished_ms IS NOT NULL)
BEGIN
    UPDATE jobs SET kept_since_ms = NEW.finished_ms WHERE sequence = NEW.sequence;
END;
