// SPDX-License-Identifier: Apache-2.0
#include "mapping/doorways.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace homeward::mapping {
namespace {

constexpr double kBin_m = 0.05;
constexpr int kDirections = 36;
constexpr double kNarrowIsBetter = 0.3;  // of two gaps in one opening, the narrower one is in the wall

/// A straight piece without a hit.
struct Gap {
  double from_m = 0.0;
  double to_m = 0.0;
  [[nodiscard]] double width_m() const { return to_m - from_m; }
  [[nodiscard]] double middle_m() const { return 0.5 * (from_m + to_m); }
};

/// Points along lines of one direction: of each line those near to it, by where they are along it.
class Lines {
 public:
  Lines(std::span<const Eigen::Vector2d> points_m, const Eigen::Vector2d& normal, double half_m)
      : reach_(static_cast<int>(std::lround(half_m / kBin_m))) {
    const Eigen::Vector2d along(-normal.y(), normal.x());
    double most = -1e9;
    first_ = 1 << 30;
    for (const Eigen::Vector2d& point : points_m) {
      first_ = std::min(first_, bin(normal.dot(point)));
      most = std::max(most, normal.dot(point));
    }
    if (points_m.empty()) return;
    bins_.resize(static_cast<std::size_t>(bin(most) - first_) + 1);
    for (const Eigen::Vector2d& point : points_m)
      bins_[static_cast<std::size_t>(bin(normal.dot(point)) - first_)].push_back(along.dot(point));
  }

  static int bin(double at_m) { return static_cast<int>(std::floor(at_m / kBin_m)); }
  static double middle_m(int line) { return (line + 0.5) * kBin_m; }

  /// Where points are along a line, ascending.
  [[nodiscard]] std::vector<double> on(int line) const {
    std::vector<double> points_m;
    for (int i = std::max(0, line - reach_ - first_);
         i <= std::min(static_cast<int>(bins_.size()) - 1, line + reach_ - first_); ++i) {
      const auto& bin = bins_[static_cast<std::size_t>(i)];
      points_m.insert(points_m.end(), bin.begin(), bin.end());
    }
    std::ranges::sort(points_m);
    return points_m;
  }

 private:
  int reach_;
  int first_ = 0;
  std::vector<std::vector<double>> bins_;
};

/// The gap around a spot; nothing where it is open to one side.
std::optional<Gap> gap_at(const std::vector<double>& points_m, double at_m) {
  const auto next = std::ranges::lower_bound(points_m, at_m);
  if (next == points_m.begin() || next == points_m.end()) return std::nullopt;
  return Gap{*std::prev(next), *next};
}

/// Share of a piece in which points are.
double filled(const std::vector<double>& points_m, double from_m, double to_m) {
  const int pieces = std::max(1, static_cast<int>(std::lround((to_m - from_m) / kBin_m)));
  int with_points = 0;
  for (int i = 0; i < pieces; ++i) {
    const double least_m = from_m + (to_m - from_m) * i / pieces;
    const double most_m = from_m + (to_m - from_m) * (i + 1) / pieces;
    const auto first = std::ranges::lower_bound(points_m, least_m);
    with_points += first != points_m.end() && *first <= most_m ? 1 : 0;
  }
  return static_cast<double>(with_points) / pieces;
}

/// A gap in a line of one direction that may be a doorway.
struct Candidate {
  int direction = 0;
  int line = 0;
  Gap gap;
  double wall = 0.0;  // share of what stands beside it, of the side with less
};

Eigen::Vector2d normal_of(int direction) {
  const double angle_rad = std::numbers::pi * direction / kDirections;
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

class Search {
 public:
  Search(std::span<const Eigen::Vector2d> points_m, std::span<const Eigen::Vector2d> spots_m,
         const DoorwayConfig& config)
      : points_m_(points_m), spots_m_(spots_m), config_(config) {}

  std::vector<Candidate> candidates() const {
    std::vector<Candidate> found;
    for (int direction = 0; direction < kDirections; ++direction) look_along(direction, found);
    return found;
  }

 private:
  void look_along(int direction, std::vector<Candidate>& found) const {
    const Eigen::Vector2d normal = normal_of(direction);
    const Lines lines(points_m_, normal, config_.thickness_m);
    int least = 1 << 30;
    int most = -least;
    for (const Eigen::Vector2d& spot : spots_m_) {
      least = std::min(least, Lines::bin(normal.dot(spot)));
      most = std::max(most, Lines::bin(normal.dot(spot)));
    }
    for (int line = least; line <= most; ++line) look_on(direction, line, lines, found);
  }

  void look_on(int direction, int line, const Lines& lines, std::vector<Candidate>& found) const {
    const std::vector<double> points_m = lines.on(line);
    std::optional<std::vector<double>> before_m;
    std::optional<std::vector<double>> behind_m;
    const int away = static_cast<int>(std::lround(config_.opens_after_m / kBin_m));
    double looked_to_m = -1e9;
    for (const double at_m : crossings(direction, line)) {
      if (at_m <= looked_to_m) continue;
      const auto gap = gap_at(points_m, at_m);
      if (!gap) continue;
      looked_to_m = gap->to_m;
      if (gap->width_m() < config_.narrowest_m || gap->width_m() > config_.widest_m) continue;
      const double wall = std::min(filled(points_m, gap->from_m - config_.wall_m, gap->from_m),
                                   filled(points_m, gap->to_m, gap->to_m + config_.wall_m));
      if (wall < config_.least_wall) continue;
      if (!before_m) before_m = lines.on(line - away);
      if (!behind_m) behind_m = lines.on(line + away);
      if (opens(*before_m, *gap) && opens(*behind_m, *gap)) found.push_back({direction, line, *gap, wall});
    }
  }

  [[nodiscard]] bool opens(const std::vector<double>& points_m, const Gap& gap) const {
    const auto there = gap_at(points_m, gap.middle_m());
    return !there || there->width_m() >= gap.width_m() + config_.opens_by_m;
  }

  /// Where ways from spot to spot cross a line, none too much aslant, ascending.
  [[nodiscard]] std::vector<double> crossings(int direction, int line) const {
    constexpr double kAslant = 0.5;  // cosine to the normal, at least
    const Eigen::Vector2d normal = normal_of(direction);
    const Eigen::Vector2d along(-normal.y(), normal.x());
    const double at_m = Lines::middle_m(line);
    std::vector<double> found_m;
    for (std::size_t i = 0; i < spots_m_.size(); ++i) {
      for (std::size_t j = i + 1; j < spots_m_.size(); ++j) {
        const double from_m = normal.dot(spots_m_[i]) - at_m;
        const double to_m = normal.dot(spots_m_[j]) - at_m;
        if (from_m * to_m >= 0.0) continue;
        if (std::abs(to_m - from_m) < kAslant * (spots_m_[j] - spots_m_[i]).norm()) continue;
        found_m.push_back(along.dot(spots_m_[i] + (spots_m_[j] - spots_m_[i]) * (from_m / (from_m - to_m))));
      }
    }
    std::ranges::sort(found_m);
    return found_m;
  }

  std::span<const Eigen::Vector2d> points_m_;
  std::span<const Eigen::Vector2d> spots_m_;
  const DoorwayConfig& config_;
};

Eigen::Vector2d middle_of(const Candidate& candidate) {
  const Eigen::Vector2d normal = normal_of(candidate.direction);
  const Eigen::Vector2d along(-normal.y(), normal.x());
  return normal * Lines::middle_m(candidate.line) + along * candidate.gap.middle_m();
}

/// Along the normal: the middle of what is as narrow as the gap, jambs and linings.
double middle_of_wall(std::span<const Eigen::Vector2d> points_m, const Candidate& candidate) {
  constexpr int kThickest = 5;  // bins to each side
  constexpr double kWider_m = 0.2;
  const Lines thin(points_m, normal_of(candidate.direction), 0.0);
  int first = candidate.line;
  int last = candidate.line;
  bool found = false;
  for (int line = candidate.line - kThickest; line <= candidate.line + kThickest; ++line) {
    const auto gap = gap_at(thin.on(line), candidate.gap.middle_m());
    if (!gap || gap->width_m() > candidate.gap.width_m() + kWider_m) continue;
    if (!found) first = line;
    last = line;
    found = true;
  }
  return 0.5 * (Lines::middle_m(first) + Lines::middle_m(last));
}

}  // namespace

std::vector<Doorway> doorways_between(std::span<const Eigen::Vector2d> points_m,
                                      std::span<const Eigen::Vector2d> spots_m, const DoorwayConfig& config) {
  constexpr double kSame_m = 0.6;  // middles of one doorway's gaps, however aslant the line
  std::vector<Candidate> left = Search(points_m, spots_m, config).candidates();
  std::vector<Doorway> doorways;
  while (!left.empty()) {
    // A wall's direction is the one with the most wall in it, over all lines beside each other that have the gap.
    const Candidate best = *std::ranges::max_element(left, {}, [&](const Candidate& one) {
      double sum = 0.0;
      for (const Candidate& other : left) {
        if (other.direction != one.direction || (middle_of(other) - middle_of(one)).norm() >= 0.5 * kSame_m) continue;
        sum += other.wall - kNarrowIsBetter * other.gap.width_m() / config.widest_m;
      }
      return std::pair(sum, one.wall);
    });
    const double line_m = middle_of_wall(points_m, best);
    const Eigen::Vector2d normal = normal_of(best.direction);
    const Eigen::Vector2d middle_m = normal * line_m + Eigen::Vector2d(-normal.y(), normal.x()) * best.gap.middle_m();
    doorways.push_back({middle_m, normal, best.gap.width_m()});
    std::erase_if(left, [&](const Candidate& other) {
      return (other.line == best.line && other.direction == best.direction) ||
             (middle_of(other) - middle_m).norm() < kSame_m;
    });
  }
  return doorways;
}

}  // namespace homeward::mapping
