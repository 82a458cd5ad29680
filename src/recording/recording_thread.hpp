// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include "db/recording.hpp"

namespace homeward::recording {

struct RecordingOptions {
  std::filesystem::path folder;
  std::int64_t limit_bytes = std::int64_t{512} << 20;          // of one recording
  std::int64_t folder_limit_bytes = std::int64_t{4096} << 20;  // of all in the folder; the oldest make room
  std::string name;            // of the next recording, without extension; empty: from its time and mission
  bool wait_for_disk = false;  // simulated time has it, a robot does not
  std::int64_t most_waiting_bytes = std::int64_t{64} << 20;  // for the disk, in memory
};

/// Writes recordings to disk in the background. What waits is bounded: a disk that is too slow, or full, ends the
/// recording with a note and nothing else.
class RecordingThread {
 public:
  RecordingThread(RecordingOptions options, std::function<void(const std::string&)> log);
  /// Writes what still waits.
  ~RecordingThread();
  RecordingThread(const RecordingThread&) = delete;
  RecordingThread& operator=(const RecordingThread&) = delete;

  void begin(db::RecordingHeader header, std::optional<db::RecordedSweep> sweep_before);
  /// False when the recording is over, because the disk is too slow or refuses it.
  bool append(db::RecordedStep step);
  void finish(db::RecordingEnd end);

 private:
  struct Begin {
    int number = 0;  // of the recording: 1, 2, ...
    db::RecordingHeader header;
    std::optional<db::RecordedSweep> sweep_before;
  };
  using Item = std::variant<Begin, db::RecordedStep, db::RecordingEnd>;

  void push(Item item, std::int64_t bytes);
  void run();
  void write(std::deque<Item> items);
  void open(const Begin& begin);
  void write_steps(std::vector<db::RecordedStep>& steps);
  void close(db::RecordingEnd end);
  void give_up(const Error& error);

  RecordingOptions options_;
  std::function<void(const std::string&)> log_;
  // Of the thread alone.
  std::unique_ptr<db::RecordingWriter> writer_;
  std::filesystem::path file_;
  int number_ = 0;                   // of the recording that is written
  std::int64_t pictures_until_ = 0;  // the last step whose picture is there, once the recording is full
  bool full_ = false;
  // Shared.
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Item> waiting_;
  std::int64_t waiting_bytes_ = 0;
  int begun_ = 0;   // the number of the newest recording
  int broken_ = 0;  // that of the last one that could not be written
  bool ending_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace homeward::recording
