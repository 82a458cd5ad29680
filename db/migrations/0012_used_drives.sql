-- What drives saw is kept after their map has learnt from it: drafts of the map are tried on it.
ALTER TABLE drives ADD COLUMN used INTEGER NOT NULL DEFAULT 0 CHECK (used IN (0, 1));

-- What checks found before says nothing of drives: whoever wants to know tries the draft again.
UPDATE drafts SET check_job = NULL, check_version = NULL, check_result = NULL;
