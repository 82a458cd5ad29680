// SPDX-License-Identifier: Apache-2.0
#include "recording/recording_folder.hpp"

#include <algorithm>
#include <cctype>
#include <ctime>
#include <vector>

namespace homeward::recording {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBeside[] = {"", "-wal", "-shm"};

struct Kept {
  fs::file_time_type written;
  fs::path file;
  std::int64_t bytes = 0;
};

Kept kept(const fs::path& file) {
  std::error_code error;
  Kept recording{fs::last_write_time(file, error), file, 0};
  for (const char* ending : kBeside) {
    const auto bytes = fs::file_size(file.string() + ending, error);
    if (!error) recording.bytes += static_cast<std::int64_t>(bytes);
  }
  return recording;
}

}  // namespace

void make_room(const fs::path& folder, std::int64_t most_bytes, const std::function<void(const std::string&)>& log) {
  std::vector<Kept> recordings;
  std::int64_t bytes = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error); !error && entry != fs::directory_iterator();
       entry.increment(error)) {
    std::error_code ignored;
    if (entry->path().extension() != kRecordingExtension || !entry->is_regular_file(ignored)) continue;
    recordings.push_back(kept(entry->path()));
    bytes += recordings.back().bytes;
  }
  std::sort(recordings.begin(), recordings.end(), [](const Kept& a, const Kept& b) {
    return a.written != b.written ? a.written < b.written : a.file < b.file;
  });
  for (const Kept& oldest : recordings) {
    if (bytes <= most_bytes) return;
    std::error_code ignored;
    for (const char* ending : kBeside) fs::remove(oldest.file.string() + ending, ignored);
    bytes -= oldest.bytes;
    log("removed the oldest recording, " + oldest.file.filename().string() + ", to make room");
  }
}

fs::path new_recording_file(const fs::path& folder, const std::string& name, const db::RecordingHeader& header) {
  std::string stem = name;
  if (stem.empty()) {
    const std::time_t seconds = header.started_us / 1'000'000;
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y%m%dT%H%M%SZ-", &utc);
    constexpr std::size_t kMostOfMission = 40;
    stem = text + header.mission.substr(0, kMostOfMission);
  }
  std::replace_if(
      stem.begin(), stem.end(),
      [](unsigned char letter) { return std::isalnum(letter) == 0 && letter != '-' && letter != '_'; }, '_');
  fs::path file = folder / (stem + kRecordingExtension);
  std::error_code ignored;
  for (int again = 2; fs::exists(file, ignored); ++again) {
    file = folder / (stem + "-" + std::to_string(again) + kRecordingExtension);
  }
  return file;
}

}  // namespace homeward::recording
