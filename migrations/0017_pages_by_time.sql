-- A page of jobs of some states, with a label or without, that were accepted within a span of time
-- is read from an index: its entries have the time, so that jobs outside of it are not looked up.
DROP INDEX jobs_by_status;
CREATE INDEX jobs_by_status ON jobs (status, sequence, created_ms);

-- That of the job.
ALTER TABLE labels ADD COLUMN created_ms INTEGER NOT NULL DEFAULT 0;
UPDATE labels SET created_ms = jobs.created_ms FROM jobs WHERE jobs.id = labels.job_id;
DROP INDEX labels_by_status;
CREATE INDEX labels_by_status ON labels (label, status, sequence, created_ms);
