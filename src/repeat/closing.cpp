// SPDX-License-Identifier: Apache-2.0
#include "repeat/closing.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/index.hpp"
#include "repeat/bridge.hpp"
#include "repeat/node_scale.hpp"
#include "repeat/seen.hpp"

namespace homeward::repeat {
namespace {

constexpr int kMostTried = 6;  // key images that a path may be closed at

/// A way in any direction on the floor: a tour may end beside where it began.
geometry::TwoViewConfig any_way(geometry::TwoViewConfig geometry) {
  if (geometry.driving) geometry.driving->swerve_rad = 10.0;
  return geometry;
}

/// Key images of the last piece, from its first one on, that the way from there to the end is long enough for.
std::vector<int> keys_far_back(const TaughtPath& path, int fewest_around) {
  std::vector<int> keys;
  int ways = 0;
  int next = path.last_key();
  for (auto arc = path.arcs.rbegin(); arc != path.arcs.rend() && arc->from + 1 == next; ++arc) {
    next = arc->from;
    ways += arc->has_baseline ? 1 : 0;
    if (ways >= fewest_around) keys.push_back(arc->from);
  }
  std::ranges::reverse(keys);
  return keys;
}

int fresh_feature(const TaughtPath& path) {
  int fresh = 0;
  for (const KeyImage& key : path.key_images) {
    for (const KeyFeature& feature : key.features) fresh = std::max(fresh, feature.feature + 1);
  }
  return fresh;
}

/// The last key image and an earlier one, each with its features and those that were matched.
struct Ends {
  Subrange last;
  Subrange first;
};

/// What both show: features of the last one looked for in the first, and the other way round.
struct Common {
  std::vector<SeenTwice> where;
  int of_last = 0;  // the first so many are features of the last one
  int looked_for = 0;
};

Common common_of(const Ends& ends, const WideMatch& match, const camera::Camera& camera, const TeachConfig& config) {
  Common common;
  std::set<int> known;
  const GuessPlace on = guess_by(match, camera);
  const SubrangeView there = ends.last.look_where(ends.first.key(), config, on);
  for (const int i : there.paired) {
    const KeyFeature& feature = ends.last.features()[at(i)];
    common.where.push_back({feature.feature, feature.pixel_px, there.features[at(i)].pixel_px});
    known.insert(feature.feature);
  }
  common.of_last = static_cast<int>(common.where.size());
  const WideMatch back = reversed(match);
  const GuessPlace from = guess_by(back, camera);
  const SubrangeView here = ends.first.look_where(ends.last.key(), config, from);
  for (const int i : here.paired) {
    const KeyFeature& feature = ends.first.features()[at(i)];
    if (!known.insert(feature.feature).second) continue;
    common.where.push_back({feature.feature, here.features[at(i)].pixel_px, feature.pixel_px});
  }
  common.looked_for = looked_for(ends.last, on, camera) + looked_for(ends.first, from, camera);
  return common;
}

/// The closing arc, and which of its matches are features of the last key image.
struct ClosingArc {
  Arc arc;
  std::vector<bool> of_last;
};

std::optional<ClosingArc> arc_between(const Common& common, const WideMatch& match, int from,
                                      const camera::Camera& camera, const TeachConfig& config) {
  SubrangeView view;
  std::vector<geometry::PointPair> pairs;
  for (std::size_t i = 0; i < common.where.size(); ++i) {
    const auto here = seen_at(camera, common.where[i].from_px);
    const auto there = seen_at(camera, common.where[i].to_px);
    if (!here || !there) continue;
    pairs.push_back({*here, *there});
    view.paired.push_back(static_cast<int>(i));
  }
  view.tracked = static_cast<int>(pairs.size());
  geometry::MotionExpectation expected;
  if (match.estimate.has_baseline) expected.motions.push_back(match.estimate.motion);
  auto geometry = geometry::estimate_two_view(pairs, any_way(config.geometry), config.seed, expected);
  if (!geometry) return std::nullopt;
  view.geometry = *std::move(geometry);
  if (!holds(view, common.looked_for, match, config)) return std::nullopt;
  ClosingArc closing{arc_of(*view.geometry, from, ArcEnd::kPathEnd), {}};
  for (std::size_t i = 0; i < view.geometry->inliers.size(); ++i) {
    const std::size_t inlier = at(view.geometry->inliers[i]);
    const int of = view.paired[inlier];
    closing.arc.matches.push_back(
        match_of(common.where[at(of)], pairs[inlier].current, view.geometry->rays[i], view.geometry->spread_px));
    closing.of_last.push_back(of < common.of_last);
  }
  return closing;
}

/// Whether the way goes on there: the place is not behind, nor beside.
bool is_ahead(bool has_baseline, const geometry::ViewMotion& motion, double most_aside_rad) {
  return !has_baseline || motion.target_in_current.x() >= std::cos(most_aside_rad);
}

/// The path with the closing arc, if that has enough in common with those on both sides.
std::optional<TaughtPath> closed(TaughtPath path, const ClosingArc& closing, int key, const TeachConfig& config) {
  const Arc& before = path.arcs.back();
  const auto after = path.arc_from(key);
  if (!after) return std::nullopt;
  KeyImage& last = path.key_images.back();
  last.common = common_features(before, closing.arc);
  last.scale = node_scale(before, closing.arc, config.fewest_scaled);
  PathClosing node{key, common_features(closing.arc, path.arcs[at(*after)]),
                   node_scale(closing.arc, path.arcs[at(*after)], config.fewest_scaled)};
  if (last.common < config.least_common || node.common < config.least_common) return std::nullopt;
  KeyImage& first = path.key_images[at(key)];
  const int fresh = fresh_feature(path);
  for (std::size_t i = 0; i < closing.arc.matches.size(); ++i) {
    const ArcMatch& match = closing.arc.matches[i];
    const bool of_last = closing.of_last[i];
    if (of_last) first.features.push_back({match.feature, match.to_px});
    // What was matched beside its corners is new to the last one, too.
    if (!of_last || match.feature >= fresh) last.features.push_back({match.feature, match.from_px});
  }
  path.arcs.push_back(closing.arc);
  path.closing = node;
  return path;
}

/// A key image of the path as a teacher has it, with no features but its own.
std::optional<Subrange> key_of(const TaughtPath& path, int key, const KeyPictures& pictures, int next_feature,
                               const std::shared_ptr<const camera::Camera>& camera, TeachConfig config) {
  const auto picture = pictures(key);
  if (!picture) return std::nullopt;
  config.most_features = 0;
  auto subrange = Subrange::begin({key, *picture}, path.key_images[at(key)].features, next_feature, camera, config);
  if (!subrange) return std::nullopt;
  return *std::move(subrange);
}

}  // namespace

bool close_path(TaughtPath& path, const KeyPictures& pictures, const std::shared_ptr<const camera::Camera>& camera,
                const TeachConfig& config) {
  if (!config.bridging || path.arcs.empty() || path.closing) return false;
  const BridgingConfig& bridging = *config.bridging;
  const std::vector<int> keys = keys_far_back(path, bridging.fewest_around);
  auto last = key_of(path, path.last_key(), pictures, fresh_feature(path), camera, config);
  if (keys.empty() || !last) return false;
  const DescribedPicture here = describe(last->key().pyramid, *camera, bridging.matching);
  KeyGallery gallery;
  std::vector<int> compared;
  for (const int key : keys) {
    const auto picture = pictures(key);
    if (!picture) return false;
    compared.push_back(gallery.size());
    gallery.add(describe(*picture, *camera, bridging.matching));
  }
  RecognitionConfig matching = bridging.matching;
  matching.most_verified = std::max(matching.most_verified, kMostTried);
  const geometry::TwoViewConfig geometry = any_way(config.geometry);
  for (const RecognisedKey& found : gallery.recognise(here, compared, matching, geometry, config.seed)) {
    if (!is_ahead(found.estimate.has_baseline, found.estimate.motion, bridging.most_aside_rad)) continue;
    const int key = keys[at(found.key)];
    auto first = key_of(path, key, pictures, 0, camera, config);
    if (!first) return false;
    const auto match =
        wide_match(here, describe(first->key().pyramid, *camera, matching), *camera, matching, geometry, config.seed);
    if (!match) continue;
    Ends ends{*last, *std::move(first)};
    ends.last.add(match->first_px, config);
    const auto arc = arc_between(common_of(ends, *match, *camera, config), *match, path.last_key(), *camera, config);
    if (!arc || !is_ahead(arc->arc.has_baseline, arc->arc.motion, bridging.most_aside_rad)) continue;
    auto made = closed(path, *arc, key, config);
    if (!made) continue;
    path = *std::move(made);
    return true;
  }
  return false;
}

}  // namespace homeward::repeat
