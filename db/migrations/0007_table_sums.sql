-- What each table holds in all, so that damage is noticed: the sum of its rows' hashes (db/sqlite/table_sums.hpp).
-- The program keeps it with every change; a change made with another program counts as damage.
CREATE TABLE table_sums (
  name TEXT PRIMARY KEY,
  row_count INTEGER NOT NULL,
  sum BLOB NOT NULL
) STRICT;

-- Which program uploads a tour: the robot of its token, or the token itself; NULL: a person.
ALTER TABLE tours ADD COLUMN uploader TEXT;

-- A key belongs to one request: the hash of its body. Empty: not known, from before.
ALTER TABLE answers ADD COLUMN body_hash TEXT NOT NULL DEFAULT '';

-- Which revision the map file is of: edits of people since then are in map_edits, as a map file without images,
-- appearances and thumbnails (db/sqlite/map_graph_part.hpp).
ALTER TABLE maps ADD COLUMN file_revision INTEGER NOT NULL DEFAULT 0;
UPDATE maps SET file_revision = revision;
CREATE TABLE map_edits (
  map TEXT PRIMARY KEY REFERENCES maps (id) ON DELETE CASCADE,
  contents BLOB NOT NULL
) STRICT;
