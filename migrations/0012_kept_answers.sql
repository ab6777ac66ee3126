-- A key brings the answer of its first request again: status, Location and body (JSON,
-- compressed), also when its jobs have been removed since. Null until the first answer is made.
ALTER TABLE keyed_requests ADD COLUMN answer_status INTEGER CHECK (answer_status BETWEEN 200 AND 299);
ALTER TABLE keyed_requests ADD COLUMN answer_location TEXT;
ALTER TABLE keyed_requests ADD COLUMN answer_body BLOB;

DROP TRIGGER IF EXISTS keys_go_with_their_jobs;
