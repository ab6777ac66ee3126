-- The standard term for attempts that ended through no fault of the scenario; counted are those
-- in a row.
ALTER TABLE jobs RENAME COLUMN setbacks TO failed_attempts;
