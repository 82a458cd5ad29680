// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "db/recording.hpp"

namespace homeward::recording {

/// What names of recordings end in.
inline constexpr const char* kRecordingExtension = ".hwrec";

/// Removes the oldest recordings of a folder until all of them take at most `most_bytes`; nothing else is touched.
/// `log`: gets a line for each.
void make_room(const std::filesystem::path& folder, std::int64_t most_bytes,
               const std::function<void(const std::string&)>& log);

/// A file that is not there yet: `name`, or the recording's start and mission.
std::filesystem::path new_recording_file(const std::filesystem::path& folder, const std::string& name,
                                         const db::RecordingHeader& header);

}  // namespace homeward::recording
