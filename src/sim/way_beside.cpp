// SPDX-License-Identifier: Apache-2.0
#include "sim/way_beside.hpp"

#include <algorithm>
#include <cmath>

#include "sim/floor.hpp"

namespace homeward::sim {
namespace {

constexpr double kFine_m = 0.05;
constexpr int kAbout = 8;        // fine steps to both sides that give the way's direction at a point
constexpr double kSlant = 0.33;  // beside the way, metre for metre along it

/// How far one can go sideways from a point over set cells, up to `most_m`; a cell's width less where they end.
double free_aside_m(const FloorGrid& drivable, const Eigen::Vector2d& from_m, const Eigen::Vector2d& aside,
                    double most_m) {
  constexpr double kProbe_m = 0.025;
  double free_m = 0.0;
  while (free_m < most_m) {
    const double next_m = std::min(most_m, free_m + kProbe_m);
    if (!is_set(drivable, from_m + next_m * aside)) return std::max(0.0, free_m - drivable.resolution_m);
    free_m = next_m;
  }
  return free_m;
}

}  // namespace

std::vector<Eigen::Vector2d> resampled(const std::vector<Eigen::Vector2d>& way_m, double step_m) {
  const double total_m = length_m(way_m);
  const int count = std::max(1, static_cast<int>(std::lround(total_m / step_m)));
  std::vector<Eigen::Vector2d> points = {way_m.front()};
  double gone_m = 0.0;
  for (std::size_t i = 1; i < way_m.size(); ++i) {
    const double piece_m = (way_m[i] - way_m[i - 1]).norm();
    while (static_cast<int>(points.size()) < count) {
      const double wanted_m = total_m * static_cast<double>(points.size()) / count;
      if (wanted_m > gone_m + piece_m) break;
      points.emplace_back(way_m[i - 1] + (way_m[i] - way_m[i - 1]) * ((wanted_m - gone_m) / std::max(1e-12, piece_m)));
    }
    gone_m += piece_m;
  }
  points.push_back(way_m.back());
  return points;
}

std::vector<Eigen::Vector2d> way_beside(const FloorGrid& drivable, const std::vector<Eigen::Vector2d>& way_m,
                                        double beside_m) {
  if (way_m.size() < 2) return {};
  const std::vector<Eigen::Vector2d> fine_m = resampled(way_m, kFine_m);
  const auto count = static_cast<int>(fine_m.size());
  const auto at = [&](int i) { return fine_m[static_cast<std::size_t>(std::clamp(i, 0, count - 1))]; };
  std::vector<Eigen::Vector2d> ahead;
  std::vector<Eigen::Vector2d> aside;
  std::vector<double> off_m;
  for (int i = 0; i < count; ++i) {
    ahead.emplace_back((at(i + kAbout) - at(i - kAbout)).stableNormalized());
    const Eigen::Vector2d left(-ahead.back().y(), ahead.back().x());
    aside.emplace_back(beside_m < 0.0 ? Eigen::Vector2d(-left) : left);
    off_m.push_back(free_aside_m(drivable, at(i), aside.back(), std::abs(beside_m)));
  }
  // Away from the way and back to it no faster than one drives.
  const double change_m = kSlant * kFine_m;
  for (std::size_t i = 1; i < off_m.size(); ++i) off_m[i] = std::min(off_m[i], off_m[i - 1] + change_m);
  for (std::size_t i = off_m.size() - 1; i > 0; --i) off_m[i - 1] = std::min(off_m[i - 1], off_m[i] + change_m);
  std::vector<Eigen::Vector2d> beside;
  const int reach = static_cast<int>(std::ceil(4.0 * std::abs(beside_m) / kFine_m));
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const Eigen::Vector2d point_m = fine_m[index] + off_m[index] * aside[index];
    // On the inner side of a turn, what is nearer to another part of the way than to its own would be driven back.
    constexpr double kNearer_m = 0.02;
    bool goes_back = false;
    for (int j = std::max(0, i - reach); j < std::min(count, i + reach) && !goes_back; ++j) {
      goes_back = (at(j) - point_m).norm() < off_m[index] - kNearer_m;
    }
    constexpr double kLeastOn_m = 0.01;
    if (goes_back || (!beside.empty() && (point_m - beside.back()).dot(ahead[index]) < kLeastOn_m)) continue;
    beside.push_back(point_m);
  }
  constexpr int kRounds = 30;
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t i = 1; i + 1 < beside.size(); ++i) {
      const Eigen::Vector2d moved = 0.5 * beside[i] + 0.25 * (beside[i - 1] + beside[i + 1]);
      if (is_set(drivable, moved)) beside[i] = moved;
    }
  }
  return beside;
}

}  // namespace homeward::sim
