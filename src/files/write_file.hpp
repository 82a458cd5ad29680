// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "core/result.hpp"

namespace homeward::files {

/// Writes a file that appears whole or not at all, also after a power cut. Errors: kIo, naming the file.
Status write_file(const std::filesystem::path& file, std::string_view bytes);

/// Makes a folder and those above it. Errors: kIo.
Status make_folder(const std::filesystem::path& folder);

}  // namespace homeward::files
