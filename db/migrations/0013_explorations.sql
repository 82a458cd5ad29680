-- What a mission is: a drive to a place of a map, or an exploration, which has neither map nor place (empty).
ALTER TABLE missions ADD COLUMN kind TEXT NOT NULL DEFAULT 'drive' CHECK (kind IN ('drive', 'explore'));
-- The exploration that it is a part of; NULL: a drive.
ALTER TABLE missions ADD COLUMN exploration TEXT;
