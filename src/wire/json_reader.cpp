// SPDX-License-Identifier: Apache-2.0
#include "wire/json_reader.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::wire {

using nlohmann::json;

std::string shown(const std::string& text, std::size_t most_bytes) {
  std::string shown = text.substr(0, most_bytes);
  for (char& c : shown) {
    if (c < 0x20 || c > 0x7E) c = '?';
  }
  return shown;
}

std::string shown(const json& value) { return shown(value.dump(-1, ' ', true, json::error_handler_t::replace)); }

bool is_utf8(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    const unsigned first = byte(i);
    const std::size_t length = first < 0x80   ? 1
                               : first < 0xC2 ? 0
                               : first < 0xE0 ? 2
                               : first < 0xF0 ? 3
                               : first < 0xF5 ? 4
                                              : 0;
    if (length == 0 || i + length > text.size()) return false;
    for (std::size_t k = 1; k < length; ++k) {
      if ((byte(i + k) & 0xC0U) != 0x80U) return false;
    }
    // Too long forms, surrogates and what lies beyond Unicode (RFC 3629 section 4).
    if (first == 0xE0 && byte(i + 1) < 0xA0) return false;
    if (first == 0xED && byte(i + 1) > 0x9F) return false;
    if (first == 0xF0 && byte(i + 1) < 0x90) return false;
    if (first == 0xF4 && byte(i + 1) > 0x8F) return false;
    i += length;
  }
  return true;
}

bool is_plain_line(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
    if (byte(i) < 0x20 || byte(i) == 0x7F) return false;
    if (byte(i) == 0xC2 && byte(i + 1) < 0xA0) return false;
    if (byte(i) != 0xE2) continue;
    const unsigned last = byte(i + 2);
    if (byte(i + 1) == 0x80 && last >= 0xA8 && last <= 0xAE) return false;
    if (byte(i + 1) == 0x81 && last >= 0xA6 && last <= 0xA9) return false;
  }
  return true;
}

ObjectReader::ObjectReader(const json& value, std::string path) : value_(value), path_(std::move(path)) {
  if (!value_.is_object()) error_ = Error{ErrorCode::kInvalidInput, "Here must be an object.", path_};
}

void ObjectReader::problem(const std::string& key, const std::string& message, ErrorCode code) {
  if (!error_) error_ = Error{code, message, path_of(key)};
}

const json* ObjectReader::find(const std::string& key) {
  asked_.insert(key);
  if (!value_.is_object()) return nullptr;
  const auto found = value_.find(key);
  return found == value_.end() ? nullptr : &*found;
}

const json& ObjectReader::value(const std::string& key) {
  static const json kNull;
  const json* found = find(key);
  if (found == nullptr) {
    problem(key, "'" + key + "' is missing.");
    return kNull;
  }
  return *found;
}

void ObjectReader::format(const std::string& format, int version) { this->format(format, version, version); }

int ObjectReader::format(const std::string& format, int oldest, int newest) {
  const std::string found = text("format");
  if (found != format) {
    problem("format", "The format is '" + shown(found) + "'; '" + format + "' is wanted.",
            ErrorCode::kUnsupportedFormat);
  }
  const json& number = value("version");
  if (number.is_number_integer()) {
    const auto version = number.get<std::int64_t>();
    if (version >= oldest && version <= newest) return static_cast<int>(version);
  }
  const std::string read = oldest == newest ? "version " + std::to_string(newest)
                                            : "versions " + std::to_string(oldest) + " to " + std::to_string(newest);
  problem("version", "The version is " + shown(number) + "; this program reads " + read + ".",
          ErrorCode::kUnsupportedFormat);
  return oldest;
}

double ObjectReader::number(const std::string& key) {
  const json& found = value(key);
  if (!found.is_number() || !std::isfinite(found.get<double>())) {
    problem(key, "'" + key + "' must be a finite number.");
    return 0.0;
  }
  return found.get<double>();
}

double ObjectReader::number(const std::string& key, double least, double most) {
  const double found = number(key);
  if (!(found >= least && found <= most)) {
    problem(key, "'" + key + "' must lie between " + json(least).dump() + " and " + json(most).dump() + ".");
    return least;
  }
  return found;
}

std::int64_t ObjectReader::integer(const std::string& key, std::int64_t least, std::int64_t most) {
  const json& found = value(key);
  const bool fits = found.is_number_integer() &&
                    !(found.is_number_unsigned() && found.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX));
  if (!fits || found.get<std::int64_t>() < least || found.get<std::int64_t>() > most) {
    problem(key, "'" + key + "' must be a whole number between " + std::to_string(least) + " and " +
                     std::to_string(most) + ".");
    return least;
  }
  return found.get<std::int64_t>();
}

bool ObjectReader::boolean(const std::string& key) {
  const json& found = value(key);
  if (!found.is_boolean()) {
    problem(key, "'" + key + "' must be true or false.");
    return false;
  }
  return found.get<bool>();
}

std::string ObjectReader::text(const std::string& key, std::size_t max_bytes) {
  const json& found = value(key);
  if (!found.is_string()) {
    problem(key, "'" + key + "' must be a text.");
    return {};
  }
  const auto& text = found.get_ref<const std::string&>();
  if (text.size() > max_bytes) {
    problem(key, "'" + key + "' is longer than " + std::to_string(max_bytes) + " bytes.");
    return {};
  }
  if (!is_utf8(text)) {
    problem(key, "'" + key + "' is no valid UTF-8 text.");
    return {};
  }
  return text;
}

std::string ObjectReader::line(const std::string& key, std::size_t max_bytes) {
  std::string found = text(key, max_bytes);
  if (is_plain_line(found)) return found;
  problem(key, "'" + key + "' is one line of text without control characters.");
  return {};
}

std::string ObjectReader::choice(const std::string& key, const std::vector<std::string>& choices) {
  const std::string found = text(key);
  if (std::find(choices.begin(), choices.end(), found) != choices.end()) return found;
  std::string listed;
  for (const std::string& choice : choices) listed += (listed.empty() ? "" : ", ") + choice;
  problem(key, "'" + key + "' must be one of: " + listed + ".");
  return choices.front();
}

std::vector<double> ObjectReader::numbers(const std::string& key, std::size_t count) {
  const json& found = value(key);
  std::vector<double> numbers(count, 0.0);
  if (!found.is_array() || found.size() != count) {
    problem(key, "'" + key + "' must be a list of " + std::to_string(count) + " numbers.");
    return numbers;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (!found[i].is_number() || !std::isfinite(found[i].get<double>())) {
      problem(key + "/" + std::to_string(i), "Here must be a finite number.");
      return numbers;
    }
    numbers[i] = found[i].get<double>();
  }
  return numbers;
}

std::vector<json> ObjectReader::array(const std::string& key, std::size_t max_items) {
  const json& found = value(key);
  if (!found.is_array()) {
    problem(key, "'" + key + "' must be a list.");
    return {};
  }
  if (found.size() > max_items) {
    problem(key, "'" + key + "' has more than " + std::to_string(max_items) + " items.");
    return {};
  }
  return {found.begin(), found.end()};
}

bool ObjectReader::has(const std::string& key) {
  const json* found = find(key);
  return found != nullptr && !found->is_null();
}

std::optional<double> ObjectReader::optional_number(const std::string& key) {
  return has(key) ? std::optional(number(key)) : std::nullopt;
}

std::optional<std::string> ObjectReader::optional_text(const std::string& key) {
  return has(key) ? std::optional(text(key)) : std::nullopt;
}

Status ObjectReader::finish() {
  if (value_.is_object() && !error_) {
    for (const auto& [key, ignored] : value_.items()) {
      if (!asked_.contains(key)) {
        problem(shown(key), "'" + shown(key) + "' is not known here.");
        break;
      }
    }
  }
  if (error_) return tl::unexpected<Error>(*error_);
  return {};
}

Result<json> parse_json(const std::string& text, const std::string& where, std::size_t max_bytes, int max_depth) {
  if (text.size() > max_bytes) {
    return fail(ErrorCode::kTooLarge, "The text has more than " + std::to_string(max_bytes) + " bytes.", where);
  }
  bool too_deep = false;
  const json::parser_callback_t watch_depth = [&](int depth, json::parse_event_t /*event*/, json& /*parsed*/) {
    too_deep = too_deep || depth > max_depth;
    return !too_deep;
  };
  try {
    json value = json::parse(text, watch_depth);
    if (too_deep) return fail(ErrorCode::kInvalidInput, "The JSON is nested too deeply.", where);
    return value;
  } catch (const json::exception& failure) {
    return fail(ErrorCode::kInvalidInput, "This is no valid JSON: " + shown(failure.what(), 300), where);
  }
}

}  // namespace homeward::wire
