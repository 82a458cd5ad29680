// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace homeward::linemodel {

/// Steps through a text of numbers, commas and letters, as SVG's attributes have them.
class SvgNumbers {
 public:
  explicit SvgNumbers(std::string_view text) : text_(text) {}
  /// The next number, or nothing where none stands. It is finite.
  std::optional<double> number();
  /// The next letter, or nothing where none stands.
  std::optional<char> letter();
  /// Up to the next one of `ends`, which is stepped over too; nothing where none comes.
  std::optional<std::string_view> word_before(char end);
  [[nodiscard]] bool at_end();

 private:
  void skip_space();

  std::string_view text_;
};

/// All the numbers of a list; nothing where something else stands.
std::optional<std::vector<double>> svg_number_list(std::string_view text);

/// A `transform` attribute (SVG 1.1, 7.6); nothing where it cannot be read.
std::optional<Eigen::Affine2d> svg_transform(std::string_view text);

/// The straight parts of a path (SVG 1.1, 8.3), each from point to point; nothing where it cannot be read.
std::optional<std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>> svg_straight_parts(std::string_view path);

/// The metres of a length with a unit (mm, cm, m, in); nothing for one without.
std::optional<double> svg_length_m(std::string_view text);

}  // namespace homeward::linemodel
