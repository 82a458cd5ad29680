// SPDX-License-Identifier: Apache-2.0
#include "map/turned_layout.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "map/lookup.hpp"

namespace homeward::map {
namespace {

/// Into the middle of [0,1] each way, as large as fits.
void fit(std::vector<Eigen::Vector2d>& drawing) {
  Eigen::Vector2d low = drawing.front();
  Eigen::Vector2d high = drawing.front();
  for (const Eigen::Vector2d& position : drawing) {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  const Eigen::Vector2d size = high - low;
  const double scale = 1.0 / std::max({size.x(), size.y(), 1e-6});
  const Eigen::Vector2d margin = (Eigen::Vector2d(1.0, 1.0) - size * scale) / 2.0;
  for (Eigen::Vector2d& position : drawing) {
    position = ((position - low) * scale + margin).cwiseMax(0.0).cwiseMin(1.0);
  }
}

}  // namespace

std::vector<Eigen::Vector2d> turned_layout(const TopologicalMap& map, std::vector<Eigen::Vector2d> drawing,
                                           const TopologicalMap& other, const std::vector<Eigen::Vector2d>& of_other) {
  const auto places = place_indices(other);
  std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> both;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d other_middle = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    const auto found = places.find(map.places[i].id);
    if (found == places.end()) continue;
    both.emplace_back(drawing[i], of_other[static_cast<std::size_t>(found->second)]);
    middle += both.back().first;
    other_middle += both.back().second;
  }
  if (both.size() < 2) return drawing;
  middle /= static_cast<double>(both.size());
  other_middle /= static_cast<double>(both.size());
  double along = 0.0;
  double across = 0.0;
  for (const auto& [own, theirs] : both) {
    const Eigen::Vector2d a = own - middle;
    const Eigen::Vector2d b = theirs - other_middle;
    along += a.dot(b);
    across += a.x() * b.y() - a.y() * b.x();
  }
  const Eigen::Rotation2Dd turn(std::atan2(across, along));
  for (Eigen::Vector2d& position : drawing) position = turn * position;
  fit(drawing);
  return drawing;
}

}  // namespace homeward::map
