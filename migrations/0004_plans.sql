-- What a job was planned to compute and cost when it was accepted, as JSON; null for
-- jobs from before.
ALTER TABLE jobs ADD COLUMN plan TEXT;
