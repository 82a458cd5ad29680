// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

#include "core/index.hpp"
#include "repeat/teach.hpp"
#include "support/taught_room.hpp"

namespace homeward::testing {

/// A path through a painted room that was taught, with the pictures of its key images.
struct ShortPath {
  explicit ShortPath(std::vector<Pose2> along) : poses(std::move(along)) {
    repeat::TeachConfig config;
    config.most_features = 120;  // the room has texture everywhere
    auto teacher = repeat::Teacher::create(config, camera).value();
    for (const Pose2& pose : poses) EXPECT_TRUE(teacher.add(pyramid_at({}, pose, *camera)));
    path = std::make_shared<const repeat::TaughtPath>(teacher.path().value());
    for (const repeat::KeyImage& key : path->key_images) {
      pictures.push_back(
          std::make_shared<const tracking::ImagePyramid>(pyramid_at({}, poses[at(key.picture)], *camera)));
    }
  }
  /// Where a key image was taken.
  [[nodiscard]] const Pose2& pose_of(int key) const { return poses[at(path->key_images[at(key)].picture)]; }

  std::shared_ptr<const camera::Camera> camera = camera::Camera::create(small_lens_camera()).value();
  std::vector<Pose2> poses;
  std::shared_ptr<const repeat::TaughtPath> path;
  std::vector<std::shared_ptr<const tracking::ImagePyramid>> pictures;  // of the key images
};

/// A pose to the left of another one.
inline Pose2 aside(Pose2 pose, double left_m) {
  pose.x_m -= left_m * std::sin(pose.theta_rad);
  pose.y_m += left_m * std::cos(pose.theta_rad);
  return pose;
}

}  // namespace homeward::testing
