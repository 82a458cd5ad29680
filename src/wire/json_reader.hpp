// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/enum_names.hpp"
#include "core/result.hpp"

namespace homeward::wire {

inline constexpr std::size_t kMaxTextBytes = 4096;
inline constexpr std::size_t kMaxArrayItems = 200'000;

/// Whether these bytes are text in UTF-8. What comes as CBOR may hold others.
bool is_utf8(std::string_view text);

/// Whether UTF-8 text has nothing in it that moves a cursor or reorders what stands beside it: no control characters
/// (C0, DEL, C1), no line or paragraph separators, no marks of writing direction that embed or override (Unicode
/// U+202A to U+202E, U+2066 to U+2069).
bool is_plain_line(std::string_view text);

/// Foreign text, or a foreign value as JSON, for a message: short, and only what can be printed anywhere.
std::string shown(const std::string& text, std::size_t most_bytes = 64);
std::string shown(const nlohmann::json& value);

/// Reads one JSON object strictly: every key is asked for, nothing else may be there. The first problem is kept with
/// its JSON path; reading goes on with neutral values, so that decoders stay straight lines.
///   ObjectReader reader(value, "camera");
///   config.width_px = reader.integer("width_px", 1, 16384);
///   if (auto status = reader.finish(); !status) return pass_on(status);
class ObjectReader {
 public:
  ObjectReader(const nlohmann::json& value, std::string path);

  /// Checks the pair "format" and "version" of a file.
  void format(const std::string& format, int version);
  /// The version, of those that are read; the oldest where it is none of them, which is then a problem.
  int format(const std::string& format, int oldest, int newest);
  double number(const std::string& key);  // finite
  double number(const std::string& key, double least, double most);
  std::int64_t integer(const std::string& key, std::int64_t least, std::int64_t most);
  bool boolean(const std::string& key);
  std::string text(const std::string& key, std::size_t max_bytes = kMaxTextBytes);
  /// A text that people read as one line: is_plain_line.
  std::string line(const std::string& key, std::size_t max_bytes = kMaxTextBytes);
  std::string choice(const std::string& key, const std::vector<std::string>& choices);
  /// The same for the texts of an enumeration.
  template <class Enum, std::size_t kCount>
  Enum choice(const std::string& key, const EnumNames<Enum, kCount>& names) {
    return names.find(choice(key, std::vector<std::string>(names.all().begin(), names.all().end()))).value();
  }
  std::vector<double> numbers(const std::string& key, std::size_t count);
  /// The items of an array of at most `max_items`.
  std::vector<nlohmann::json> array(const std::string& key, std::size_t max_items = kMaxArrayItems);
  /// The value as it is, or null when it is absent (which is then a problem).
  const nlohmann::json& value(const std::string& key);

  /// Whether the key is there and not null; asking makes it known.
  bool has(const std::string& key);
  std::optional<double> optional_number(const std::string& key);
  std::optional<std::string> optional_text(const std::string& key);

  [[nodiscard]] std::string path_of(const std::string& key) const { return path_ + "/" + key; }
  /// Keeps the first problem.
  void problem(const std::string& key, const std::string& message, ErrorCode code = ErrorCode::kInvalidInput);
  /// Takes over the error of a part read elsewhere.
  template <class T>
  T take(Result<T> part) {
    if (part) return std::move(*part);
    if (!error_) error_ = part.error();
    return T{};
  }
  /// The first problem; an unknown key is one.
  Status finish();
  /// Finishes the reader of an object inside this one: its first problem becomes this one's.
  void close(ObjectReader& inner) {
    if (const Status status = inner.finish(); !status) take<int>(pass_on(status));
  }

 private:
  const nlohmann::json* find(const std::string& key);

  const nlohmann::json& value_;
  std::string path_;
  std::set<std::string> asked_;
  std::optional<Error> error_;
};

/// Parses text of at most `max_bytes` and `max_depth` levels. Errors: kInvalidInput, kTooLarge.
Result<nlohmann::json> parse_json(const std::string& text, const std::string& where,
                                  std::size_t max_bytes = 64UL * 1024 * 1024, int max_depth = 32);

}  // namespace homeward::wire
