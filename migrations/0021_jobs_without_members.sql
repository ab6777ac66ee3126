-- Pages of jobs without the members of studies.
CREATE INDEX jobs_without_members ON jobs (status, sequence, created_ms) WHERE priority = 0;
