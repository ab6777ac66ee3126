-- A label knows place and state of its job, so that a page of jobs with a label, of one state or of
-- any, is read from an index, however many jobs there are.
CREATE TABLE labels_by_place (
    label    TEXT    NOT NULL CHECK (length(label) BETWEEN 1 AND 64),
    job_id   TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    -- Those of the job.
    sequence INTEGER NOT NULL,
    status   TEXT    NOT NULL,
    PRIMARY KEY (label, sequence)
) STRICT, WITHOUT ROWID;

INSERT INTO labels_by_place (label, job_id, sequence, status)
SELECT label, job_id, sequence, status FROM labels JOIN jobs ON jobs.id = labels.job_id;

DROP TABLE labels;
ALTER TABLE labels_by_place RENAME TO labels;

CREATE INDEX labels_by_job ON labels (job_id);
CREATE INDEX labels_by_status ON labels (label, status, sequence);

CREATE TRIGGER labels_follow_their_jobs
AFTER UPDATE OF status ON jobs WHEN NEW.status <> OLD.status
BEGIN
    UPDATE labels SET status = NEW.status WHERE job_id = NEW.id;
END;
