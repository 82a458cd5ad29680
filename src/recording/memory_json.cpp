// SPDX-License-Identifier: Apache-2.0
#include "recording/memory_json.hpp"

#include <cmath>
#include <limits>

#include "recording/json_fields.hpp"

namespace homeward::driving {

// The fields find these by the namespace of their members' types, and no unnamed namespace lets them.

using nlohmann::json;

static json numbers_of(const std::deque<Eigen::Vector2d>& points_m) {
  json value = json::array();
  for (const Eigen::Vector2d& point_m : points_m) value.push_back({point_m.x(), point_m.y()});
  return value;
}

static Eigen::Vector2d point_of(const json& value) { return {value.at(0).get<double>(), value.at(1).get<double>()}; }

static json numbers_of(const Pose2& pose) { return {pose.x_m, pose.y_m, pose.theta_rad}; }

static Pose2 pose_of(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

/// JSON knows neither infinity (here null: nothing was met) nor NaN (here -1: the ray failed).
static json numbers_of(const Scan& scan) {
  json ranges_m = json::array();
  for (const float range_m : scan.ranges_m) {
    if (std::isnan(range_m)) {
      ranges_m.push_back(-1.0);
    } else {
      ranges_m.push_back(std::isfinite(range_m) ? json(range_m) : json());
    }
  }
  return {{"ranges_m", ranges_m},
          {"angle_min_rad", scan.angle_min_rad},
          {"angle_step_rad", scan.angle_step_rad},
          {"range_max_m", scan.range_max_m},
          {"robot_from_scan", numbers_of(scan.robot_from_scan)}};
}

static Scan scan_of(const json& value) {
  Scan scan;
  for (const json& range : value.at("ranges_m")) {
    const float range_m = range.is_null() ? std::numeric_limits<float>::infinity() : range.get<float>();
    scan.ranges_m.push_back(range_m < 0.0F ? std::numeric_limits<float>::quiet_NaN() : range_m);
  }
  scan.angle_min_rad = value.at("angle_min_rad").get<double>();
  scan.angle_step_rad = value.at("angle_step_rad").get<double>();
  scan.range_max_m = value.at("range_max_m").get<double>();
  scan.robot_from_scan = pose_of(value.at("robot_from_scan"));
  return scan;
}

/// What is left of making room for somebody when a mission begins (`begin_way`).
static json numbers_of(const GiveWay& way) {
  return {{"trail_m", numbers_of(way.trail_m)},
          {"blocked_at_m", {way.blocked_at_m.x(), way.blocked_at_m.y()}},
          {"times", way.times}};
}

static void take(const json& value, GiveWay& way) {
  for (const json& point : value.at("trail_m")) way.trail_m.push_back(point_of(point));
  way.blocked_at_m = point_of(value.at("blocked_at_m"));
  way.times = value.at("times").get<int>();
}

static json numbers_of(const MovingObstacle& obstacle) {
  const auto& [before, before_from, before_ms, seen_ms] = obstacle;
  return {{"before", before ? numbers_of(*before) : json()},
          {"before_from", numbers_of(before_from)},
          {"before_ms", before_ms},
          {"seen_ms", seen_ms ? json(*seen_ms) : json()}};
}

static void take(const json& value, MovingObstacle& obstacle) {
  if (const json& before = value.at("before"); !before.is_null()) obstacle.before = scan_of(before);
  obstacle.before_from = pose_of(value.at("before_from"));
  obstacle.before_ms = value.at("before_ms").get<std::int64_t>();
  if (const json& seen = value.at("seen_ms"); !seen.is_null()) obstacle.seen_ms = seen.get<std::int64_t>();
}

static json numbers_of(const SweepContinuity& continuity) {
  return {{"before", continuity.before ? numbers_of(*continuity.before) : json()},
          {"odometry", numbers_of(continuity.odometry)},
          {"before_ms", continuity.before_ms},
          {"latest_ms", continuity.latest_ms},
          {"usual", continuity.usual},
          {"broken_since_ms", continuity.broken_since_ms ? json(*continuity.broken_since_ms) : json()}};
}

static void take(const json& value, SweepContinuity& continuity) {
  if (const json& before = value.at("before"); !before.is_null()) continuity.before = scan_of(before);
  continuity.odometry = pose_of(value.at("odometry"));
  continuity.before_ms = value.at("before_ms").get<std::int64_t>();
  continuity.usual = value.at("usual").get<double>();
  continuity.latest_ms = value.at("latest_ms").get<std::int64_t>();
  if (const json& since = value.at("broken_since_ms"); !since.is_null())
    continuity.broken_since_ms = since.get<std::int64_t>();
}

static json numbers_of(const std::optional<KeptEstimate>& kept) {
  if (!kept) return {};
  json all = json::array();
  for (const PoseHypothesis& one : kept->hypotheses.all()) {
    json covariance = json::array();
    for (const double number : one.covariance.reshaped()) covariance.push_back(number);
    all.push_back({{"pose", numbers_of(one.map_from_robot)},
                   {"covariance", covariance},
                   {"weight", one.weight},
                   {"record", {one.record.log_share, one.record.variance, one.record.pictures, one.record.pending}}});
  }
  return {{"map", kept->map.str()},
          {"revision", kept->revision},
          {"hypotheses", all},
          {"elsewhere", kept->hypotheses.elsewhere()},
          {"unweighed_m", kept->hypotheses.unweighed_m()},
          {"odometry", numbers_of(kept->odometry)},
          {"at_ms", kept->at_ms}};
}

static void take(const json& value, std::optional<KeptEstimate>& kept) {
  if (value.is_null()) return;
  std::vector<PoseHypothesis> all;
  for (const json& one : value.at("hypotheses")) {
    PoseHypothesis hypothesis;
    hypothesis.map_from_robot = pose_of(one.at("pose"));
    for (int i = 0; i < 9; ++i) hypothesis.covariance(i) = one.at("covariance").at(static_cast<std::size_t>(i));
    hypothesis.weight = one.at("weight").get<double>();
    const json& record = one.at("record");
    hypothesis.record = {record.at(0).get<double>(), record.at(1).get<double>(), record.at(2).get<double>(),
                         record.at(3).get<double>()};
    all.push_back(hypothesis);
  }
  if (all.empty()) return;
  // The configuration is the mission's own, which is not known yet.
  kept = KeptEstimate{
      MapId(value.at("map").get<std::string>()), value.at("revision").get<std::int64_t>(),
      PoseHypotheses({}, std::move(all), value.at("elsewhere").get<double>(), value.at("unweighed_m").get<double>()),
      pose_of(value.at("odometry")), value.at("at_ms").get<std::int64_t>()};
}

}  // namespace homeward::driving

namespace homeward::recording {
namespace {

/// Not all of the state: a new mission makes the rest anew.
template <class Fields, class State>
void memory_fields(Fields& fields, State& s) {
  fields("epoch", s.newest.epoch);
  fields("seq", s.newest.seq);
  fields("least_epoch", s.least_epoch);
  fields("pictures", s.pictures);
  fields("covered", s.covered);
  fields("refuses_until_ms", s.refuses_until_ms);
  fields("questions", s.asking.number);
  fields("give_way", s.give_way);
  fields("stirring", s.moving_obstacle);
  fields("going_on", s.going_on);
  fields("kept_estimate", s.kept);
}

}  // namespace

std::string memory_to_json(const driving::DrivingState& before) {
  WriteFields fields;
  memory_fields(fields, before);
  return fields.value.dump();
}

Result<driving::DrivingState> memory_from_json(const std::string& text) {
  return read_fields<driving::DrivingState>(text, "memories of before",
                                            [](auto& fields, auto& s) { memory_fields(fields, s); });
}

}  // namespace homeward::recording
