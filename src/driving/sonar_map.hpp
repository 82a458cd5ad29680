// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/pose2.hpp"
#include "driving/scan.hpp"

namespace homeward::driving {

/// The cone that one ultrasound sensor measures in, as in SonarConfig.
struct SonarCone {
  double half_cone_rad = 0.0;
  double range_min_m = 0.0;
  double range_max_m = 0.0;
};

/// What one ultrasound sensor says: the nearest thing within its cone is that far; infinite: none within its reach.
struct SonarReading {
  Pose2 robot_from_sonar;  // heading: the middle of the cone
  float range_m = 0.0F;
  std::optional<SonarCone> cone = {};  // of this sensor, where a ring has various ones; nothing: that of the config
};

struct SonarConfig {
  double half_cone_rad = 0.2618;  // 30 degrees in all
  double range_min_m = 0.2;       // nearer things read as this
  double range_max_m = 3.0;       // of the sensor that measures farthest
  double tolerance_m = 0.03;      // of a reading
  double half_arc_m = 0.15;       // from the middle of an arc on no more than this counts
};

/// A short memory of what a ring of ultrasound sensors said, as a sweep that the rest of the agent understands. A
/// reading says that something is on its arc and nothing before it, but not where on the arc; so all of the arc counts
/// as things until another reading's cone shows part of it to be free (arcs and cones: Elfes, "Sonar-based real-world
/// mapping and navigation", IEEE J. Robotics and Automation 3(3), 1987, section III, here without probabilities: what
/// may be there counts as there). Of arcs far away only the middle counts, or no door would seem open; on the way there
/// they are measured again from so near that all of them counts. Nor does what was seen to be free a moment ago, if the
/// rest of the arc can be where the thing is.
class SonarMap {
 public:
  explicit SonarMap(SonarConfig config = {}) : config_(config) {}

  /// All sensors' readings of one moment. The sweep's rays start at the robot's turning point.
  Scan update(const std::vector<SonarReading>& readings, const Pose2& odometry);

 private:
  struct Maybe {
    Eigen::Vector2d at_m;  // in odometry's frame
    int since = 0;         // the update it was last said to be there
  };
  SonarConfig config_;
  std::vector<Maybe> maybe_;
  /// What one reading showed to be free.
  struct Free {
    Eigen::Vector2d from_m;
    Eigen::Vector2d direction;
    double reach_m = 0.0;
    double half_cone_rad = 0.0;
    int update = 0;
  };
  [[nodiscard]] bool was_free(const Eigen::Vector2d& at_m) const;
  [[nodiscard]] SonarCone cone_of(const SonarReading& reading) const {
    return reading.cone.value_or(SonarCone{config_.half_cone_rad, config_.range_min_m, config_.range_max_m});
  }
  [[nodiscard]] std::vector<Eigen::Vector2d> arc(const Pose2& sonar, double range_m, double half_cone_rad) const;
  std::vector<Free> free_;
  int updates_ = 0;
};

}  // namespace homeward::driving
