-- Maps that are taught as a path (teach and repeat), by one tour of an ordinary camera.
ALTER TABLE maps ADD COLUMN path INTEGER NOT NULL DEFAULT 0 CHECK (path IN (0, 1));
