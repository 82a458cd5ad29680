// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/ids.hpp"

namespace homeward::wire {

/// A number, or null where there is none: JSON has no NaN, and what is not known is null.
inline nlohmann::json finite_or_null(double value) { return std::isfinite(value) ? nlohmann::json(value) : nullptr; }

inline nlohmann::json or_null(const std::optional<double>& value) {
  return value ? finite_or_null(*value) : nlohmann::json(nullptr);
}

template <class T>
nlohmann::json or_null(const std::optional<T>& value) {
  return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

template <class Tag>
nlohmann::json or_null(const std::optional<Id<Tag>>& id) {
  return id ? nlohmann::json(id->str()) : nlohmann::json(nullptr);
}

/// The texts of ids as a list.
template <class Ids>
nlohmann::json ids_to_json(const Ids& ids) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& id : ids) list.push_back(id.str());
  return list;
}

}  // namespace homeward::wire
