// SPDX-License-Identifier: Apache-2.0
#include "core/angles.hpp"

#include <cmath>
#include <limits>

namespace homeward {

double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);  // in [-pi, pi]
  return wrapped <= -kPi ? kPi : wrapped;
}

double circular_median(std::span<const double> angles_rad) {
  double best_rad = 0.0;
  double best_cost = std::numeric_limits<double>::infinity();
  for (const double candidate_rad : angles_rad) {
    double cost = 0.0;
    for (const double angle_rad : angles_rad) cost += std::abs(wrap_angle(angle_rad - candidate_rad));
    if (cost < best_cost) {
      best_cost = cost;
      best_rad = candidate_rad;
    }
  }
  return wrap_angle(best_rad);
}

}  // namespace homeward
