// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace homeward::pipeline {

/// A file's bytes as an address that needs no file: "data:image/png;base64,...".
std::string data_uri(std::string_view media_type, std::span<const std::uint8_t> bytes);

/// With so many decimals, "–" when it is not finite.
std::string number(double value, int decimals);

/// "1 picture", "3 pictures".
std::string counted(std::size_t count, std::string_view one, std::string_view many);

}  // namespace homeward::pipeline
