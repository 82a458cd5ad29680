-- What the latest build of a map left beside it: its acceptance report (HTML) and how alike all pictures are
-- (src/wire/similarity_blob.hpp), of the revision that it made.
CREATE TABLE map_builds (
  map TEXT PRIMARY KEY REFERENCES maps (id) ON DELETE CASCADE,
  revision INTEGER NOT NULL,
  report TEXT NOT NULL,  -- '': it could not be drawn
  similarity BLOB NOT NULL
) STRICT;
