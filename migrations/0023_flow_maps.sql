-- Maps of what the flow of a job did to its terrain, as GeoTIFF.
CREATE TABLE flow_maps (
    job_id   TEXT NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    name     TEXT NOT NULL CHECK (length(name) BETWEEN 1 AND 64),
    checksum BLOB NOT NULL CHECK (length(checksum) = 32),
    data     BLOB NOT NULL,
    UNIQUE (job_id, name)
) STRICT;
