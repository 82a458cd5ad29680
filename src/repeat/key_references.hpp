// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "camera/camera.hpp"
#include "core/result.hpp"
#include "geometry/seen_point.hpp"
#include "repeat/taught_path.hpp"
#include "tracking/feature_tracker.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::repeat {

/// How the features of a key image look in it, for a tracker.
class KeyReferences {
 public:
  /// References of those features of a key image that are in one of the arcs beside it. Features that show too little
  /// have none. Errors: those of the tracker's configuration.
  static Result<KeyReferences> make(const TaughtPath& path, int key, const tracking::ImagePyramid& picture,
                                    const camera::Camera& camera, const tracking::FeatureTrackerConfig& config);

  [[nodiscard]] int key() const { return key_; }
  [[nodiscard]] const tracking::FeatureTracker& tracker() const { return tracker_; }
  /// The number of a feature's reference in the tracker; nothing where it has none.
  [[nodiscard]] std::optional<std::size_t> reference_of(int feature) const;
  /// Where a feature is in the key image. Precondition: it has a reference.
  [[nodiscard]] const geometry::SeenPoint& seen(std::size_t reference) const { return seen_[reference]; }

 private:
  KeyReferences(int key, tracking::FeatureTracker tracker) : key_(key), tracker_(std::move(tracker)) {}

  int key_ = 0;
  tracking::FeatureTracker tracker_;
  std::unordered_map<int, std::size_t> references_;  // by feature
  std::vector<geometry::SeenPoint> seen_;            // as many as references
};

}  // namespace homeward::repeat
