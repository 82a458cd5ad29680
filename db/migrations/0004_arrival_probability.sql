-- What the robot stated of being within half a metre of its destination; NULL: it did not, or nobody asked it then.
ALTER TABLE missions ADD COLUMN arrival_probability REAL CHECK (arrival_probability BETWEEN 0 AND 1);
