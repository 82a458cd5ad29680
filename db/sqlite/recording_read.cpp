// SPDX-License-Identifier: Apache-2.0
#include <sqlite3.h>

#include <array>
#include <charconv>
#include <fstream>
#include <string>

#include "db/recording.hpp"
#include "db/sqlite/failure_words.hpp"
#include "db/sqlite/recording_rows.hpp"
#include "db/sqlite/recording_schema.hpp"
#include "db/sqlite/store_database.hpp"
#include "wire/json_reader.hpp"
#include "wire/reason_json.hpp"

namespace homeward::db {
namespace {

namespace fs = std::filesystem;

/// What is being handled, as an error of a recording.
Error present_error(const fs::path& file) {
  try {
    throw;
  } catch (const StoreFailure& failure) {
    Error error = failure.error;
    error.where = error.where.empty() ? file.string() : file.string() + ": " + error.where;
    return error;
  } catch (const SQLite::Exception& failure) {
    const int code = failure.getErrorCode();
    const bool trouble = code == SQLITE_CANTOPEN || code == SQLITE_IOERR || code == SQLITE_BUSY || code == SQLITE_PERM;
    if (trouble) {
      return {ErrorCode::kIo, "The recording cannot be read: " + words_of(failure) + ".", file.string()};
    }
    return {ErrorCode::kCorruptFile, "The recording is damaged: " + words_of(failure) + ".", file.string()};
  } catch (const std::exception& failure) {
    return {ErrorCode::kIo, "The recording cannot be read: " + words_of(failure) + ".", file.string()};
  }
}

std::span<const std::uint8_t> blob(const SQLite::Column& column) {
  return {static_cast<const std::uint8_t*>(column.getBlob()), static_cast<std::size_t>(column.getBytes())};
}

fs::path journal_of(const fs::path& file) { return file.string() + "-wal"; }

/// A column of the reason; empty where there is none.
std::optional<wire::Reason> reason_in(const std::string& column) {
  return column.empty() ? std::nullopt : std::optional(wire::reason_from_text(column));
}

/// Before SQLite looks at it: an SQLite file, and as long as it says it is.
void check_file(const fs::path& file) {
  std::error_code error;
  if (!fs::exists(file, error)) refuse(ErrorCode::kNotFound, "There is no recording of this name.");
  if (!fs::is_regular_file(file, error)) {
    refuse(ErrorCode::kInvalidInput, "This is not a plain file and so not a recording.");
  }
  std::array<char, 100> start{};
  std::ifstream stream(file, std::ios::binary);
  if (!stream) refuse(ErrorCode::kIo, "The recording may not be read.");
  stream.read(start.data(), start.size());
  if (std::string_view(start.data(), 16) != std::string_view("SQLite format 3\0", 16)) {
    refuse(ErrorCode::kCorruptFile, "This file is not a recording of Homeward.");
  }
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint64_t value = 0;
    for (std::size_t i = at; i < at + size; ++i) value = (value << 8) | static_cast<std::uint8_t>(start[i]);
    return value;
  };
  const std::uint64_t page_bytes = number(16, 2) == 1 ? 65536 : number(16, 2);
  const auto bytes = fs::file_size(file, error);
  // Where there is a journal, the pages that lack here may lie there.
  const bool journal = fs::exists(journal_of(file), error) && fs::file_size(journal_of(file), error) > 0;
  if (stream.gcount() < 100 || (!journal && !error && bytes < page_bytes * number(28, 4))) {
    refuse(ErrorCode::kCorruptFile, "The recording ends early: copy it again.");
  }
}

class SqliteRecordingReader final : public RecordingReader {
 public:
  /// Throws.
  explicit SqliteRecordingReader(const fs::path& file)
      : file_(file), database_(file.string(), SQLite::OPEN_READONLY, kBusyTimeout_ms) {
    database_.exec("PRAGMA trusted_schema = OFF");
    sqlite3_limit(database_.getHandle(), SQLITE_LIMIT_LENGTH, kMostBytesOfRow);
    database_.exec("BEGIN");  // all that is read is of one moment, while it is still written too
    check_kind_and_version();
    read_header();
    sweep_before_ = sweep_of(0);
    SQLite::Statement count(database_, "SELECT count(*) FROM steps");
    count.executeStep();
    step_count_ = integer(count, 0);
    const std::string tracks = version_ < kRecordingVersionOfTracks ? "NULL, NULL, NULL" : "tracked, recovered, lost";
    steps_.emplace(database_,
                   "SELECT seq, now_ms, sensors_ms, link_up, state, reason, path_index, answered, docking, covered, "
                   "has_sweep, has_picture, messages, exact, " +
                       tracks + " FROM steps ORDER BY seq");
    messages_.emplace(database_, "SELECT sender, cbor FROM messages WHERE step = ? ORDER BY position");
    if (has_states()) states_.emplace(database_, "SELECT row FROM states WHERE step = ? ORDER BY position");
  }

  [[nodiscard]] const RecordingHeader& header() const override { return header_; }
  [[nodiscard]] const std::optional<RecordedSweep>& sweep_before() const override { return sweep_before_; }
  [[nodiscard]] const std::optional<RecordingEnd>& end() const override { return end_; }
  [[nodiscard]] std::int64_t step_count() const override { return step_count_; }

  Result<std::optional<RecordedStep>> next() override {
    try {
      if (!steps_->executeStep()) return std::optional<RecordedStep>();
      RecordedStep step = read_step();
      if (step.seq != ++last_seq_) refuse_step(step.seq, "the order of its steps");
      return std::optional(std::move(step));
    } catch (...) {
      return tl::unexpected<Error>(present_error(file_));
    }
  }

  Result<std::optional<WhyStopped>> why_stopped() override {
    try {
      SQLite::Statement select(database_, kSelectWhyStopped);
      if (!select.executeStep()) return std::optional<WhyStopped>();
      const auto number = [&](int column) {
        return select.isColumnNull(column) ? std::nullopt : std::optional(real(select, column));
      };
      WhyStopped why;
      why.step = integer(select, 0);
      why.after_s = real(select, 1);
      why.state = text(select, 2);
      why.reason = reason_in(text(select, 3));
      why.path_index = integer(select, 4);
      why.odometry = {real(select, 5), real(select, 6), real(select, 7)};
      why.link_up = integer(select, 8) != 0;
      why.min_range_m = number(9);
      why.since_message_s = number(10);
      why.since_picture_s = number(11);
      why.since_sweep_s = number(12);
      why.since_vector_s = number(13);
      why.last_confidence = number(14);
      return std::optional(why);
    } catch (...) {
      return tl::unexpected<Error>(present_error(file_));
    }
  }

 private:
  static constexpr int kBusyTimeout_ms = 2000;
  static constexpr int kMostBytesOfRow = 64 << 20;

  [[nodiscard]] bool has_states() const { return version_ >= kRecordingVersionOfStates; }

  void check_kind_and_version() {
    if (database_.execAndGet("PRAGMA application_id").getInt() != kRecordingApplicationId) {
      refuse(ErrorCode::kCorruptFile, "This SQLite file is not a recording of Homeward.");
    }
    version_ = database_.execAndGet("PRAGMA user_version").getInt();
    if (version_ < kOldestRecordingVersion || version_ > kRecordingVersion) {
      refuse(ErrorCode::kUnsupportedFormat,
             "The recording has version " + std::to_string(version_) + "; this program reads versions " +
                 std::to_string(kOldestRecordingVersion) + " to " + std::to_string(kRecordingVersion) +
                 ". A newer Homeward wrote it: read it with that one.");
    }
  }

  std::optional<std::string> meta(const char* key) {
    SQLite::Statement select = prepared(database_, "SELECT value FROM meta WHERE key = ?", std::string(key));
    return select.executeStep() ? std::optional(text(select, 0)) : std::nullopt;
  }

  std::string needed_meta(const char* key) {
    auto value = meta(key);
    if (!value) refuse(ErrorCode::kCorruptFile, std::string("The recording lacks the entry '") + key + "'.", "meta");
    return std::move(*value);
  }

  void read_header() {
    header_.agent = needed_meta("agent");
    const std::string started = needed_meta("started_us");
    std::from_chars(started.data(), started.data() + started.size(), header_.started_us);
    header_.mission = needed_meta("mission");
    header_.label = needed_meta("label");
    header_.feature_config_id = needed_meta("feature_config_id");
    header_.camera_json = needed_meta("camera");
    header_.features_json = needed_meta("features");
    header_.driving_json = needed_meta("driving");
    header_.before_json = needed_meta("before");
    if (const auto whole = meta("whole")) end_ = RecordingEnd{*whole == "1", needed_meta("end")};
  }

  [[noreturn]] static void refuse_step(std::int64_t step, const std::string& what) {
    refuse(ErrorCode::kCorruptFile, "The recording is damaged: " + what + " cannot be understood.",
           "step " + std::to_string(step));
  }

  [[noreturn]] static void refuse_lack(std::int64_t step, const std::string& what) {
    refuse(ErrorCode::kCorruptFile, "The recording lacks a " + what + " that this step was given.",
           "step " + std::to_string(step));
  }

  std::optional<RecordedSweep> sweep_of(std::int64_t step) {
    SQLite::Statement select = prepared(database_, "SELECT taken_ms, exact FROM sweeps WHERE step = ?", step);
    if (!select.executeStep()) return std::nullopt;
    RecordedSweep sweep;
    sweep.taken_ms = integer(select, 0);
    if (!unpack_sweep(blob(select.getColumn(1)), sweep)) refuse_step(step, "its sweep");
    return sweep;
  }

  std::optional<RecordedPicture> picture_of(std::int64_t step) {
    SQLite::Statement select =
        prepared(database_,
                 has_states() ? "SELECT taken_ms, exact, bytes, recognised, looked_at FROM pictures WHERE step = ?"
                              : "SELECT taken_ms, exact, bytes, recognised, 1 FROM pictures WHERE step = ?",
                 step);
    if (!select.executeStep()) return std::nullopt;
    RecordedPicture picture;
    picture.taken_ms = integer(select, 0);
    if (!unpack_pose(blob(select.getColumn(1)), picture.odometry)) refuse_step(step, "its picture's odometry");
    picture.recognised = integer(select, 3) != 0;
    picture.looked_at = integer(select, 4) != 0;
    if (!select.isColumnNull(2)) {
      const SQLite::Column column = select.getColumn(2);
      const auto bytes = blob(column);
      picture.bytes = std::make_shared<const std::vector<std::uint8_t>>(bytes.begin(), bytes.end());
    }
    return picture;
  }

  void read_messages(RecordedStep& step) {
    messages_->reset();
    messages_->bind(1, step.seq);
    while (messages_->executeStep()) {
      const SQLite::Column cbor = messages_->getColumn(1);
      const std::string sender = text(*messages_, 0);
      if (sender == "server") {
        auto message = wire::decode_server_message(blob(cbor));
        if (!message) refuse_step(step.seq, "a message (" + message.error().message + ")");
        step.received.push_back(std::move(*message));
      } else if (sender == "agent") {
        auto message = wire::decode_agent_message(blob(cbor));
        if (!message) refuse_step(step.seq, "a message (" + message.error().message + ")");
        step.sent.push_back(std::move(*message));
      } else {
        refuse_step(step.seq, "who sent a message");
      }
    }
  }

  void read_rows(RecordedStep& step) {
    if (!states_) return;
    constexpr std::size_t kMostBytesOfText = 1 << 20;
    states_->reset();
    states_->bind(1, step.seq);
    while (states_->executeStep()) {
      const auto value = wire::parse_json(text(*states_, 0), "row", kMostBytesOfText);
      auto row = value ? wire::state_row_from_json(*value, "row") : pass_on(value);
      if (!row) refuse_step(step.seq, "a row of its table of states (" + row.error().message + ")");
      step.rows.push_back(std::move(*row));
    }
  }

  static wire::DriveState state_named(std::int64_t step, const std::string& name) {
    using wire::DriveState;
    for (const DriveState state :
         {DriveState::kIdle, DriveState::kDriving, DriveState::kArrived, DriveState::kStopped, DriveState::kFailed}) {
      if (wire::drive_state_name(state) == name) return state;
    }
    refuse_step(step, "its state");
  }

  RecordedStep read_step() {
    SQLite::Statement& row = *steps_;
    RecordedStep step;
    step.seq = integer(row, 0);
    step.now_ms = integer(row, 1);
    step.sensors_ms = optional_integer(row, 2);
    step.link_up = integer(row, 3) != 0;
    step.state = state_named(step.seq, text(row, 4));
    step.reason = reason_in(text(row, 5));
    step.path_index = integer(row, 6);
    step.answered = integer(row, 7) != 0;
    step.docking = integer(row, 8) != 0;
    step.covered = integer(row, 9) != 0;
    if (!unpack_step(blob(row.getColumn(13)), step)) refuse_step(step.seq, "what is exact of it");
    const auto tracked = optional_integer(row, 14);
    const auto recovered = optional_integer(row, 15);
    const auto lost = optional_integer(row, 16);
    if (tracked.has_value() != recovered.has_value() || tracked.has_value() != lost.has_value()) {
      refuse_step(step.seq, "its counts of tracked features");
    }
    if (tracked) step.tracks = RecordedTracks{*tracked, *recovered, *lost};
    read_messages(step);
    read_rows(step);
    step.sweep = sweep_of(step.seq);
    step.picture = picture_of(step.seq);
    if (integer(row, 10) != 0 && !step.sweep) refuse_lack(step.seq, "sweep");
    if (integer(row, 11) != 0 && !step.picture) refuse_lack(step.seq, "picture");
    const auto messages = static_cast<std::int64_t>(step.received.size() + step.sent.size());
    if (integer(row, 12) != messages) refuse_lack(step.seq, "message");
    return step;
  }

  fs::path file_;
  SQLite::Database database_;
  int version_ = 0;
  RecordingHeader header_;
  std::optional<RecordedSweep> sweep_before_;
  std::optional<RecordingEnd> end_;
  std::int64_t step_count_ = 0;
  std::int64_t last_seq_ = 0;
  std::optional<SQLite::Statement> steps_;
  std::optional<SQLite::Statement> messages_;
  std::optional<SQLite::Statement> states_;  // nothing: the recording is older than these
};

}  // namespace

Result<std::unique_ptr<RecordingReader>> RecordingReader::open(const std::filesystem::path& file) {
  try {
    check_file(file);
    return std::make_unique<SqliteRecordingReader>(file);
  } catch (...) {
    return tl::unexpected<Error>(present_error(file));
  }
}

}  // namespace homeward::db
