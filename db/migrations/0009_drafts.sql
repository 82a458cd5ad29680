-- Edits that are tried before they count. `edits` is an array of logged edits (proto/schemas/logged_edit.schema.json), changes
-- numbered from 1; `check_*` are of the latest replay check: its job, the version that it tried, and what it found as JSON
-- (proto/schemas/replay_check.schema.json), NULL until it has ended.
CREATE TABLE drafts (
  id TEXT PRIMARY KEY,
  map TEXT NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
  name TEXT NOT NULL,
  author TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  version INTEGER NOT NULL,
  edits TEXT NOT NULL,
  check_job TEXT,
  check_version INTEGER,
  check_result TEXT
) STRICT;
CREATE INDEX drafts_of_map ON drafts (map);

-- Jobs also try drafts; `draft` names the one, '' in other jobs.
CREATE TABLE all_jobs (
  id TEXT PRIMARY KEY,
  kind TEXT NOT NULL CHECK (kind IN ('build', 'add', 'refine', 'check')),
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
  drives TEXT NOT NULL DEFAULT '[]',
  draft TEXT NOT NULL DEFAULT ''
) STRICT;
INSERT INTO all_jobs (id, kind, map, state, stage, share, error_code, error_message, error_where, created_us, skipped, notes,
                      gained, taken, tours, drives)
  SELECT id, kind, map, state, stage, share, error_code, error_message, error_where, created_us, skipped, notes, gained,
         taken, tours, drives
  FROM jobs ORDER BY rowid;
DROP TABLE jobs;
ALTER TABLE all_jobs RENAME TO jobs;
CREATE INDEX jobs_of_map ON jobs (map);
