// SPDX-License-Identifier: Apache-2.0
#include "pipeline/picture_pair.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

#include "camera/panorama.hpp"
#include "core/angles.hpp"
#include "matching/verify.hpp"
#include "matching/visual_distance.hpp"

namespace homeward::pipeline {
namespace {

constexpr std::uint64_t kPairSeed = 1;
constexpr std::size_t kMostMatches = 2000;

map::PicturePoint point_of(const camera::PanoramaGeometry& geometry, const features::FeatureSet& set, int index) {
  const Eigen::Vector2d pixel_px = geometry.pixel(set.bearings.row(index).transpose().cast<double>());
  return {std::clamp((pixel_px.x() + 0.5) / geometry.width_px, 0.0, 1.0),
          std::clamp((pixel_px.y() + 0.5) / geometry.height_px(), 0.0, 1.0)};
}

const features::FeatureSet& set_of(const features::Appearance& seen, matching::FeatureKind kind) {
  return kind == matching::FeatureKind::kSift ? seen.sift : seen.columns;
}

}  // namespace

map::PicturePair picture_pair(const map::TopologicalMap& map, const LookedAt& a, const LookedAt& b) {
  const camera::PanoramaGeometry geometry{map.feature_config.panorama_width_px, map.feature_config.elevation_max_rad,
                                          map.feature_config.elevation_min_rad};
  map::PicturePair pair{a.image, b.image, std::nullopt, 0.0, std::nullopt, std::nullopt, {}};
  const matching::VerifyConfig config;
  const matching::PairComparison compared = matching::compare(a.seen, b.seen, config, kPairSeed);
  if (std::isfinite(compared.distance)) {
    pair.distance = compared.distance;
    pair.similarity = 1.0 / (1.0 + compared.distance / map.motion.distance_scale);
  }
  const auto verified = matching::verify(a.seen, b.seen, config, kPairSeed);
  const std::vector<matching::Match> matches =
      verified ? verified->matches : matching::match_both_kinds(a.seen, b.seen, config.match, config.columns);
  for (const matching::Match& match : matches) {
    pair.matches.push_back({point_of(geometry, set_of(a.seen, match.kind), match.current),
                            point_of(geometry, set_of(b.seen, match.kind), match.target),
                            std::clamp(1.0 - static_cast<double>(match.ratio), 0.0, 1.0), false});
  }
  if (verified) {
    for (const int inlier : verified->pose.inliers) pair.matches[static_cast<std::size_t>(inlier)].agrees = true;
    pair.turn_rad = verified->pose.motion.turn_rad;
    pair.shift = *pair.turn_rad / (2.0 * kPi);
  }
  std::ranges::stable_sort(pair.matches, std::ranges::greater(),
                           [](const map::PairMatch& match) { return std::tuple(match.agrees, match.distinctiveness); });
  if (pair.matches.size() > kMostMatches) pair.matches.resize(kMostMatches);
  return pair;
}

}  // namespace homeward::pipeline
