// SPDX-License-Identifier: Apache-2.0
#include "mapping/tour_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/index.hpp"
#include "core/median.hpp"

namespace homeward::mapping {
TourPath::TourPath(const MappingInput& input) : along_(input.images.size(), 0.0) {
  metric_ = std::ranges::all_of(input.images, [](const map::MapImage& image) { return image.odometry.has_value(); });
  std::vector<double> steps;
  for (std::size_t i = 1; i < along_.size(); ++i) {
    double step = 1.0;
    if (metric_) {
      const Pose2& a = *input.images[i - 1].odometry;
      const Pose2& b = *input.images[i].odometry;
      step = std::hypot(b.x_m - a.x_m, b.y_m - a.y_m);
    }
    along_[i] = along_[i - 1] + step;
    steps.push_back(step);
  }
  if (steps.empty()) return;
  step_ = std::max(median(std::move(steps)), 1e-3);
}

double TourPath::length(int a, int b) const { return std::abs(along_[at(b)] - along_[at(a)]); }

float place_distance_threshold(const MappingInput& input, const TourPath& path, const MappingConfig& config) {
  const double extent = path.metric() ? config.place_extent_m : config.place_extent_images;
  const double step = path.metric() ? path.step() : 1.0;
  // The median over the tour of D at one extent; where half of these pairs have nothing in common, at a shorter one.
  for (double wanted = extent; wanted > 0.5 * step; wanted -= step) {
    std::vector<float> distances;
    for (int i = 0; i < static_cast<int>(input.images.size()); ++i) {
      int j = i;
      while (j + 1 < static_cast<int>(input.images.size()) && input.tour_of[at(j + 1)] == input.tour_of[at(i)] &&
             path.length(i, j) < wanted - 0.5 * step) {
        ++j;
      }
      if (j > i && path.length(i, j) >= wanted - 0.5 * step) distances.push_back(input.pairs->distance(i, j));
    }
    if (distances.empty()) continue;
    const float usual = median(std::move(distances));
    if (std::isfinite(usual)) return usual;
  }
  return 0.0F;
}

UsualDistances usual_distances(const MappingInput& input, const TourPath& path, const MappingConfig& config) {
  const double extent = path.metric() ? config.place_extent_m : config.place_extent_images;
  std::vector<float> distances;
  for (int i = 0; i < static_cast<int>(input.images.size()); ++i) {
    for (int j = i + 1; j < static_cast<int>(input.images.size()); ++j) {
      if (input.tour_of[at(i)] != input.tour_of[at(j)] || path.length(i, j) > extent * (1.0 + 1e-9)) break;
      distances.push_back(input.pairs->distance(i, j));
    }
  }
  return UsualDistances(std::move(distances));
}

}  // namespace homeward::mapping
