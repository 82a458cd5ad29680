-- How often missions drove each way of a map, and failed on it.
CREATE TABLE way_drives (
  map TEXT NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
  from_place TEXT NOT NULL,
  to_place TEXT NOT NULL,
  driven INTEGER NOT NULL,
  failed INTEGER NOT NULL,
  last_driven_us INTEGER NOT NULL,  -- 0: never
  last_failed_us INTEGER NOT NULL,
  PRIMARY KEY (map, from_place, to_place)
) STRICT, WITHOUT ROWID;
