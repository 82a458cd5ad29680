// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "core/result.hpp"

namespace homeward::db {

/// Whether something failed for want of room on the disk (or in its owner's quota).
[[nodiscard]] bool is_disk_full(const std::error_code& failure);
/// What people are told then.
[[nodiscard]] Error disk_full(const std::string& where);

/// Writes a file so that it is there whole, also after a power cut, once this returns. Where it fails nothing
/// of it stays. Throws std::system_error.
void write_durably(const std::filesystem::path& file, std::span<const std::uint8_t> bytes);

/// Brings the names of a folder to the disk. Throws std::system_error.
void flush_folder(const std::filesystem::path& folder);

/// Makes a folder whose parent exists, durably. Throws std::system_error.
void make_folder_durably(const std::filesystem::path& folder);

/// Throws std::system_error.
std::vector<std::uint8_t> read_whole(const std::filesystem::path& file);

}  // namespace homeward::db
