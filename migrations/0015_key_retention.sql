-- A key is kept as long as one of its jobs, and then for a time: from this operating time on. Null
-- while there is a job.
ALTER TABLE keyed_requests ADD COLUMN released_operating_ms INTEGER;
-- Space that the request and its answer take, about.
ALTER TABLE keyed_requests ADD COLUMN stored_bytes INTEGER NOT NULL DEFAULT 0;

UPDATE keyed_requests SET stored_bytes = 256 + length(job_ids) + coalesce(length(answer_body), 0);
UPDATE keyed_requests SET released_operating_ms = (SELECT total_ms FROM operating_time)
WHERE NOT EXISTS (SELECT 1 FROM jobs WHERE keyed_request = keyed_requests.sequence);

CREATE INDEX keyed_requests_by_release ON keyed_requests (released_operating_ms)
WHERE released_operating_ms IS NOT NULL;
CREATE INDEX keyed_requests_released ON keyed_requests (submitter, sequence, stored_bytes)
WHERE released_operating_ms IS NOT NULL;

CREATE TRIGGER keys_are_released_with_their_last_job
AFTER DELETE ON jobs WHEN OLD.keyed_request IS NOT NULL
BEGIN
    UPDATE keyed_requests SET released_operating_ms = (SELECT total_ms FROM operating_time)
    WHERE sequence = OLD.keyed_request
      AND NOT EXISTS (SELECT 1 FROM jobs WHERE keyed_request = OLD.keyed_request);
END;
