// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "map/taught_path.hpp"

namespace homeward::testing {

/// Every number of an arc from `seed` on, so that two that were mixed up are noticed.
inline map::PathArc sample_arc(int from, double seed, int matches) {
  map::PathArc arc;
  arc.from = from;
  arc.has_baseline = from % 2 == 0;
  arc.motion.current_from_target = Eigen::AngleAxisd(0.1 * seed, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  arc.motion.target_in_current = Eigen::Vector3d(seed, 1.0, 0.1).normalized();
  arc.error_px = 0.125 * seed;
  arc.parallax_px = 3.0 * seed;
  arc.direction_spread_rad = 0.01 * seed;
  arc.lead = from == 0 ? std::numeric_limits<double>::infinity() : 20.0 * seed;
  arc.ended_by = from == 0 ? map::ArcEnd::kTooFewFeatures : map::ArcEnd::kNoGeometry;
  for (int i = 0; i < matches; ++i) {
    map::ArcMatch match;
    match.feature = 10 * from + i;
    match.from_px = {seed + i, 2.0 * seed};
    match.to_px = {seed - i, 3.0 * seed};
    match.from_bearing = Eigen::Vector3d(1.0, 0.1 * i, 0.2).normalized();
    match.to_bearing = Eigen::Vector3d(1.0, 0.1 * i, 0.3).normalized();
    match.from_nearness = 0.4 + seed;
    match.to_nearness = i == 0 ? -0.0 : 0.5 + seed;
    match.distance_spread = 0.01 * seed;
    arc.matches.push_back(match);
  }
  return arc;
}

/// A path over the three images of sample_map(): two arcs, then a cut to nowhere.
inline map::MapPath sample_path() {
  map::MapPath path;
  for (int i = 0; i < 3; ++i) {
    map::KeyImage key;
    key.picture = i;
    for (int k = 0; k <= i; ++k) key.features.push_back({10 * i + k, {0.5 + i, 1.0 / 3.0 + k}});
    key.common = 7 * i;
    if (i == 1) key.scale = map::NodeScale{1.0 / 3.0, 9, 0.0625};
    path.taught.key_images.push_back(key);
    path.images.emplace_back("tour/0000" + std::to_string(i) + ".jpg");
    path.pictures.push_back({std::uint8_t{0xFF}, std::uint8_t{0xD8}, static_cast<std::uint8_t>(i)});
  }
  path.taught.arcs = {sample_arc(0, 1.5, 3), sample_arc(1, 0.7, 0)};
  path.taught.cuts = {{2, std::nullopt, map::CutReason::kNoGeometry}, {0, 1, map::CutReason::kErrorTooLarge}};
  path.taught.skipped_pictures = {1, 2};
  path.taught.bridges = {{0, 1, 37}};
  return path;
}

/// The same in one piece, and closed: a third arc leads from the last key image to the first.
inline map::MapPath closed_sample_path() {
  map::MapPath path = sample_path();
  path.taught.cuts.clear();
  path.taught.arcs.push_back(sample_arc(2, 0.9, 2));
  path.taught.closing = map::PathClosing{0, 11, map::NodeScale{1.25, 8, 0.03125}};
  return path;
}

}  // namespace homeward::testing
