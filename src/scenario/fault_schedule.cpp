// SPDX-License-Identifier: Apache-2.0
#include "scenario/fault_schedule.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::scenario {
namespace {

bool is_active(const wire::ScenarioFault& fault, double t_s) {
  return t_s >= fault.at_s && t_s < fault.at_s + fault.for_s;
}

}  // namespace

bool FaultSchedule::active(wire::FaultKind kind, double t_s) const {
  return std::ranges::any_of(faults_, [&](const auto& fault) { return fault.kind == kind && is_active(fault, t_s); });
}

double FaultSchedule::share(wire::FaultKind kind, double t_s) const {
  double share = 0.0;
  for (const wire::ScenarioFault& fault : faults_) {
    if (fault.kind == kind && is_active(fault, t_s)) share = std::max(share, fault.share);
  }
  return share;
}

std::optional<double> FaultSchedule::began_s(double t_s) const {
  constexpr double kAfter_s = 0.5;
  std::optional<double> began_s;
  for (const wire::ScenarioFault& fault : faults_) {
    if (fault.at_s <= t_s && t_s <= fault.at_s + fault.for_s + kAfter_s)
      began_s = std::max(began_s.value_or(fault.at_s), fault.at_s);
  }
  return began_s;
}

double FaultSchedule::ends_s(double t_s) const {
  double ends_s = 0.0;
  for (const wire::ScenarioFault& fault : faults_) {
    if (fault.at_s <= t_s) ends_s = std::max(ends_s, fault.at_s + fault.for_s);
  }
  return ends_s;
}

void occlude(Image& picture, double share) {
  const auto columns = static_cast<std::size_t>(std::lround(share * picture.width_px));
  for (int v = 0; v < picture.height_px; ++v) {
    std::fill_n(picture.at(0, v), columns * static_cast<std::size_t>(picture.channels), std::uint8_t{12});
  }
}

std::optional<sim::Box> box_ahead(const Pose2& robot, const std::vector<Eigen::Vector2d>& ahead_m) {
  constexpr double kAhead_m = 1.5;
  constexpr double kLeast_m = 1.0;
  constexpr double kStep_m = 0.05;
  const Eigen::Vector2d here_m(robot.x_m, robot.y_m);
  Eigen::Vector2d at_m = here_m;
  double gone_m = 0.0;
  for (const Eigen::Vector2d& next_m : ahead_m) {
    const Eigen::Vector2d from_m = at_m;
    const double piece_m = (next_m - from_m).norm();
    for (double along_m = 0.0; along_m < piece_m; along_m += kStep_m) {
      at_m = from_m + (next_m - from_m) * (along_m / piece_m);
      if (gone_m + along_m < kAhead_m || (at_m - here_m).norm() < kLeast_m) continue;
      sim::Box box;
      box.pose = {at_m.x(), at_m.y(), std::atan2(next_m.y() - from_m.y(), next_m.x() - from_m.x())};
      return box;
    }
    gone_m += piece_m;
    at_m = next_m;
  }
  return std::nullopt;
}

}  // namespace homeward::scenario
