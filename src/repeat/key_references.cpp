// SPDX-License-Identifier: Apache-2.0
#include "repeat/key_references.hpp"

#include <algorithm>
#include <span>
#include <unordered_set>
#include <utility>

#include "core/index.hpp"
#include "repeat/seen.hpp"

namespace homeward::repeat {

Result<KeyReferences> KeyReferences::make(const TaughtPath& path, int key, const tracking::ImagePyramid& picture,
                                          const camera::Camera& camera, const tracking::FeatureTrackerConfig& config) {
  auto tracker = tracking::FeatureTracker::create(config);
  if (!tracker) return pass_on(tracker);
  KeyReferences made(key, *std::move(tracker));
  std::unordered_set<int> wanted;
  for (const Arc& arc : path.arcs) {
    if (arc.from != key && path.to_key(arc) != key) continue;
    for (const ArcMatch& match : arc.matches) wanted.insert(match.feature);
  }
  for (const KeyFeature& feature : path.key_images[at(key)].features) {
    if (!wanted.contains(feature.feature)) continue;
    const auto seen = seen_at(camera, feature.pixel_px);
    if (!seen) continue;
    const auto states = made.tracker_.add(picture, std::span(&feature.pixel_px, 1));
    if (states.front() != tracking::ReferenceState::kTaken) continue;
    made.references_.emplace(feature.feature, made.seen_.size());
    made.seen_.push_back(*seen);
  }
  return made;
}

std::optional<std::size_t> KeyReferences::reference_of(int feature) const {
  const auto found = references_.find(feature);
  if (found == references_.end()) return std::nullopt;
  return found->second;
}

}  // namespace homeward::repeat
