-- The block of a snapshot of the flow begins with the identifiers of its points, so that the same
-- material point is found in all snapshots of a run; those of older versions have none.
ALTER TABLE flow_snapshots ADD COLUMN has_identifiers BOOLEAN NOT NULL DEFAULT FALSE;
