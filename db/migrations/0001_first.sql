-- The server's first database. Times are microseconds since the Unix epoch; roles and states are their wire names.

CREATE TABLE users (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL UNIQUE COLLATE NOCASE CHECK (name <> ''),
  role TEXT NOT NULL CHECK (role IN ('viewer', 'rider', 'carer', 'installer', 'admin')),
  password_hash TEXT NOT NULL,
  created_us INTEGER NOT NULL
) STRICT;

CREATE TABLE sessions (
  hash TEXT PRIMARY KEY,
  user TEXT NOT NULL REFERENCES users (id) ON DELETE CASCADE,
  created_us INTEGER NOT NULL,
  expires_us INTEGER NOT NULL
) STRICT;
CREATE INDEX sessions_of_user ON sessions (user);

-- Single values; "setup_hash" is the hash of the one-time set-up secret.
CREATE TABLE settings (key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;

CREATE TABLE tours (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  camera TEXT NOT NULL,
  complete INTEGER NOT NULL DEFAULT 0 CHECK (complete IN (0, 1)),
  created_us INTEGER NOT NULL
) STRICT;

-- The bytes of a picture are in the file tours/<tour>/<number>.<type>, flushed to disk before its row appears here.
CREATE TABLE tour_images (
  tour TEXT NOT NULL REFERENCES tours (id) ON DELETE CASCADE,
  number INTEGER NOT NULL CHECK (number >= 0),
  file TEXT NOT NULL,
  type TEXT NOT NULL CHECK (type IN ('jpg', 'png')),
  t_us INTEGER,
  odometry_x_m REAL,
  odometry_y_m REAL,
  odometry_theta_rad REAL,
  sha256 TEXT NOT NULL,
  size INTEGER NOT NULL,
  PRIMARY KEY (tour, number),
  UNIQUE (tour, file)
) STRICT, WITHOUT ROWID;

CREATE TABLE tour_marks (
  tour TEXT NOT NULL REFERENCES tours (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  image TEXT NOT NULL,
  label TEXT NOT NULL,
  PRIMARY KEY (tour, position)
) STRICT, WITHOUT ROWID;

-- The contents are the map file maps/<id>.r<revision>.homeward; revision 0 has none.
CREATE TABLE maps (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('building', 'ready', 'failed')),
  revision INTEGER NOT NULL DEFAULT 0 CHECK (revision >= 0),
  places INTEGER NOT NULL DEFAULT 0,
  images INTEGER NOT NULL DEFAULT 0,
  feature_config_id TEXT,
  created_us INTEGER NOT NULL
) STRICT;

CREATE TABLE map_tours (
  map TEXT NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
  position INTEGER NOT NULL,
  tour TEXT NOT NULL REFERENCES tours (id),
  PRIMARY KEY (map, position)
) STRICT, WITHOUT ROWID;
CREATE INDEX maps_of_tour ON map_tours (tour);

CREATE TABLE jobs (
  id TEXT PRIMARY KEY,
  kind TEXT NOT NULL,
  map TEXT NOT NULL REFERENCES maps (id) ON DELETE CASCADE,
  state TEXT NOT NULL CHECK (state IN ('queued', 'running', 'done', 'failed', 'cancelled')),
  stage TEXT NOT NULL,
  share REAL NOT NULL,
  error_code TEXT,
  error_message TEXT,
  error_where TEXT,
  created_us INTEGER NOT NULL
) STRICT;
CREATE INDEX jobs_of_map ON jobs (map);

CREATE TABLE robots (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL UNIQUE COLLATE NOCASE CHECK (name <> ''),
  map TEXT REFERENCES maps (id) ON DELETE SET NULL,
  epoch INTEGER NOT NULL DEFAULT 0,
  created_us INTEGER NOT NULL
) STRICT;
CREATE INDEX robots_on_map ON robots (map);

CREATE TABLE tokens (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  hash TEXT NOT NULL UNIQUE,
  role TEXT NOT NULL CHECK (role IN ('viewer', 'rider', 'carer', 'installer', 'admin', 'robot')),
  robot TEXT REFERENCES robots (id) ON DELETE CASCADE,
  created_us INTEGER NOT NULL,
  expires_us INTEGER
) STRICT;
CREATE INDEX tokens_of_robot ON tokens (robot);

-- `map` may name a map that is gone: what was driven stays on record. `path` is a JSON array of place ids.
CREATE TABLE missions (
  id TEXT PRIMARY KEY,
  robot TEXT NOT NULL REFERENCES robots (id) ON DELETE CASCADE,
  map TEXT NOT NULL,
  revision INTEGER NOT NULL,
  destination TEXT,
  place TEXT NOT NULL,
  state TEXT NOT NULL CHECK (state IN ('accepted', 'driving', 'arrived', 'refused', 'stopped', 'failed')),
  reason TEXT,
  epoch INTEGER NOT NULL,
  seq INTEGER NOT NULL,
  path TEXT NOT NULL,
  path_index INTEGER NOT NULL,
  created_us INTEGER NOT NULL,
  by TEXT NOT NULL
) STRICT;
CREATE INDEX missions_of_robot ON missions (robot, created_us);

CREATE TABLE answers (
  caller TEXT NOT NULL,
  route TEXT NOT NULL,
  key TEXT NOT NULL,
  status INTEGER NOT NULL,
  body BLOB NOT NULL,
  created_us INTEGER NOT NULL,
  PRIMARY KEY (caller, route, key)
) STRICT;
CREATE INDEX answers_by_age ON answers (created_us);
