// SPDX-License-Identifier: Apache-2.0
#include "core/angles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace homeward {
namespace {

constexpr double kTurn = 2.0 * kPi;

/// The index of the first angle with the least sum of distances round the circle to all; all within [-pi, pi].
std::size_t medoid_of_wrapped(std::span<const double> angles_rad) {
  constexpr std::size_t kTogether = 8;  // sums that are made side by side, by vector instructions
  std::size_t best = 0;
  double best_cost = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < angles_rad.size(); first += kTogether) {
    const std::size_t count = std::min(kTogether, angles_rad.size() - first);
    std::array<double, kTogether> candidates{};
    std::array<double, kTogether> costs{};
    std::copy_n(angles_rad.begin() + static_cast<std::ptrdiff_t>(first), count, candidates.begin());
    for (const double angle_rad : angles_rad) {
      for (std::size_t k = 0; k < kTogether; ++k) {
        const double apart_rad = std::abs(angle_rad - candidates[k]);
        const double other_way_rad = kTurn - apart_rad;
        costs[k] += apart_rad < other_way_rad ? apart_rad : other_way_rad;
      }
    }
    for (std::size_t k = 0; k < count; ++k) {
      if (costs[k] >= best_cost) continue;
      best_cost = costs[k];
      best = first + k;
    }
  }
  return best;
}

}  // namespace

double wrap_angle(double angle_rad) {
  // One turn more or less is what is usual; up to two turns the subtraction is exact (Sterbenz), as the remainder is.
  double wrapped = angle_rad;
  if (std::abs(angle_rad) > kPi) {
    if (angle_rad > kPi && angle_rad < 1.5 * kTurn) {
      wrapped = angle_rad - kTurn;
    } else if (angle_rad < -kPi && angle_rad > -1.5 * kTurn) {
      wrapped = angle_rad + kTurn;
    } else {
      wrapped = std::remainder(angle_rad, kTurn);  // in [-pi, pi]
    }
  }
  return wrapped <= -kPi ? kPi : wrapped;
}

double circular_median(std::span<const double> angles_rad) {
  const auto is_wrapped = [](double angle_rad) { return std::abs(angle_rad) <= kPi; };
  if (std::ranges::all_of(angles_rad, is_wrapped)) return wrap_angle(angles_rad[medoid_of_wrapped(angles_rad)]);
  std::vector<double> wrapped_rad(angles_rad.begin(), angles_rad.end());
  for (double& angle_rad : wrapped_rad) angle_rad = wrap_angle(angle_rad);
  return wrapped_rad[medoid_of_wrapped(wrapped_rad)];
}

}  // namespace homeward
