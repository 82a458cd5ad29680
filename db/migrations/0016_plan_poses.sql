-- What the drawn plan said of the pictures of a mission: where the robot was on it by its lines, and of the place that the
-- robot believed to be at. Where it was lost there is no pose. Frame of the plan, metres and radians.
CREATE TABLE plan_poses (
  mission TEXT NOT NULL REFERENCES missions (id) ON DELETE CASCADE,
  t_us INTEGER NOT NULL,  -- when the picture was taken
  plan TEXT NOT NULL,     -- may be gone by now
  version INTEGER NOT NULL,
  x_m REAL,
  y_m REAL,
  theta_rad REAL,
  spread_m REAL,
  lost TEXT CHECK (lost IN ('searching', 'ambiguous', 'not_in_plan')),  -- NULL: it is not
  place TEXT,  -- NULL: the belief was lost
  word TEXT NOT NULL CHECK (word IN ('silent', 'possible', 'impossible')),
  lines_expected INTEGER NOT NULL,
  lines_confirmed INTEGER NOT NULL,
  PRIMARY KEY (mission, t_us)
) STRICT, WITHOUT ROWID;
