// SPDX-License-Identifier: Apache-2.0
#include "pipeline/targets_of_map.hpp"

#include <cstddef>
#include <cstdint>

#include "matching/visual_distance.hpp"

namespace homeward::pipeline {

TargetsOfMap::TargetsOfMap(const map::TopologicalMap& map) : map_(map), common_(map, {}) {}

void TargetsOfMap::ask(features::Appearance& target) const {
  constexpr std::uint64_t kSeed = 1;
  target.sift.document_frequency.clear();
  int best = -1;
  int most = 0;
  for (std::size_t place = 0; place < map_.places.size(); ++place) {
    for (const features::Appearance& known : map_.places[place].appearances) {
      const int verified = matching::compare(known, target, {}, kSeed).verified;
      if (verified <= most) continue;
      most = verified;
      best = static_cast<int>(place);
    }
  }
  if (best >= 0) target.sift.document_frequency = common_.frequency(target.sift, best);
}

}  // namespace homeward::pipeline
