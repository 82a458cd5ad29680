// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <iterator>
#include <utility>
#include <vector>

#include "pipeline/refine_map.hpp"

namespace homeward::server {

/// What a robot saw on its present mission that its map may learn from: some pictures' features, no pixels. Bounded:
/// the newest sights, some time apart, of a limited number of features.
class DriveSights {
 public:
  /// A sight is due when the one before was taken long enough ago, so that the next one bears out where it was taken.
  [[nodiscard]] bool due(TimeUs t_us) const { return sights_.empty() || std::abs(t_us - last_us_) >= kApartUs; }
  /// `place`: that the belief is sure of, or empty.
  void add(TimeUs t_us, PlaceId place, const features::Appearance& seen) {
    last_us_ = t_us;
    sights_.push_back(
        {place.empty() ? features::Appearance() : mapping::thinned(seen, kMostFeatures), std::move(place)});
    if (sights_.size() > kMostSights) sights_.pop_front();
  }
  void clear() { sights_.clear(); }
  /// All of them, in driving order; none are left. Empty when none names a place.
  std::vector<pipeline::DriveSight> take() {
    std::vector<pipeline::DriveSight> all(std::make_move_iterator(sights_.begin()),
                                          std::make_move_iterator(sights_.end()));
    sights_.clear();
    const bool any = std::any_of(all.begin(), all.end(), [](const auto& sight) { return !sight.place.empty(); });
    return any ? std::move(all) : std::vector<pipeline::DriveSight>();
  }

 private:
  static constexpr TimeUs kApartUs = 1'000'000;    // 0.4 m at top speed
  static constexpr std::size_t kMostSights = 120;  // about 4 MB with the usual 750 features each
  static constexpr int kMostFeatures = 600;        // of each kind
  std::deque<pipeline::DriveSight> sights_;
  TimeUs last_us_ = 0;
};

}  // namespace homeward::server
