-- Number of the last event that each webhook's receiver has taken, or that its states left out.
CREATE TABLE webhooks (
    name     TEXT    PRIMARY KEY CHECK (length(name) BETWEEN 1 AND 100),
    position INTEGER NOT NULL CHECK (position >= 0)
) STRICT, WITHOUT ROWID;
