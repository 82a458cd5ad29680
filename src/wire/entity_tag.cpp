// SPDX-License-Identifier: Apache-2.0
#include "wire/entity_tag.hpp"

#include <charconv>

namespace homeward::wire {

std::string entity_tag(char letter, std::int64_t number) {
  return std::string("\"") + letter + std::to_string(number) + "\"";
}

std::optional<std::int64_t> number_in_tag(char letter, std::string_view tag) {
  if (tag.starts_with("W/")) tag.remove_prefix(2);  // of an answer that was compressed; the number alone decides
  if (tag.size() >= 2 && tag.front() == '"' && tag.back() == '"') tag = tag.substr(1, tag.size() - 2);
  if (tag.size() < 2 || tag.front() != letter) return std::nullopt;
  std::int64_t number = 0;
  const auto [end, problem] = std::from_chars(tag.data() + 1, tag.data() + tag.size(), number);
  if (problem != std::errc{} || end != tag.data() + tag.size() || number < 0) return std::nullopt;
  return number;
}

}  // namespace homeward::wire
