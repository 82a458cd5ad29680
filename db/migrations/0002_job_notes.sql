-- What a finished build has to tell: how many pictures it did without, and notes (a JSON array of sentences).
ALTER TABLE jobs ADD COLUMN skipped INTEGER NOT NULL DEFAULT 0;
ALTER TABLE jobs ADD COLUMN notes TEXT NOT NULL DEFAULT '[]';
