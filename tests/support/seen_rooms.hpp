// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <memory>

#include "camera/camera.hpp"
#include "core/ids.hpp"
#include "localisation/localiser.hpp"
#include "support/shaded_room.hpp"

namespace homeward::testing {

/// Two rooms, as they are drawn and as a camera all around sees them.
class SeenRooms {
 public:
  [[nodiscard]] const linemodel::Plan& plan() const { return plan_; }
  /// Made when first asked for, and kept: tests drive the same ways. Not thread-safe.
  const std::shared_ptr<const Image>& from(const Pose2& robot) {
    std::shared_ptr<const Image>& picture = pictures_[{robot.x_m, robot.y_m, robot.theta_rad}];
    if (!picture) {
      picture = std::make_shared<const Image>(linemodel::shaded_picture(plan_, rays_, *camera_, robot));
    }
    return picture;
  }

 private:
  linemodel::Plan plan_ = linemodel::two_rooms();
  raycast::RayScene rays_{plan_.vertices_m, plan_.triangles};
  std::shared_ptr<const camera::Camera> camera_ = camera::Camera::create(linemodel::small_panorama()).value();
  std::map<std::array<double, 3>, std::shared_ptr<const Image>> pictures_;
};

/// Made once for all tests of a program.
inline SeenRooms& seen_rooms() {
  static SeenRooms rooms;
  return rooms;
}

inline localisation::Belief sure_of(const PlaceId& place) {
  localisation::Belief belief;
  belief.updates = 5;
  belief.top = {{place, 0.95}};
  belief.near_share = belief.near_probability = 0.99;
  return belief;
}

}  // namespace homeward::testing
