// SPDX-License-Identifier: Apache-2.0
#include "wire/tracked_json.hpp"

#include <nlohmann/json.hpp>

#include "wire/json_reader.hpp"

namespace homeward::wire {

nlohmann::json tracked_to_json(const TrackedView& view) {
  const bool lost = !view.lost.empty();
  nlohmann::json value{{"image", view.image},
                       {"particles", view.particles},
                       {"lines_seen", view.lines_seen},
                       {"lines_expected", view.lines_expected},
                       {"lines_confirmed", view.lines_confirmed},
                       {"evidence", view.evidence},
                       {"lost", lost},
                       {"may_be", nlohmann::json::array()},
                       {"ms", view.ms}};
  value["why_lost"] = lost ? nlohmann::json(view.lost) : nlohmann::json();
  // Where nobody knows the place, no number may be taken for one.
  const auto known = [&](const char* key, double number) {
    value[key] = lost ? nlohmann::json() : nlohmann::json(number);
  };
  known("x_m", view.pose.x_m);
  known("y_m", view.pose.y_m);
  known("theta_rad", view.pose.theta_rad);
  known("spread_m", view.spread_m);
  for (const BelievedPose& one : view.may_be) {
    value["may_be"].push_back({{"x_m", one.pose.x_m},
                               {"y_m", one.pose.y_m},
                               {"theta_rad", one.pose.theta_rad},
                               {"probability", one.probability}});
  }
  return value;
}

Result<TrackedPose> tracked_pose_from_json(const nlohmann::json& value, const std::string& path) {
  if (!value.is_object()) return fail(ErrorCode::kInvalidInput, "This is no line of homeward track.", path);
  nlohmann::json asked = nlohmann::json::object();
  for (const char* key : {"image", "lost", "x_m", "y_m", "theta_rad", "spread_m"}) {
    if (value.contains(key)) asked[key] = value[key];
  }
  ObjectReader reader(asked, path);
  TrackedPose tracked;
  tracked.image = reader.text("image");
  const bool lost = reader.boolean("lost");
  if (!lost) {
    tracked.pose = Pose2{reader.number("x_m"), reader.number("y_m"), reader.number("theta_rad", -4.0, 4.0)};
    tracked.spread_m = reader.number("spread_m", 0.0, 1e6);
  } else {
    for (const char* key : {"x_m", "y_m", "theta_rad", "spread_m"}) reader.has(key);
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return tracked;
}

}  // namespace homeward::wire
