// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace homeward::wire {

/// The entity tag of a state that is known by a number (RFC 9110 §8.8.3), with its quotes: "r12". `letter` says of
/// what.
std::string entity_tag(char letter, std::int64_t number);

/// The number in such a tag, with or without quotes, also weak; nothing where it is none.
std::optional<std::int64_t> number_in_tag(char letter, std::string_view tag);

}  // namespace homeward::wire
