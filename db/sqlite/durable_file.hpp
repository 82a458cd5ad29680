// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace homeward::db {

/// Writes a file so that it is there whole, also after a power cut, once this returns. Throws std::system_error.
void write_durably(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

/// Makes a folder whose parent exists, durably. Throws std::system_error.
void make_folder_durably(const std::filesystem::path& folder);

/// Throws std::system_error.
std::vector<std::uint8_t> read_whole(const std::filesystem::path& file);

}  // namespace homeward::db
