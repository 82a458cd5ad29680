// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>

#include "db/recording.hpp"
#include "db/sqlite/failure_words.hpp"
#include "db/sqlite/recording_rows.hpp"
#include "db/sqlite/recording_schema.hpp"
#include "db/sqlite/store_database.hpp"
#include "wire/reason_json.hpp"

namespace homeward::db {
namespace {

template <class Work>
Status told_as_status(const std::filesystem::path& file, Work&& work) {
  try {
    work();
    return {};
  } catch (const std::exception& failure) {
    return fail(ErrorCode::kIo, "The recording cannot be written: " + words_of(failure) + ".", file.string());
  }
}

void bind_bytes(SQLite::Statement& statement, int index, std::span<const std::uint8_t> bytes) {
  statement.bindNoCopy(index, bytes.data(), static_cast<int>(bytes.size()));
}

void put_meta(SQLite::Database& database, const char* key, const std::string& value) {
  execute(database, "INSERT OR REPLACE INTO meta(key, value) VALUES (?, ?)", std::string(key), value);
}

class SqliteRecordingWriter final : public RecordingWriter {
 public:
  /// Throws.
  SqliteRecordingWriter(const std::filesystem::path& file, const RecordingHeader& header,
                        const std::optional<RecordedSweep>& sweep_before)
      : file_(file), database_(file.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE) {
    database_.exec("PRAGMA journal_mode = WAL");
    // Of a power cut the last moments are lost, never what was there before: a robot's disk need not be waited for.
    database_.exec("PRAGMA synchronous = NORMAL");
    {
      SQLite::Transaction transaction(database_, SQLite::TransactionBehavior::IMMEDIATE);
      database_.exec("PRAGMA application_id = " + std::to_string(kRecordingApplicationId));
      database_.exec("PRAGMA user_version = " + std::to_string(kRecordingVersion));
      database_.exec(kRecordingSchema);
      put_header(header);
      if (sweep_before) put_sweep(0, *sweep_before);
      transaction.commit();
    }
    // Into the file itself, so that a copy of it alone is known for what it is.
    database_.exec("PRAGMA wal_checkpoint(TRUNCATE)");
    measure();
  }

  Status append(std::span<const RecordedStep> steps) override {
    return told_as_status(file_, [&] {
      SQLite::Transaction transaction(database_, SQLite::TransactionBehavior::IMMEDIATE);
      for (const RecordedStep& step : steps) put_step(step);
      transaction.commit();
      measure();
    });
  }

  Status finish(const RecordingEnd& end) override {
    const Status said = told_as_status(file_, [&] {
      SQLite::Transaction transaction(database_, SQLite::TransactionBehavior::IMMEDIATE);
      put_meta(database_, "whole", end.whole ? "1" : "0");
      put_meta(database_, "end", end.note);
      transaction.commit();
    });
    if (!said) return said;
    // One file without others beside it, to copy and to read where nothing can be written. Where somebody reads it at
    // this moment it stays as it is.
    database_.tryExec("PRAGMA journal_mode = DELETE");
    return {};
  }

  [[nodiscard]] std::int64_t bytes() const override { return bytes_; }

 private:
  void put_header(const RecordingHeader& header) {
    put_meta(database_, "agent", header.agent);
    put_meta(database_, "started_us", std::to_string(header.started_us));
    put_meta(database_, "mission", header.mission);
    put_meta(database_, "label", header.label);
    put_meta(database_, "feature_config_id", header.feature_config_id);
    put_meta(database_, "camera", header.camera_json);
    put_meta(database_, "features", header.features_json);
    put_meta(database_, "driving", header.driving_json);
    put_meta(database_, "before", header.before_json);
  }

  void put_sweep(std::int64_t step, const RecordedSweep& sweep) {
    const std::vector<std::uint8_t> exact = pack_sweep(sweep);
    SQLite::Statement insert = prepared(database_, "INSERT INTO sweeps VALUES (?, ?, ?)", step, sweep.taken_ms);
    bind_bytes(insert, 3, exact);
    insert.exec();
  }

  void put_picture(std::int64_t step, const RecordedPicture& picture) {
    const std::vector<std::uint8_t> exact = pack_pose(picture.odometry);
    SQLite::Statement insert =
        prepared(database_, "INSERT INTO pictures VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)", step, picture.taken_ms,
                 picture.odometry.x_m, picture.odometry.y_m, picture.odometry.theta_rad, picture.recognised);
    bind_bytes(insert, 7, exact);
    if (picture.bytes) bind_bytes(insert, 8, *picture.bytes);
    insert.bind(9, picture.looked_at ? 1 : 0);
    insert.exec();
  }

  template <class Message>
  void put_message(std::int64_t step, int position, const char* sender, const Message& message) {
    const std::vector<std::uint8_t> cbor = wire::encode(message);
    SQLite::Statement insert = prepared(database_, "INSERT INTO messages VALUES (?, ?, ?, ?, ?)", step, position,
                                        std::string(sender), std::string(message_type(message)));
    bind_bytes(insert, 5, cbor);
    insert.exec();
  }

  void put_step(const RecordedStep& step) {
    const std::vector<std::uint8_t> exact = pack_step(step);
    const auto of_vector = [&](auto member) {
      return step.vector ? std::optional((*step.vector).*member) : std::nullopt;
    };
    const auto of_rider = [&](auto member) { return step.rider ? std::optional((*step.rider).*member) : std::nullopt; };
    const auto of_tracks = [&](auto member) {
      return step.tracks ? std::optional((*step.tracks).*member) : std::nullopt;
    };
    SQLite::Statement insert = prepared(
        database_,
        "INSERT INTO steps(seq, now_ms, sensors_ms, odometry_x_m, odometry_y_m, odometry_theta_rad, link_up, "
        "speed_mps, turn_radps, state, reason, path_index, answered, docking, covered, bearing_rad, turn_rad, "
        "confidence, parallax_rad, inliers, min_range_m, has_sweep, has_picture, messages, rider_deflected, "
        "rider_speed_mps, rider_turn_radps, tracked, recovered, lost, exact) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, "
        "?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
        step.seq, step.now_ms, step.sensors_ms, step.odometry.x_m, step.odometry.y_m, step.odometry.theta_rad,
        step.link_up, step.speed_mps, step.turn_radps, std::string(wire::drive_state_name(step.state)),
        step.reason ? wire::reason_to_text(*step.reason) : std::string(), step.path_index, step.answered, step.docking,
        step.covered, of_vector(&RecordedVector::bearing_rad), of_vector(&RecordedVector::turn_rad),
        of_vector(&RecordedVector::confidence), of_vector(&RecordedVector::parallax_rad),
        of_vector(&RecordedVector::inliers), step.min_range_m, step.sweep.has_value(), step.picture.has_value(),
        step.received.size() + step.sent.size(), of_rider(&RecordedRider::deflected),
        of_rider(&RecordedRider::speed_mps), of_rider(&RecordedRider::turn_radps), of_tracks(&RecordedTracks::tracked),
        of_tracks(&RecordedTracks::recovered), of_tracks(&RecordedTracks::lost));
    bind_bytes(insert, 31, exact);
    insert.exec();
    int position = 0;
    for (const wire::ServerMessage& message : step.received) put_message(step.seq, position++, "server", message);
    for (const wire::AgentMessage& message : step.sent) put_message(step.seq, position++, "agent", message);
    int row_position = 0;
    for (const wire::StateRow& row : step.rows) {
      execute(database_, "INSERT INTO states VALUES (?, ?, ?, ?)", step.seq, row_position++,
              std::string(wire::state_name(row)), wire::state_row_to_json(row).dump());
    }
    if (step.sweep) put_sweep(step.seq, *step.sweep);
    if (step.picture) put_picture(step.seq, *step.picture);
  }

  void measure() {
    bytes_ = database_.execAndGet("PRAGMA page_count").getInt64() * database_.execAndGet("PRAGMA page_size").getInt64();
  }

  std::filesystem::path file_;
  SQLite::Database database_;
  std::int64_t bytes_ = 0;
};

}  // namespace

Result<std::unique_ptr<RecordingWriter>> RecordingWriter::create(const std::filesystem::path& file,
                                                                 const RecordingHeader& header,
                                                                 const std::optional<RecordedSweep>& sweep_before) {
  // Pictures of a home: for the eyes of its user alone. SQLite gives the files beside it the same rights.
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0 && errno == EEXIST) {
    return fail(ErrorCode::kConflict, "There is a file of this name already.", file.string());
  }
  if (descriptor < 0) {
    return fail(ErrorCode::kIo, std::string("The recording cannot be made: ") + std::strerror(errno) + ".",
                file.string());
  }
  ::close(descriptor);
  std::unique_ptr<RecordingWriter> writer;
  const Status made =
      told_as_status(file, [&] { writer = std::make_unique<SqliteRecordingWriter>(file, header, sweep_before); });
  if (!made) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    return pass_on(made);
  }
  return writer;
}

}  // namespace homeward::db
