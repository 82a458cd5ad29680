// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "core/result.hpp"
#include "wire/json_reader.hpp"

namespace homeward::recording {

// Structures as JSON objects, by one function for each that names its members, for writing and for reading. A member
// that JSON does not know by itself has functions numbers_of(member), which gives its JSON, and take(json, member).

/// Writes each member under its name.
struct WriteFields {
  nlohmann::json value = nlohmann::json::object();
  template <class T>
  void operator()(const char* key, const T& member) {
    if constexpr (requires { numbers_of(member); }) {
      value[key] = numbers_of(member);
    } else {
      value[key] = member;
    }
  }
};

/// Reads what is there. Throws what json throws for a value of the wrong kind.
struct ReadFields {
  const nlohmann::json& value;
  std::set<std::string> known{};
  template <class T>
  void operator()(const char* key, T& member) {
    known.insert(key);
    const auto found = value.find(key);
    if (found == value.end()) return;
    if constexpr (requires { take(*found, member); }) {
      take(*found, member);
    } else {
      found->get_to(member);
    }
  }
};

/// The structure whose members `visit` names. Errors: kCorruptFile, kUnsupportedFormat for a member that it has not.
template <class T, class Visit>
Result<T> read_fields(const std::string& text, const char* what, Visit&& visit) {
  const auto damaged = [&] {
    return fail(ErrorCode::kCorruptFile, std::string("The recording is damaged: ") + what + " cannot be understood.",
                "meta");
  };
  const nlohmann::json value = nlohmann::json::parse(text, nullptr, false);
  if (!value.is_object()) return damaged();
  T config;
  ReadFields fields{value};
  try {
    visit(fields, config);
  } catch (const nlohmann::json::exception&) {
    return damaged();
  }
  for (const auto& [key, ignored] : value.items()) {
    if (fields.known.contains(key)) continue;
    return fail(ErrorCode::kUnsupportedFormat,
                std::string("The recording's ") + what + " have '" + wire::shown(key) +
                    "', which this program does not know: replay it with the program that recorded it.",
                "meta");
  }
  return config;
}

}  // namespace homeward::recording
