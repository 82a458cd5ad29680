// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "db/recording.hpp"

namespace homeward::recording {

/// One value of one step that came out otherwise than it was recorded.
struct ReplayDifference {
  std::int64_t step = 0;
  std::string what;
  std::string recorded;
  std::string replayed;
};

struct ReplayResult {
  db::RecordingHeader header;
  std::int64_t steps = 0;     // recorded
  std::int64_t compared = 0;  // replayed; fewer where pictures were left out
  std::int64_t pictures = 0;
  std::int64_t vectors = 0;                 // home vectors of pictures, bit for bit compared
  std::vector<ReplayDifference> differing;  // the first ones
  std::int64_t differences = 0;
  bool complete = false;  // the mission is here to its end, and all of it was replayed
  std::string note;       // how the recording ends
  std::optional<db::WhyStopped> why;

  [[nodiscard]] bool same() const { return differences == 0; }
};

/// Runs what was recorded through the same eye and driving step and compares vectors, decisions and commands bit by
/// bit. Errors: those of db::RecordingReader; kFeatureConfigMismatch (recorded by a program with other features),
/// kUnsupportedFormat (settings that this program does not know), kEmptyInput (no steps), and those of `look`.
Result<ReplayResult> replay(const std::filesystem::path& file, const std::function<void(double)>& progress);

}  // namespace homeward::recording
