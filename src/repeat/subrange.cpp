// SPDX-License-Identifier: Apache-2.0
#include "repeat/subrange.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/index.hpp"
#include "core/median.hpp"
#include "repeat/seen.hpp"
#include "repeat/turned_pixels.hpp"

namespace homeward::repeat {
namespace {

using tracking::FeatureState;

bool is_tracked(const tracking::TrackedFeature& feature) { return feature.state == FeatureState::kTracked; }

}  // namespace

std::optional<geometry::ViewMotion> motion_between(const SubrangeView& one, const SubrangeView& other) {
  constexpr std::size_t kFewest = 6;
  if (!one.geometry || !other.geometry || !one.geometry->has_baseline || !other.geometry->has_baseline)
    return std::nullopt;
  std::map<int, double> nearness;
  for (std::size_t i = 0; i < one.geometry->inliers.size(); ++i)
    nearness[one.paired[at(one.geometry->inliers[i])]] = one.geometry->rays[i].nearness;
  std::vector<double> longer;
  for (std::size_t i = 0; i < other.geometry->inliers.size(); ++i) {
    const auto known = nearness.find(other.paired[at(other.geometry->inliers[i])]);
    const double now = other.geometry->rays[i].nearness;
    if (known != nearness.end() && known->second > 0.0 && now > 0.0) longer.push_back(now / known->second);
  }
  if (longer.size() < kFewest) return std::nullopt;
  const geometry::ViewMotion& a = one.geometry->motion;
  const geometry::ViewMotion& b = other.geometry->motion;
  const Eigen::Vector3d way = median(std::move(longer)) * b.target_in_current - a.target_in_current;
  if (!(way.norm() > 0.0)) return std::nullopt;
  return geometry::ViewMotion{a.current_from_target.transpose() * b.current_from_target,
                              a.current_from_target.transpose() * way.normalized()};
}

Arc arc_of(const geometry::TwoViewEstimate& geometry, int from, ArcEnd ended_by) {
  Arc arc;
  arc.from = from;
  arc.has_baseline = geometry.has_baseline;
  arc.motion = geometry.motion;
  arc.error_px = geometry.error_px;
  arc.parallax_px = geometry.parallax_px;
  arc.direction_spread_rad = geometry.direction_spread_rad;
  arc.lead = geometry.lead;
  arc.ended_by = ended_by;
  return arc;
}

ArcMatch match_of(const SeenTwice& where, const geometry::SeenPoint& from, const geometry::MeetingRays& rays,
                  double spread_px) {
  ArcMatch match;
  match.feature = where.feature;
  match.from_px = where.from_px;
  match.to_px = where.to_px;
  match.from_bearing = rays.current;
  match.to_bearing = rays.target;
  match.from_nearness = rays.nearness;
  match.to_nearness = rays.from_target;
  const double radians_per_px = from.bearing_per_px.norm() / std::sqrt(2.0);
  if (rays.parallax_rad > 0.0) match.distance_spread = spread_px * radians_per_px / rays.parallax_rad;
  return match;
}

Result<Subrange> Subrange::begin(NumberedPicture key, std::span<const KeyFeature> carried, int next_feature,
                                 std::shared_ptr<const camera::Camera> camera, const TeachConfig& config) {
  auto tracker = tracking::FeatureTracker::create(config.tracker);
  if (!tracker) return pass_on(tracker);
  Subrange subrange(std::move(key), *std::move(tracker), std::move(camera));
  subrange.take(carried);
  subrange.carried_ = static_cast<int>(subrange.features_.size());
  std::vector<Eigen::Vector2d> occupied_px;
  for (const KeyFeature& feature : subrange.features_) occupied_px.push_back(feature.pixel_px);
  subrange.next_feature_ = next_feature;
  const int room = config.most_features - subrange.carried_;
  if (room <= 0) return subrange;
  tracking::HarrisConfig corners = config.corners;
  corners.most = room;
  const auto found = tracking::harris_corners(subrange.key_.pyramid, corners, occupied_px);
  if (!found) return pass_on(found);
  std::vector<KeyFeature> fresh;
  for (const tracking::Corner& corner : *found) fresh.push_back({subrange.next_feature_++, corner.pixel_px});
  subrange.take(fresh);
  return subrange;
}

void Subrange::take(std::span<const KeyFeature> features) {
  for (const KeyFeature& feature : features) {
    const auto seen = seen_at(*camera_, feature.pixel_px);
    if (!seen) continue;
    const auto states = tracker_.add(key_.pyramid, std::span(&feature.pixel_px, 1));
    if (states.front() != tracking::ReferenceState::kTaken) continue;
    features_.push_back(feature);
    seen_.push_back(*seen);
  }
}

void Subrange::add(std::span<const Eigen::Vector2d> pixels_px, const TeachConfig& config) {
  for (const Eigen::Vector2d& pixel_px : pixels_px) {
    const bool occupied = std::ranges::any_of(features_, [&](const KeyFeature& feature) {
      return (feature.pixel_px - pixel_px).norm() < config.corners.spacing_px;
    });
    if (occupied) continue;
    const KeyFeature fresh{next_feature_++, pixel_px};
    take(std::span(&fresh, 1));
  }
}

SubrangeView Subrange::look(const NumberedPicture& picture, const TeachConfig& config,
                            const Eigen::Vector2d& shift_px) const {
  const TurnedPixels turned(*camera_, shift_px);
  return look_where(picture, config, [&turned](const Eigen::Vector2d& pixel_px, double scale) {
    return PlaceGuess{turned(pixel_px), scale};
  });
}

SubrangeView Subrange::look_where(const NumberedPicture& picture, const TeachConfig& config,
                                  const GuessPlace& guess) const {
  SubrangeView view;
  std::vector<tracking::FeatureGuess> guesses;
  std::vector<std::size_t> guessed;
  for (std::size_t i = 0; i < features_.size(); ++i) {
    tracking::TrackedFeature last;
    last.pixel_px = features_[i].pixel_px;
    last.state = FeatureState::kTracked;
    if (latest_) last = latest_->features[i];
    view.features.push_back(last);
    if (!is_tracked(last)) continue;
    const PlaceGuess there = guess(last.pixel_px, last.scale);
    guesses.push_back({i, there.pixel_px, there.scale});
    guessed.push_back(i);
  }
  const auto found = tracker_.track(picture.pyramid, guesses);
  std::vector<geometry::PointPair> pairs;
  for (std::size_t i = 0; i < found.size(); ++i) {
    view.features[guessed[i]] = found[i];
    if (!is_tracked(found[i])) continue;
    ++view.tracked;
    const auto seen = seen_at(*camera_, found[i].pixel_px);
    if (!seen) continue;
    pairs.push_back({seen_[guessed[i]], *seen});
    view.paired.push_back(static_cast<int>(guessed[i]));
  }
  const std::uint64_t seed = config.seed + static_cast<std::uint64_t>(picture.number);
  auto geometry = geometry::estimate_two_view(pairs, config.geometry, seed, expectation(pairs, view.paired, config));
  if (!geometry) return view;
  view.geometry = *std::move(geometry);
  for (const int inlier : view.geometry->inliers) view.common += view.paired[at(inlier)] < carried_ ? 1 : 0;
  return view;
}

/// The motion of the latest kept view, and what the arc before says of the points that both share.
geometry::MotionExpectation Subrange::expectation(std::span<const geometry::PointPair> pairs,
                                                  std::span<const int> paired, const TeachConfig& config) const {
  geometry::MotionExpectation expected;
  if (latest_ && latest_->geometry && latest_->geometry->has_baseline)
    expected.motions.push_back(latest_->geometry->motion);
  if (!latest_ && expected_) expected.motions.push_back(*expected_);
  std::vector<KnownPair> seen;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Landmark* landmark = known_.landmark(features_[at(paired[i])].feature);
    if (landmark != nullptr) seen.push_back({*landmark, pairs[i]});
  }
  if (!(config.known_weight > 0.0) || static_cast<int>(seen.size()) < config.fewest_known) return expected;
  std::vector<geometry::ViewMotion> starts = expected.motions;
  starts.emplace_back();
  if (const auto motion = motion_by_structure(seen, starts)) expected.motions.push_back(*motion);
  expected.log_likelihood = [seen = std::move(seen), weight = config.known_weight](const geometry::ViewMotion& motion) {
    return weight * structure_log_likelihood(seen, motion);
  };
  return expected;
}

Arc Subrange::arc(int from, ArcEnd ended_by) const {
  const geometry::TwoViewEstimate& geometry = *latest_->geometry;
  Arc arc = arc_of(geometry, from, ended_by);
  for (std::size_t i = 0; i < geometry.inliers.size(); ++i) {
    const std::size_t of = at(latest_->paired[at(geometry.inliers[i])]);
    arc.matches.push_back(match_of({features_[of].feature, features_[of].pixel_px, latest_->features[of].pixel_px},
                                   seen_[of], geometry.rays[i], geometry.spread_px));
  }
  return arc;
}

std::vector<KeyFeature> Subrange::agreeing_in_latest() const {
  std::vector<KeyFeature> agreeing;
  for (const int inlier : latest_->geometry->inliers) {
    const std::size_t of = at(latest_->paired[at(inlier)]);
    agreeing.push_back({features_[of].feature, latest_->features[of].pixel_px});
  }
  return agreeing;
}

}  // namespace homeward::repeat
