// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <stop_token>
#include <vector>

#include "map/graph.hpp"
#include "map/topological_map.hpp"

namespace homeward::mapping {

struct CommonFeaturesConfig {
  double far_m = 10.0;    // along edges; nearer places may see the same things
  int far_hops = 12;      // the same where lengths are no metres
  int most_places = 128;  // compared with each place: of all that are far those that look most like it
};

/// For each place those known to be so far away that they cannot show the same things, ascending: joined with it by
/// edges (either way, blocked ones too), by no shorter way than `far_m` or `far_hops`, and no loop between the two is
/// undecided. Whatever is not joined may be anywhere, next door too.
/// Ours, for the document frequencies of matching/distinctiveness.hpp: docs/experiments/common_features.md.
std::vector<std::vector<int>> far_places(const map::TopologicalMap& map, const CommonFeaturesConfig& config);

/// Gives the SIFT features of every place and destination their document frequency: how many far places have the like.
/// Where no place is far they stay without. Does not depend on `threads`. False when stopped: the map is then as it
/// was.
bool count_common_features(map::TopologicalMap& map, const CommonFeaturesConfig& config, int threads,
                           const std::stop_token& stop);

/// The same for other pictures. The map must outlive it; several threads may ask at once.
class CommonFeatures {
 public:
  CommonFeatures(const map::TopologicalMap& map, const CommonFeaturesConfig& config);
  ~CommonFeatures();
  /// Of features seen at this place (an index into map.places); empty where no place is far from it.
  [[nodiscard]] std::vector<std::uint8_t> frequency(const features::FeatureSet& set, int place) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace homeward::mapping
