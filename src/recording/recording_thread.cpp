// SPDX-License-Identifier: Apache-2.0
#include "recording/recording_thread.hpp"

#include <chrono>
#include <utility>

#include "recording/recording_folder.hpp"

namespace homeward::recording {
namespace {

constexpr auto kGather = std::chrono::milliseconds(200);  // one transaction for what comes in so long
constexpr double kPicturesShare = 0.9;  // of a recording's limit; the rest is for steps without pictures

std::int64_t size_of(const db::RecordedStep& step) {
  std::size_t bytes = 500;
  if (step.picture && step.picture->bytes) bytes += step.picture->bytes->size();
  if (step.sweep) bytes += step.sweep->ranges_m.size() * sizeof(float);
  constexpr std::size_t kOfRow = 300;
  bytes += kOfRow * step.rows.size();
  for (const wire::ServerMessage& message : step.received) {
    bytes += 100;
    const auto* order = std::get_if<wire::MissionOrder>(&message);
    if (order == nullptr) continue;
    bytes += order->final_appearance.size();
    for (const wire::PathPlace& place : order->path) bytes += place.appearance.size();
  }
  return static_cast<std::int64_t>(bytes);
}

}  // namespace

RecordingThread::RecordingThread(RecordingOptions options, std::function<void(const std::string&)> log)
    : options_(std::move(options)), log_(std::move(log)), thread_([this] { run(); }) {}

RecordingThread::~RecordingThread() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void RecordingThread::push(Item item, std::int64_t bytes) {
  waiting_.push_back(std::move(item));
  waiting_bytes_ += bytes;
}

void RecordingThread::begin(db::RecordingHeader header, std::optional<db::RecordedSweep> sweep_before) {
  const std::lock_guard lock(mutex_);
  push(Begin{++begun_, std::move(header), std::move(sweep_before)}, 0);
}

bool RecordingThread::append(db::RecordedStep step) {
  const std::int64_t bytes = size_of(step);
  std::unique_lock lock(mutex_);
  if (options_.wait_for_disk) {
    changed_.wait(lock, [&] { return broken_ == begun_ || waiting_bytes_ < options_.most_waiting_bytes; });
  }
  if (broken_ == begun_) return false;
  if (waiting_bytes_ + bytes > options_.most_waiting_bytes && !options_.wait_for_disk) {
    push(db::RecordingEnd{false, "The disk was too slow: the recording was given up before the mission ended."}, 0);
    return false;
  }
  push(std::move(step), bytes);
  if (waiting_bytes_ > options_.most_waiting_bytes / 2) changed_.notify_all();
  return true;
}

void RecordingThread::finish(db::RecordingEnd end) {
  {
    const std::lock_guard lock(mutex_);
    push(std::move(end), 0);
  }
  changed_.notify_all();
}

void RecordingThread::run() {
  bool ended = false;
  while (!ended) {
    std::deque<Item> items;
    {
      std::unique_lock lock(mutex_);
      changed_.wait_for(lock, kGather, [&] {
        const bool closing = !waiting_.empty() && std::holds_alternative<db::RecordingEnd>(waiting_.back());
        return ending_ || closing || waiting_bytes_ > options_.most_waiting_bytes / 2;
      });
      ended = ending_;
      items = std::exchange(waiting_, {});
    }
    // What is being written still counts as waiting, so that memory stays bounded.
    std::int64_t bytes = 0;
    for (const Item& item : items) {
      if (const auto* step = std::get_if<db::RecordedStep>(&item)) bytes += size_of(*step);
    }
    write(std::move(items));
    const std::lock_guard lock(mutex_);
    waiting_bytes_ -= bytes;
    changed_.notify_all();
  }
  if (writer_) close({false, "The program ended."});
}

void RecordingThread::write(std::deque<Item> items) {
  std::vector<db::RecordedStep> steps;
  for (Item& item : items) {
    if (auto* step = std::get_if<db::RecordedStep>(&item)) {
      steps.push_back(std::move(*step));
      continue;
    }
    write_steps(steps);
    if (const auto* begin = std::get_if<Begin>(&item)) open(*begin);
    if (const auto* end = std::get_if<db::RecordingEnd>(&item)) close(*end);
  }
  write_steps(steps);
}

void RecordingThread::open(const Begin& begin) {
  if (writer_) close({false, "Another recording was begun."});
  number_ = begin.number;
  full_ = false;
  make_room(options_.folder, options_.folder_limit_bytes - options_.limit_bytes, log_);
  file_ = new_recording_file(options_.folder, options_.name, begin.header);
  auto writer = db::RecordingWriter::create(file_, begin.header, begin.sweep_before);
  if (!writer) return give_up(writer.error());
  writer_ = std::move(*writer);
}

void RecordingThread::write_steps(std::vector<db::RecordedStep>& steps) {
  if (!writer_) steps.clear();
  if (steps.empty()) return;
  const auto pictures_limit = static_cast<std::int64_t>(kPicturesShare * static_cast<double>(options_.limit_bytes));
  std::int64_t bytes = writer_->bytes();
  for (db::RecordedStep& step : steps) {
    bytes += size_of(step);
    if (!full_ && bytes > pictures_limit) {
      full_ = true;
      pictures_until_ = step.seq - 1;
      log_(file_.filename().string() + " is full: from here on it is without pictures");
    }
    if (full_ && step.picture) step.picture->bytes = nullptr;
  }
  const Status written = writer_->append(steps);
  steps.clear();
  if (!written) return give_up(written.error());
  if (writer_->bytes() > options_.limit_bytes) {
    close({false, "The recording was full before the mission ended."});
    const std::lock_guard lock(mutex_);
    broken_ = number_;
  }
}

void RecordingThread::close(db::RecordingEnd end) {
  if (!writer_) return;
  if (full_) {
    end.whole = false;
    end.note += " The recording was full: there are no pictures after step " + std::to_string(pictures_until_) + ".";
  }
  const Status finished = writer_->finish(end);
  writer_.reset();
  log_(finished ? "recorded " + file_.string() : finished.error().message + " (" + file_.string() + ")");
}

void RecordingThread::give_up(const Error& error) {
  log_(error.message + " The mission goes on without recording. (" + error.where + ")");
  // The note may find no place any more; without it the recording counts as cut off.
  if (writer_) (void)writer_->finish({false, "The recording was given up: " + error.message});
  writer_.reset();
  const std::lock_guard lock(mutex_);
  broken_ = number_;
}

}  // namespace homeward::recording
