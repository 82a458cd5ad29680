// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::db {

/// "HWRC" in SQLite's application_id field: what makes an SQLite file the recording of a mission.
inline constexpr int kRecordingApplicationId = 0x48575243;
/// user_version of the file. A released schema is never edited; a newer file is refused.
inline constexpr int kRecordingVersion = 7;
/// Version 1 has no word of joysticks, versions 1 and 2 no counts of tracked features; versions up to 3 have words
/// where later ones have the JSON of a reason. Version 5 has the legs of explorations, version 6
/// their tables of states, and pictures that were not looked at, version 7 what pictures say of a path that was taught.
inline constexpr int kOldestRecordingVersion = 1;
/// The first with the columns `tracked`, `recovered` and `lost`.
inline constexpr int kRecordingVersionOfTracks = 3;
/// The first with the table `states` and the column `looked_at`.
inline constexpr int kRecordingVersionOfStates = 6;

/// Columns in units are for people and their queries; what must come back bit for bit stands in `exact` as well (SQLite
/// keeps neither -0.0 nor NaN).
inline constexpr const char* kRecordingSchema = R"sql(
CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT;
CREATE TABLE steps (
  seq INTEGER PRIMARY KEY, now_ms INTEGER NOT NULL, sensors_ms INTEGER,
  odometry_x_m REAL, odometry_y_m REAL, odometry_theta_rad REAL, link_up INTEGER NOT NULL,
  speed_mps REAL, turn_radps REAL, state TEXT NOT NULL, reason TEXT NOT NULL, path_index INTEGER NOT NULL,
  answered INTEGER NOT NULL, docking INTEGER NOT NULL, covered INTEGER NOT NULL,
  bearing_rad REAL, turn_rad REAL, confidence REAL, parallax_rad REAL, inliers INTEGER, min_range_m REAL,
  has_sweep INTEGER NOT NULL, has_picture INTEGER NOT NULL, messages INTEGER NOT NULL, exact BLOB NOT NULL,
  rider_deflected INTEGER, rider_speed_mps REAL, rider_turn_radps REAL,
  tracked INTEGER, recovered INTEGER, lost INTEGER) STRICT;
CREATE TABLE messages (
  step INTEGER NOT NULL, position INTEGER NOT NULL, sender TEXT NOT NULL, type TEXT NOT NULL, cbor BLOB NOT NULL,
  PRIMARY KEY (step, position)) STRICT;
CREATE TABLE sweeps (step INTEGER PRIMARY KEY, taken_ms INTEGER NOT NULL, exact BLOB NOT NULL) STRICT;
CREATE TABLE pictures (
  step INTEGER PRIMARY KEY, taken_ms INTEGER NOT NULL, odometry_x_m REAL, odometry_y_m REAL, odometry_theta_rad REAL,
  recognised INTEGER NOT NULL CHECK (recognised IN (0, 1)), exact BLOB NOT NULL, bytes BLOB,
  looked_at INTEGER NOT NULL CHECK (looked_at IN (0, 1))) STRICT;
CREATE TABLE states (
  step INTEGER NOT NULL, position INTEGER NOT NULL, state TEXT NOT NULL, row TEXT NOT NULL,
  PRIMARY KEY (step, position)) STRICT;
-- What made the robot stand: the first step that does not drive, or the last one where the recording ends before it.
CREATE VIEW why_did_it_stop AS
WITH stood AS (SELECT * FROM steps WHERE seq = coalesce(
  (SELECT min(seq) FROM steps WHERE state <> 'driving'), (SELECT max(seq) FROM steps)))
SELECT seq AS step, (now_ms - (SELECT now_ms FROM steps ORDER BY seq LIMIT 1)) / 1000.0 AS after_s, state,
  CASE state WHEN 'driving' THEN coalesce((SELECT value FROM meta WHERE key = 'end'),
    '{"code":"recording_cut_off","parameters":{}}')
    ELSE reason END AS reason,
  path_index, odometry_x_m, odometry_y_m, odometry_theta_rad, link_up, min_range_m,
  (now_ms - (SELECT s.now_ms FROM messages m JOIN steps s ON s.seq = m.step WHERE m.sender = 'server'
    AND m.step <= stood.seq ORDER BY m.step DESC LIMIT 1)) / 1000.0 AS since_message_s,
  (coalesce(sensors_ms, now_ms) - (SELECT taken_ms FROM pictures WHERE step <= stood.seq
    ORDER BY step DESC LIMIT 1)) / 1000.0 AS since_picture_s,
  (coalesce(sensors_ms, now_ms) - (SELECT taken_ms FROM sweeps WHERE step <= stood.seq
    ORDER BY step DESC LIMIT 1)) / 1000.0 AS since_sweep_s,
  (now_ms - (SELECT s.now_ms FROM steps s WHERE s.answered AND s.has_picture AND s.seq <= stood.seq
    ORDER BY s.seq DESC LIMIT 1)) / 1000.0 AS since_vector_s,
  (SELECT s.confidence FROM steps s WHERE s.bearing_rad IS NOT NULL AND s.seq <= stood.seq
    ORDER BY s.seq DESC LIMIT 1) AS last_confidence
FROM stood;
)sql";

inline constexpr const char* kSelectWhyStopped =
    "SELECT step, after_s, state, reason, path_index, odometry_x_m, odometry_y_m, odometry_theta_rad, link_up, "
    "min_range_m, since_message_s, since_picture_s, since_sweep_s, since_vector_s, last_confidence "
    "FROM why_did_it_stop";

}  // namespace homeward::db
