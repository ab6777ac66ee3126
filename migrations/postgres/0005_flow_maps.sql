-- Maps of what the flow of a job did to its terrain, as GeoTIFF.
CREATE TABLE flow_maps (
    job_id   UUID  NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    name     TEXT  NOT NULL CHECK (length(name) BETWEEN 1 AND 64),
    checksum BYTEA NOT NULL CHECK (length(checksum) = 32),
    data     BYTEA NOT NULL,
    PRIMARY KEY (job_id, name)
);
ALTER TABLE flow_maps ALTER data SET STORAGE EXTERNAL;
