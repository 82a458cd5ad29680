// SPDX-License-Identifier: Apache-2.0
#include "geometry/repetition.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/median.hpp"

namespace homeward::geometry {

SharedView shared_view(std::span<const Correspondence> correspondences, const MotionFit& fit) {
  constexpr double kBelieved = 0.5;
  constexpr double kNoiseRad = 0.01;  // of parallax: what is far away has none, and no height to tell
  const Eigen::Matrix3d rotation = fit.motion.rotation();
  const Eigen::Vector3d direction = fit.motion.direction();
  std::vector<double> heights;
  SharedView view;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    view.agreeing += fit.belief[i];
    if (fit.belief[i] < kBelieved) continue;
    const Correspondence& c = correspondences[i];
    const Eigen::Vector3d target_in_current = rotation * c.target;
    const double sine = c.current.cross(direction).norm();
    const double sine_there = target_in_current.cross(direction).norm();
    const double parallax_sine = sine_there * c.current.dot(direction) - sine * target_in_current.dot(direction);
    heights.push_back(std::abs(c.current.z()) * sine_there / (std::abs(parallax_sine) + kNoiseRad));
  }
  view.agreeing /= std::max(1.0, static_cast<double>(correspondences.size()));
  if (heights.empty()) return view;
  view.height = median(std::move(heights));
  return view;
}

double repetition_probability(const SharedView& view) {
  // By hand, on pairs of two real corridors and a rendered house by day and by night
  // (docs/experiments/look_alike_matches.md): from views that are as far apart as their matches are high, 15 % agree at
  // the least; the nearer, the more, up to the half.
  constexpr double kLeastAgreeing = 0.15;
  constexpr double kPerLogHeight = 0.17;
  constexpr double kMostAsked = 0.5;
  constexpr double kSteepness = 20.0;
  const double asked = std::min(kMostAsked, kLeastAgreeing + kPerLogHeight * std::log(std::max(view.height, 1e-3)));
  const double log_odds = kSteepness * (asked - view.agreeing);
  return 1.0 / (1.0 + std::exp(-log_odds));
}

}  // namespace homeward::geometry
