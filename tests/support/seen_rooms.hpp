// SPDX-License-Identifier: Apache-2.0
#pragma once

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
  [[nodiscard]] Image from(const Pose2& robot) const {
    return linemodel::shaded_picture(plan_, rays_, *camera_, robot);
  }

 private:
  linemodel::Plan plan_ = linemodel::two_rooms();
  raycast::RayScene rays_{plan_.vertices_m, plan_.triangles};
  std::shared_ptr<const camera::Camera> camera_ = camera::Camera::create(linemodel::small_panorama()).value();
};

/// Made once for all tests of a program.
inline const SeenRooms& seen_rooms() {
  static const SeenRooms rooms;
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
