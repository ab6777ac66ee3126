-- Terrains, and the jobs and studies that name them.
CREATE TABLE terrains (
    sequence    BIGINT GENERATED ALWAYS AS IDENTITY PRIMARY KEY,
    hash        TEXT   NOT NULL UNIQUE CHECK (length(hash) = 64),
    created_ms  BIGINT NOT NULL,
    bytes       BIGINT NOT NULL CHECK (bytes > 0),
    description TEXT   NOT NULL,
    submitter   TEXT
);

CREATE TABLE terrain_pieces (
    terrain BIGINT NOT NULL REFERENCES terrains (sequence) ON DELETE CASCADE,
    piece   BIGINT NOT NULL CHECK (piece >= 0),
    data    BYTEA  NOT NULL,
    PRIMARY KEY (terrain, piece)
);

CREATE TABLE job_terrains (
    job_id  UUID   NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    terrain BIGINT NOT NULL REFERENCES terrains (sequence),
    PRIMARY KEY (job_id, terrain)
);

CREATE INDEX job_terrains_by_terrain ON job_terrains (terrain);

CREATE TABLE study_terrains (
    study   BIGINT NOT NULL REFERENCES studies (sequence) ON DELETE CASCADE,
    terrain BIGINT NOT NULL REFERENCES terrains (sequence),
    PRIMARY KEY (study, terrain)
);

CREATE INDEX study_terrains_by_terrain ON study_terrains (terrain);
