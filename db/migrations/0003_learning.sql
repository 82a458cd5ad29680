-- What becomes of what drives saw, for each map.
ALTER TABLE maps ADD COLUMN refine TEXT NOT NULL DEFAULT 'ask' CHECK (refine IN ('off', 'ask', 'auto'));

-- What missions that arrived saw and their map has not made use of yet. A sight without a place parts those beside it.
CREATE TABLE drives (
  mission TEXT PRIMARY KEY,
  map TEXT NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
  feature_config_id TEXT NOT NULL,
  created_us INTEGER NOT NULL
) STRICT;
CREATE INDEX drives_of_map ON drives (map);

CREATE TABLE drive_sights (
  drive TEXT NOT NULL REFERENCES drives (mission) ON DELETE CASCADE,
  number INTEGER NOT NULL,
  place TEXT NOT NULL,
  appearance BLOB NOT NULL,
  PRIMARY KEY (drive, number)
) STRICT, WITHOUT ROWID;

-- Jobs of more kinds than builds: `gained` counts new appearances; `taken` says that a person (or the map's setting) wants
-- what the job offers; `tours` are those that it adds or refines by, `drives` those that its offer comes from (JSON arrays).
CREATE TABLE all_jobs (
  id TEXT PRIMARY KEY,
  kind TEXT NOT NULL CHECK (kind IN ('build', 'add', 'refine')),
  map TEXT NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
  state TEXT NOT NULL CHECK (state IN ('queued', 'running', 'offered', 'done', 'failed', 'cancelled')),
  stage TEXT NOT NULL,
  share REAL NOT NULL,
  error_code TEXT,
  error_message TEXT,
  error_where TEXT,
  created_us INTEGER NOT NULL,
  skipped INTEGER NOT NULL DEFAULT 0,
  notes TEXT NOT NULL DEFAULT '[]',
  gained INTEGER NOT NULL DEFAULT 0,
  taken INTEGER NOT NULL DEFAULT 0 CHECK (taken IN (0, 1)),
  tours TEXT NOT NULL DEFAULT '[]',
  drives TEXT NOT NULL DEFAULT '[]'
) STRICT;
INSERT INTO all_jobs (id, kind, map, state, stage, share, error_code, error_message, error_where, created_us, skipped, notes)
  SELECT id, kind, map, state, stage, share, error_code, error_message, error_where, created_us, skipped, notes
  FROM jobs ORDER BY rowid;
DROP TABLE jobs;
ALTER TABLE all_jobs RENAME TO jobs;
CREATE INDEX jobs_of_map ON jobs (map);
