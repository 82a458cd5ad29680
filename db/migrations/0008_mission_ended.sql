-- When a mission ended; NULL: it has not, or nobody knows when.
ALTER TABLE missions ADD COLUMN ended_us INTEGER;
