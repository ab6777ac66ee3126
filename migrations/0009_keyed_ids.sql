-- A key answers as it did the first time, also when some of its jobs have been removed since: the
-- identifiers of all of them in the order of the request, as a JSON list. Of requests from before
-- the jobs that are still there.
ALTER TABLE keyed_requests ADD COLUMN job_ids TEXT NOT NULL DEFAULT '[]';

UPDATE keyed_requests SET job_ids = (
    SELECT json_group_array(id) FROM (
        SELECT id FROM jobs WHERE keyed_request = keyed_requests.sequence ORDER BY sequence
    )
);
