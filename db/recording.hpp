// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/pose2.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "wire/link_messages.hpp"
#include "wire/reason.hpp"
#include "wire/state_row_json.hpp"

namespace homeward::db {

/// What a recording holds for the whole of a mission. Texts named json are the business of who records.
struct RecordingHeader {
  std::string agent;  // "homeward-agent/" and its version
  TimeUs started_us = 0;
  std::string mission;
  std::string label;              // of the destination, for people
  std::string feature_config_id;  // of the eye
  std::string camera_json;
  std::string features_json;
  std::string driving_json;
  std::string before_json;  // what the driving step remembered before the first step
};

/// One sweep of range sensors; its members are those of driving::Scan.
struct RecordedSweep {
  std::int64_t taken_ms = 0;
  double angle_min_rad = 0.0;
  double angle_step_rad = 0.0;
  double range_max_m = 0.0;
  std::vector<float> ranges_m;
  Pose2 robot_from_scan = {};
};

/// A picture that the driving step was given: the bytes of the JPEG or PNG that features were extracted from.
struct RecordedPicture {
  std::int64_t taken_ms = 0;
  Pose2 odometry;
  std::shared_ptr<const std::vector<std::uint8_t>> bytes;  // nothing: left out, the recording was full
  bool recognised = true;                                  // its features were looked for; else it was only tracked
  bool looked_at = true;  // false: the step was told that it was taken, and not what it shows; there are no bytes
};

/// What the rider's joystick said.
struct RecordedRider {
  std::int64_t said_ms = 0;
  bool deflected = false;
  double speed_mps = 0.0;
  double turn_radps = 0.0;
};

/// Where an exploration drove next, odometry's frame.
struct RecordedLeg {
  double goal_x_m = 0.0;
  double goal_y_m = 0.0;
  double within_m = 0.0;
};

/// What a picture said of a path that was taught.
struct RecordedPathSight {
  std::int64_t taken_ms = 0;
  Pose2 odometry;
  bool lost = true;
  std::int64_t arc = 0;
  std::int64_t tracked = 0;
  double confidence = 0.0;
  double steering_rad = 0.0;
  std::vector<Pose2> way;
  bool ends = false;
  bool leads_elsewhere = false;
};

struct RecordedVector {
  double bearing_rad = 0.0;
  double turn_rad = 0.0;
  double confidence = 0.0;
  double parallax_rad = 0.0;
  std::optional<double> nearness;
  std::int64_t matches = 0;
  std::int64_t inliers = 0;
};

/// What became of the features of the view homed to, from the picture before to this one.
struct RecordedTracks {
  std::int64_t tracked = 0;    // seen, the recovered ones among them
  std::int64_t recovered = 0;  // lost before
  std::int64_t lost = 0;       // known and not seen
  friend bool operator==(const RecordedTracks&, const RecordedTracks&) = default;
};

/// One driving step: all that went in and what came out. Numbers come back bit for bit.
struct RecordedStep {
  std::int64_t seq = 0;  // 1, 2, ...
  // In.
  std::int64_t now_ms = 0;
  std::optional<std::int64_t> sensors_ms;
  Pose2 odometry;
  bool link_up = false;
  std::vector<wire::ServerMessage> received;
  std::optional<RecordedSweep> sweep;
  std::optional<RecordedPicture> picture;
  std::optional<RecordedRider> rider = {};
  bool robot_link_up = true;  // as all older recordings have it
  std::optional<RecordedLeg> leg = {};
  std::optional<RecordedPathSight> path_sight = {};
  bool path_unusable = false;             // why is the outcome of the step, or its refusal
  bool exploration_over = false;          // by itself; how and why is the outcome of the step
  std::vector<wire::StateRow> rows = {};  // of an exploration's table of states, since the step before; no input
  // Out.
  double speed_mps = 0.0;
  double turn_radps = 0.0;
  wire::DriveState state = wire::DriveState::kIdle;
  std::optional<wire::Reason> reason;
  std::int64_t path_index = 0;
  bool answered = false;
  bool docking = false;
  bool covered = false;
  std::optional<RecordedVector> vector;
  std::optional<RecordedTracks> tracks = {};  // beside a vector; recordings before version 3 lack it
  std::optional<double> min_range_m;
  std::vector<wire::AgentMessage> sent;
};

/// How a recording ended. One that was cut off has no end.
struct RecordingEnd {
  bool whole = false;  // the mission ended, and every step of it is here
  std::string note;    // why it ended, for people
};

/// Writes one recording: one SQLite file (application_id "HWRC") in WAL mode. What was appended survives the end of the
/// process; of a power cut at most the last appends are lost.
class RecordingWriter {
 public:
  /// Errors: kConflict (there is such a file), kIo.
  static Result<std::unique_ptr<RecordingWriter>> create(const std::filesystem::path& file,
                                                         const RecordingHeader& header,
                                                         const std::optional<RecordedSweep>& sweep_before);
  RecordingWriter(const RecordingWriter&) = delete;
  RecordingWriter& operator=(const RecordingWriter&) = delete;
  virtual ~RecordingWriter() = default;

  /// All or nothing. Errors: kIo.
  virtual Status append(std::span<const RecordedStep> steps) = 0;
  /// The end, said once. Errors: kIo.
  virtual Status finish(const RecordingEnd& end) = 0;
  /// What the recording takes on disk by now, roughly.
  [[nodiscard]] virtual std::int64_t bytes() const = 0;

 protected:
  RecordingWriter() = default;
};

/// What made a robot stand, as the view `why_did_it_stop` of a recording says it.
struct WhyStopped {
  std::int64_t step = 0;
  double after_s = 0.0;
  std::string state;                   // "driving": the recording ends while it still drives
  std::optional<wire::Reason> reason;  // nothing where it arrived
  std::int64_t path_index = 0;
  Pose2 odometry;
  bool link_up = false;
  std::optional<double> min_range_m;
  std::optional<double> since_message_s;
  std::optional<double> since_picture_s;
  std::optional<double> since_sweep_s;
  std::optional<double> since_vector_s;
  std::optional<double> last_confidence;
};

/// Reads a recording from its first step to its last; one that is still written, or was cut off, too.
class RecordingReader {
 public:
  /// Errors: kNotFound, kCorruptFile (no SQLite file, no recording, ends early), kUnsupportedFormat (newer version),
  /// kIo. Older versions are read: what they did not know is not there.
  static Result<std::unique_ptr<RecordingReader>> open(const std::filesystem::path& file);
  RecordingReader(const RecordingReader&) = delete;
  RecordingReader& operator=(const RecordingReader&) = delete;
  virtual ~RecordingReader() = default;

  [[nodiscard]] virtual const RecordingHeader& header() const = 0;
  [[nodiscard]] virtual const std::optional<RecordedSweep>& sweep_before() const = 0;
  /// Nothing: it was cut off, or is being written.
  [[nodiscard]] virtual const std::optional<RecordingEnd>& end() const = 0;
  [[nodiscard]] virtual std::int64_t step_count() const = 0;
  /// Nothing after the last one. Errors: kCorruptFile, naming the step.
  virtual Result<std::optional<RecordedStep>> next() = 0;
  /// Nothing where there are no steps. Errors: kCorruptFile.
  virtual Result<std::optional<WhyStopped>> why_stopped() = 0;

 protected:
  RecordingReader() = default;
};

}  // namespace homeward::db
