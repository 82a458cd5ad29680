// SPDX-License-Identifier: Apache-2.0
#include "wire/plan_pose_json.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

double in_hundredths(double value) { return std::round(100.0 * value) / 100.0; }

// What both are told of a picture: of a robot now, and of a mission later.
nlohmann::json said(const PlanPoseView& view) {
  const auto unless_lost = [&](double value) { return view.lost ? nlohmann::json(nullptr) : finite_or_null(value); };
  const nlohmann::json lost =
      view.lost ? nlohmann::json(std::string(kPlanLossNames.name(*view.lost))) : nlohmann::json(nullptr);
  return {{"t_us", view.t_us},
          {"plan", view.plan.str()},
          {"version", view.version},
          {"x_m", unless_lost(view.pose.x_m)},
          {"y_m", unless_lost(view.pose.y_m)},
          {"theta_rad", unless_lost(view.pose.theta_rad)},
          {"spread_m", unless_lost(view.spread_m)},
          {"lost", lost},
          {"place", or_null(view.place)},
          {"word", std::string(kPlaceOnPlanNames.name(view.word))},
          {"lines_expected", view.lines_expected},
          {"lines_confirmed", view.lines_confirmed}};
}

}  // namespace

nlohmann::json plan_pose_to_json(const PlanPoseView& view) {
  nlohmann::json particles = nlohmann::json::array();
  for (const Pose2& one : view.particles) {
    particles.push_back({{"x_m", in_hundredths(one.x_m)},
                         {"y_m", in_hundredths(one.y_m)},
                         {"theta_rad", in_hundredths(one.theta_rad)}});
  }
  nlohmann::json value = said(view);
  value["robot"] = view.robot.str();
  value["map"] = view.map.str();
  value["tied_us"] = view.tied_us;
  value["particles"] = std::move(particles);
  return value;
}

nlohmann::json mission_plan_to_json(const MissionId& mission, const std::vector<PlanPoseView>& poses) {
  nlohmann::json list = nlohmann::json::array();
  for (const PlanPoseView& pose : poses) list.push_back(said(pose));
  return {{"mission", mission.str()}, {"poses", std::move(list)}};
}

}  // namespace homeward::wire
