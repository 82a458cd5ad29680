// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace homeward {

/// The texts that stand for the values of an enumeration in files and messages. `Enum` counts its values from 0 without
/// gaps; the texts are given in that order.
template <class Enum, std::size_t kCount>
class EnumNames {
 public:
  constexpr explicit EnumNames(const std::array<std::string_view, kCount>& names) : names_(names) {}

  /// The text of a value. `value` has to be one of the enumeration's.
  [[nodiscard]] constexpr std::string_view name(Enum value) const { return names_.at(static_cast<std::size_t>(value)); }

  /// The value of a text; nothing when no value is called so.
  [[nodiscard]] constexpr std::optional<Enum> find(std::string_view name) const {
    for (std::size_t i = 0; i < kCount; ++i) {
      if (names_.at(i) == name) return static_cast<Enum>(i);
    }
    return std::nullopt;
  }

  /// All texts, in the order of the values.
  [[nodiscard]] constexpr const std::array<std::string_view, kCount>& all() const { return names_; }

 private:
  std::array<std::string_view, kCount> names_;
};

}  // namespace homeward
