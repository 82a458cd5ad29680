// SPDX-License-Identifier: Apache-2.0
// The part of Repeater that finds its place without any expectation.
#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "core/index.hpp"
#include "core/median.hpp"
#include "repeat/repeater.hpp"

namespace homeward::repeat {

/// The arc that begins at a key image, or where none does, that ends there; -1 for a key image without arcs.
int Repeater::arc_at(int key) const { return path_->arc_from(key).value_or(path_->arc_from(key - 1).value_or(-1)); }

/// Some key images, from the last place on to both sides and further with each picture that is lost, then over again.
std::vector<int> Repeater::keys_to_compare() const {
  std::vector<int> keys(static_cast<std::size_t>(gallery_->size()));
  std::iota(keys.begin(), keys.end(), 0);
  const int last = around_ ? arc_of(around_->arc).from : 0;
  std::ranges::stable_sort(keys, {}, [&](int key) { return std::abs(key - last); });
  const int most = config_.recognition->most_compared;
  const int count = static_cast<int>(keys.size());
  const int windows = (count + most - 1) / most;
  const int first = (lost_for_ % windows) * most;
  return {keys.begin() + first, keys.begin() + std::min(count, first + most)};
}

/// Goes to a key image that was recognised, if the landmarks there say the same: from the first beginning from which
/// they do, or, where the features that were recognised make up for landmarks, from the one with the most of them.
bool Repeater::try_at(const RecognisedKey& found, int others_agreeing, const tracking::ImagePyramid& picture,
                      Located& located) {
  const int arc = arc_at(found.key);
  if (arc < 0 || !go_to(arc, {})) return false;
  const KeyPose& key = around_->key(found.key);
  const geometry::TwoViewEstimate& estimate = found.estimate;
  ArcPose start;
  start.local_from_current = key.local_from_key * estimate.motion.current_from_target.transpose();
  start.position = key.position;
  std::vector<ArcPose> starts{start};
  if (estimate.has_baseline && around_->nearness > 0.0) {
    // As far away as makes what was matched as distant as landmarks are here.
    std::vector<double> nearness;
    for (const geometry::MeetingRays& rays : estimate.rays) nearness.push_back(std::max(0.0, rays.from_target));
    const double length = median(std::move(nearness)) / around_->nearness;
    start.position -= length * (start.local_from_current * estimate.motion.target_in_current);
    starts.push_back(start);
  }
  const LandmarkFollower nothing = follower_;
  LandmarkFollower best_follower = nothing;
  for (const ArcPose& from : starts) {
    follower_ = nothing;
    Located there = locate_from(from, found.key, others_agreeing, picture);
    if (there.is_lost() || there.agreeing <= located.agreeing) continue;
    located = std::move(there);
    best_follower = std::move(follower_);
    if (others_agreeing == 0) break;
  }
  follower_ = std::move(best_follower);
  return !located.is_lost();
}

/// Finds the place among the key images; nothing is changed where that fails. By little light few landmarks are found
/// of those that are there, and those that were recognised count as well where no place has enough without them.
bool Repeater::recognise(const tracking::ImagePyramid& picture, Located& located) {
  const DescribedPicture described = describe(picture, *camera_, *config_.recognition);
  const auto found = gallery_->recognise(described, keys_to_compare(), *config_.recognition, config_.geometry,
                                         config_.seed + static_cast<std::uint64_t>(pictures_seen_));
  for (const bool vouching : {false, true}) {
    for (const RecognisedKey& key : found) {
      const auto agreeing = static_cast<int>(key.estimate.inliers.size());
      if (vouching && agreeing < config_.recognition->vouching) continue;
      Repeater tried = *this;
      Located there;
      tried.follower_.lose_all();
      if (!tried.try_at(key, vouching ? agreeing : 0, picture, there)) continue;
      *this = std::move(tried);
      located = std::move(there);
      return true;
    }
  }
  return false;
}

}  // namespace homeward::repeat
