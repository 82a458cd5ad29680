// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "core/image.hpp"
#include "core/result.hpp"

namespace homeward::files {

/// A binary grey picture (PGM, "P5", 8 bit) as map_server writes them. Errors: those of read_text, kInvalidInput,
/// kTruncatedImage, kImageTooLarge; each names the file.
Result<Image> read_grey_map(const std::filesystem::path& file);

}  // namespace homeward::files
