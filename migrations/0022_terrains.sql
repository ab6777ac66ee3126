-- Terrains: files of elevations as they were uploaded, named by the SHA-256 of their bytes.
CREATE TABLE terrains (
    sequence    INTEGER PRIMARY KEY AUTOINCREMENT,
    hash        TEXT    NOT NULL UNIQUE CHECK (length(hash) = 64),
    created_ms  INTEGER NOT NULL,
    bytes       INTEGER NOT NULL CHECK (bytes > 0),
    -- What was read of the file at its arrival, as JSON.
    description TEXT    NOT NULL,
    -- Name of the access token it came with first; null where none is asked for.
    submitter   TEXT
) STRICT;

-- The file, cut into pieces of 1 MiB.
CREATE TABLE terrain_pieces (
    terrain INTEGER NOT NULL REFERENCES terrains (sequence) ON DELETE CASCADE,
    piece   INTEGER NOT NULL CHECK (piece >= 0),
    data    BLOB    NOT NULL,
    PRIMARY KEY (terrain, piece)
) STRICT;

-- Terrains that jobs and studies name: they can't be removed before these.
CREATE TABLE job_terrains (
    job_id  TEXT    NOT NULL REFERENCES jobs (id) ON DELETE CASCADE,
    terrain INTEGER NOT NULL REFERENCES terrains (sequence),
    PRIMARY KEY (job_id, terrain)
) STRICT, WITHOUT ROWID;

CREATE INDEX job_terrains_by_terrain ON job_terrains (terrain);

CREATE TABLE study_terrains (
    study   INTEGER NOT NULL REFERENCES studies (sequence) ON DELETE CASCADE,
    terrain INTEGER NOT NULL REFERENCES terrains (sequence),
    PRIMARY KEY (study, terrain)
) STRICT, WITHOUT ROWID;

CREATE INDEX study_terrains_by_terrain ON study_terrains (terrain);
