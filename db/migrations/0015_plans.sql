-- Drawn plans of buildings. Each upload is a version of its plan, with its file as it came.
CREATE TABLE plans (
  id TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  created_us INTEGER NOT NULL
) STRICT;
CREATE TABLE plan_versions (
  plan TEXT NOT NULL REFERENCES plans (id) ON DELETE CASCADE,
  version INTEGER NOT NULL CHECK (version >= 1),
  format TEXT NOT NULL,
  created_us INTEGER NOT NULL,
  author TEXT NOT NULL,
  metres_per_unit REAL,  -- NULL: 1, or as the file itself says
  up TEXT CHECK (up IN ('y', 'z')),  -- NULL: as is usual in its format
  wall_height_m REAL NOT NULL,
  line_count INTEGER NOT NULL,
  triangle_count INTEGER NOT NULL,
  min_x_m REAL NOT NULL,
  min_y_m REAL NOT NULL,
  min_z_m REAL NOT NULL,
  max_x_m REAL NOT NULL,
  max_y_m REAL NOT NULL,
  max_z_m REAL NOT NULL,
  contents BLOB NOT NULL,
  PRIMARY KEY (plan, version)
) STRICT;

-- Which plan a map is tied to. `pins` is a JSON array of objects with image, x_m, y_m and theta_rad: where pictures of the
-- map were taken, as a person says. A plan that a map is tied to is not removed.
CREATE TABLE map_plans (
  map TEXT PRIMARY KEY REFERENCES maps (id) ON DELETE CASCADE,
  plan TEXT NOT NULL,
  version INTEGER NOT NULL,
  tied_us INTEGER NOT NULL,
  author TEXT NOT NULL,
  pins TEXT NOT NULL,
  FOREIGN KEY (plan, version) REFERENCES plan_versions (plan, version)
) STRICT;
CREATE INDEX maps_of_plan ON map_plans (plan, version);
