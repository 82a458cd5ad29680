// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "mapping/mapping_config.hpp"
#include "mapping/mapping_input.hpp"
#include "mapping/similarity.hpp"

namespace homeward::mapping {

/// How far two images of a tour are apart along the way: metres of odometry where every image has it, else images.
class TourPath {
 public:
  explicit TourPath(const MappingInput& input);
  [[nodiscard]] bool metric() const { return metric_; }
  /// Length of the way from image a to image b of the same tour, in metres or in images.
  [[nodiscard]] double length(int a, int b) const;
  /// Typical length of one step.
  [[nodiscard]] double step() const { return step_; }

 private:
  bool metric_ = false;
  double step_ = 1.0;
  std::vector<double> along_;  // from the first image, tours end to end
};

/// The visual distance up to which images make one place: what is usual between tour images one place extent apart.
/// Goedemé 2007 §4.2.3: the place definition is a constant visual distance; which one comes from the tour itself.
float place_distance_threshold(const MappingInput& input, const TourPath& path, const MappingConfig& config);

/// Distances between images that certainly show one place: a place extent or less of one tour apart.
UsualDistances usual_distances(const MappingInput& input, const TourPath& path, const MappingConfig& config);

}  // namespace homeward::mapping
