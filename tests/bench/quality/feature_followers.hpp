// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/image.hpp"
#include "tracking/feature_tracker.hpp"

namespace homeward::bench {

/// One way to follow points from picture to picture. All begin at the same points and know nothing of the motion: each
/// looks for a point where it was in the picture before.
class Follower {
 public:
  virtual ~Follower() = default;
  virtual void start(const Image& grey, const std::vector<Eigen::Vector2d>& points_px) = 0;
  virtual void follow(const Image& grey) = 0;

  std::vector<Eigen::Vector2d> at_px;
  std::vector<bool> is_alive;
  std::vector<tracking::FeatureState> states;  // of the feature tracker alone
};

struct NamedFollower {
  std::string name;
  std::function<std::unique_ptr<Follower>()> make;
};

/// The feature tracker, what is left when one of its parts is switched off, the two others, and both that are used on
/// the strip of a panorama. Precondition: the camera is a pinhole.
std::vector<NamedFollower> all_followers(const camera::CameraConfig& camera);

}  // namespace homeward::bench
