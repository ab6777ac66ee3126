-- The block of a snapshot of the flow begins with the identifiers of its points, so that the same
-- material point is found in all snapshots of a run; those of older versions have none.
ALTER TABLE flow_snapshots ADD COLUMN has_identifiers INTEGER NOT NULL DEFAULT 0
    CHECK (has_identifiers IN (0, 1));
