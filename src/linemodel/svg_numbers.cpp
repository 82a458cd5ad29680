// SPDX-License-Identifier: Apache-2.0
#include "linemodel/svg_numbers.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>

namespace homeward::linemodel {
namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_small(char c) { return c >= 'a' && c <= 'z'; }
char capital_of(char c) { return is_small(c) ? static_cast<char>(c - 'a' + 'A') : c; }

/// How many numbers a path's command takes each time; nothing for what is no command.
std::optional<std::size_t> numbers_of(char command) {
  switch (command) {
    case 'M':
    case 'L':
    case 'T':
      return 2;
    case 'H':
    case 'V':
      return 1;
    case 'S':
    case 'Q':
      return 4;
    case 'C':
      return 6;
    case 'A':
      return 7;
    case 'Z':
      return 0;
    default:
      return std::nullopt;
  }
}

using Part = std::pair<Eigen::Vector2d, Eigen::Vector2d>;

/// Draws a path's commands one after another, and keeps what is straight.
class PathPen {
 public:
  void draw(char command, bool relative, const std::vector<double>& numbers) {
    if (command == 'Z') return straight_to(begin_);
    Eigen::Vector2d to = relative ? Eigen::Vector2d(Eigen::Vector2d::Zero()) : at_;
    if (command == 'H') {
      to.x() = numbers[0];
    } else if (command == 'V') {
      to.y() = numbers[0];
    } else {
      to = {numbers[numbers.size() - 2], numbers[numbers.size() - 1]};
    }
    if (relative) to += at_;
    if (command == 'L' || command == 'H' || command == 'V') return straight_to(to);
    at_ = to;  // M, or the end of a curve
    if (command == 'M') begin_ = to;
  }
  std::vector<Part> take() { return std::move(parts_); }

 private:
  void straight_to(const Eigen::Vector2d& to) {
    if (to != at_) parts_.emplace_back(at_, to);
    at_ = to;
  }

  Eigen::Vector2d begin_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d at_ = Eigen::Vector2d::Zero();
  std::vector<Part> parts_;
};

std::optional<Eigen::Affine2d> one_transform(std::string_view name, const std::vector<double>& n) {
  constexpr double kDegree_rad = std::numbers::pi / 180.0;
  Eigen::Affine2d result = Eigen::Affine2d::Identity();
  if (name == "matrix" && n.size() == 6) {
    result.matrix() << n[0], n[2], n[4], n[1], n[3], n[5], 0.0, 0.0, 1.0;
  } else if (name == "translate" && (n.size() == 1 || n.size() == 2)) {
    result.translation() = Eigen::Vector2d(n[0], n.size() == 2 ? n[1] : 0.0);
  } else if (name == "scale" && (n.size() == 1 || n.size() == 2)) {
    result.scale(Eigen::Vector2d(n[0], n.back()));
  } else if (name == "rotate" && (n.size() == 1 || n.size() == 3)) {
    const Eigen::Vector2d about = n.size() == 3 ? Eigen::Vector2d(n[1], n[2]) : Eigen::Vector2d(0.0, 0.0);
    result = Eigen::Translation2d(about) * Eigen::Rotation2Dd(n[0] * kDegree_rad) * Eigen::Translation2d(-about);
  } else if (name == "skewX" && n.size() == 1) {
    result.matrix()(0, 1) = std::tan(n[0] * kDegree_rad);
  } else if (name == "skewY" && n.size() == 1) {
    result.matrix()(1, 0) = std::tan(n[0] * kDegree_rad);
  } else {
    return std::nullopt;
  }
  return result;
}

}  // namespace

void SvgNumbers::skip_space() {
  constexpr std::string_view kSpace = " \t\r\n,";
  const std::size_t at = text_.find_first_not_of(kSpace);
  text_.remove_prefix(at == std::string_view::npos ? text_.size() : at);
}

bool SvgNumbers::at_end() {
  skip_space();
  return text_.empty();
}

std::optional<double> SvgNumbers::number() {
  skip_space();
  std::string_view digits = text_;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  // from_chars would take "inf" and "nan" too.
  const std::size_t first = digits.starts_with('-') ? 1 : 0;
  if (digits.size() <= first || is_letter(digits[first])) return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text_ = digits.substr(static_cast<std::size_t>(end - digits.data()));
  return value;
}

std::optional<char> SvgNumbers::letter() {
  skip_space();
  if (text_.empty() || !is_letter(text_.front())) return std::nullopt;
  const char found = text_.front();
  text_.remove_prefix(1);
  return found;
}

std::optional<std::string_view> SvgNumbers::word_before(char end) {
  skip_space();
  const std::size_t at = text_.find(end);
  if (at == std::string_view::npos) return std::nullopt;
  std::string_view word = text_.substr(0, at);
  text_.remove_prefix(at + 1);
  while (!word.empty() && word.back() == ' ') word.remove_suffix(1);
  return word;
}

std::optional<std::vector<double>> svg_number_list(std::string_view text) {
  SvgNumbers numbers(text);
  std::vector<double> list;
  while (!numbers.at_end()) {
    const auto number = numbers.number();
    if (!number) return std::nullopt;
    list.push_back(*number);
  }
  return list;
}

std::optional<Eigen::Affine2d> svg_transform(std::string_view text) {
  SvgNumbers rest(text);
  Eigen::Affine2d result = Eigen::Affine2d::Identity();
  while (!rest.at_end()) {
    const auto name = rest.word_before('(');
    const auto values = name ? rest.word_before(')') : std::nullopt;
    const auto numbers = values ? svg_number_list(*values) : std::nullopt;
    const auto next = numbers ? one_transform(*name, *numbers) : std::nullopt;
    if (!next) return std::nullopt;
    result = result * *next;
  }
  return result;
}

std::optional<std::vector<Part>> svg_straight_parts(std::string_view path) {
  SvgNumbers rest(path);
  PathPen pen;
  char command = 0;
  bool relative = false;
  std::vector<double> numbers;
  while (!rest.at_end()) {
    bool again = true;
    if (const auto letter = rest.letter()) {
      again = false;
      if (command == 0 && capital_of(*letter) != 'M') return std::nullopt;
      command = capital_of(*letter);
      relative = is_small(*letter);
    }
    const auto count = numbers_of(command);
    if (!count || (again && *count == 0)) return std::nullopt;
    // What follows a move without a letter of its own is lines (8.3.2).
    const char drawn = again && command == 'M' ? 'L' : command;
    numbers.clear();
    for (std::size_t i = 0; i < *count; ++i) {
      const auto number = rest.number();
      if (!number) return std::nullopt;
      numbers.push_back(*number);
    }
    pen.draw(drawn, relative, numbers);
  }
  return pen.take();
}

std::optional<double> svg_length_m(std::string_view text) {
  SvgNumbers rest(text);
  const auto value = rest.number();
  if (!value) return std::nullopt;
  const std::size_t unit_at = text.find_last_of("0123456789. ") + 1;
  const std::string_view unit = text.substr(unit_at);
  if (unit == "mm") return *value * 1e-3;
  if (unit == "cm") return *value * 1e-2;
  if (unit == "m") return *value;
  if (unit == "in") return *value * 0.0254;
  return std::nullopt;
}

}  // namespace homeward::linemodel
