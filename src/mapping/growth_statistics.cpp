// SPDX-License-Identifier: Apache-2.0
#include "mapping/growth_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/index.hpp"
#include "map/parts.hpp"

namespace homeward::mapping {
namespace {

/// Two means of so many numbers each as one.
double joint(double before, double count_before, double now, double count_now) {
  const double count = count_before + count_now;
  return count > 0.0 ? (before * count_before + now * count_now) / count : before;
}

/// For each place the image that is its prototype; -1 where the input has none.
std::vector<int> prototypes(const map::TopologicalMap& grown, const GrowthInput& input,
                            std::span<const int> place_of_image) {
  std::vector<int> result(grown.places.size(), -1);
  for (int i = 0; i < static_cast<int>(input.images.size()); ++i) {
    const auto place = at(place_of_image[at(i)]);
    if (result[place] < 0 && input.images[at(i)].id == grown.places[place].prototype) result[place] = i;
  }
  return result;
}

}  // namespace

map::MotionStatistics grown_statistics(const map::TopologicalMap& old, const map::TopologicalMap& grown,
                                       const GrowthInput& input, const PairTable& pairs,
                                       std::span<const int> place_of_image, const UsualDistances& usual) {
  double old_steps = 0.0;
  for (std::size_t i = 1; i < old.images.size(); ++i) {
    old_steps += map::tour_of(old.images[i].id) == map::tour_of(old.images[i - 1].id) ? 1.0 : 0.0;
  }
  double old_members = 0.0;
  for (const map::Place& place : old.places)
    old_members += std::max(0.0, static_cast<double>(place.members.size()) - 1);

  double steps = 0.0;
  double hops = 0.0;
  double members = 0.0;
  double squared = 0.0;
  const std::vector<int> prototype = prototypes(grown, input, place_of_image);
  for (int i = 0; i < input.new_images; ++i) {
    if (i > 0 && input.tour_of[at(i)] == input.tour_of[at(i - 1)]) {
      steps += 1.0;
      hops += place_of_image[at(i)] == place_of_image[at(i - 1)] ? 0.0 : 1.0;
    }
    const int stands = prototype[at(place_of_image[at(i)])];
    if (stands < 0 || stands == i) continue;
    const double distance = static_cast<double>(pairs.distance(std::min(i, stands), std::max(i, stands)));
    if (!std::isfinite(distance)) continue;
    members += 1.0;
    squared += distance * distance;
  }
  map::MotionStatistics result = old.motion;
  if (steps > 0.0) {
    const double before = old.motion.hop_spread * old.motion.hop_spread;
    result.hop_spread = std::max(0.5, std::sqrt(joint(before, old_steps, hops / steps, steps)));
  }
  if (members > 0.0) {
    const double before = old.motion.distance_spread * old.motion.distance_spread;
    result.distance_spread = std::max(1e-3, std::sqrt(joint(before, old_members, squared / members, members)));
  }
  if (!usual.empty()) {
    const double now = static_cast<double>(usual.quantile(0.5));
    result.distance_scale = std::max(1e-3, joint(old.motion.distance_scale, old_steps, now, steps));
  }
  return result;
}

}  // namespace homeward::mapping
