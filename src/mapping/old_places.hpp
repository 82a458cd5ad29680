// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mapping/closed_way.hpp"
#include "mapping/growth_input.hpp"
#include "mapping/mapping_config.hpp"
#include "mapping/two_ways.hpp"

namespace homeward::mapping {

/// An old map beside new tours: which images are its places, where these lie, and how far it bears out that a new image
/// shows one of them. Its way is that of its odometry, held together by its edges: a map keeps of its pictures what
/// edges tell, the turn and the bearing from one prototype to the next. Those that the odometry excludes do not count.
/// Ours: docs/experiments/maps_that_grow.md.
class OldPlaces {
 public:
  /// `metric`: whether the new tours have odometry. The arguments outlive this.
  OldPlaces(const map::TopologicalMap& old, const GrowthInput& input, const PairTable& pairs, bool metric,
            const MappingConfig& config);
  OldPlaces(const OldPlaces&) = delete;
  OldPlaces& operator=(const OldPlaces&) = delete;

  [[nodiscard]] bool is_old(int image) const { return input_.is_anchor(image); }
  /// Index of the place of an old image.
  [[nodiscard]] int place(int image) const { return input_.anchored(image); }
  /// The places that edges join with this one, ascending.
  [[nodiscard]] const std::vector<int>& adjoining(int place) const {
    return adjoining_[static_cast<std::size_t>(place)];
  }
  /// Where each image of the input lies along its tour, in images; far apart for different tours.
  [[nodiscard]] const std::vector<double>& positions() const { return positions_; }

  /// "The new image shows the place of this old one."
  struct Claim {
    int image = 0;
    int anchor = 0;
  };
  /// How far looks can be trusted for a claim.
  struct Trust {
    double factor = 1.0;     // how far they were right in the old map where its way could tell, and how far old and new
                             // way bear the claim out
    bool borne_out = false;  // by so many others that it does not matter how far looks were right: `factor` is all
    bool operator==(const Trust&) const = default;
  };
  /// `open`: the new way; `closed`, or null: with its loops.
  [[nodiscard]] std::vector<Trust> trust(std::span<const Claim> claims, const TourTrack& open,
                                         const ClosedWay* closed) const;
  /// The claims, all of them believed, that others of them exclude; 1 for each such one.
  [[nodiscard]] std::vector<char> excluded(std::span<const Claim> claims, const TourTrack& open,
                                           const ClosedWay* closed) const;

 private:
  [[nodiscard]] std::vector<MeetingTrust> weighed(std::span<const Claim> claims, const TourTrack& open,
                                                  const ClosedWay* closed) const;

  const GrowthInput& input_;
  const PairTable& pairs_;
  const MappingConfig& config_;
  std::vector<double> positions_;
  std::vector<int> old_image_;               // of each anchor: that of its place's prototype; -1: the map has none
  std::vector<std::vector<int>> adjoining_;  // of each place, ascending
  double reliability_ = 1.0;                 // of looks, in the old map
  bool metric_;
  PairTable unknown_;  // of its pictures the map keeps no relations
  std::optional<TourTrack> way_;
  std::optional<ClosedWay> closed_way_;
};

}  // namespace homeward::mapping
