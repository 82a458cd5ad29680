// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.hpp"
#include "core/pose2.hpp"
#include "sim/box.hpp"
#include "wire/scenario_json.hpp"

namespace homeward::scenario {

/// What goes wrong during a mission, and when.
class FaultSchedule {
 public:
  explicit FaultSchedule(std::vector<wire::ScenarioFault> faults) : faults_(std::move(faults)) {}

  [[nodiscard]] bool active(wire::FaultKind kind, double t_s) const;
  /// The largest share of the active faults of a kind; 0 when there is none.
  [[nodiscard]] double share(wire::FaultKind kind, double t_s) const;
  /// When the latest fault of those that are on at `t_s`, or were half a second ago, began.
  [[nodiscard]] std::optional<double> began_s(double t_s) const;
  /// When the last of the faults that have begun by `t_s` ends; 0 when there is none.
  [[nodiscard]] double ends_s(double t_s) const;
  [[nodiscard]] const std::vector<wire::ScenarioFault>& all() const { return faults_; }

 private:
  std::vector<wire::ScenarioFault> faults_;
};

/// Covers a share of the picture, from the left.
void occlude(Image& picture, double share);

/// A box in the way: 1.5 m ahead along the way over `ahead_m` (a robot's next true positions), or further where that
/// would be less than 1 m from the robot itself. Nothing where the way ends before.
std::optional<sim::Box> box_ahead(const Pose2& robot, const std::vector<Eigen::Vector2d>& ahead_m);

}  // namespace homeward::scenario
