// SPDX-License-Identifier: Apache-2.0
#include "wire/link_companion.hpp"

#include <nlohmann/json.hpp>

#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr std::int64_t kMostCompanionPictures = 100'000;
constexpr double kFarthestOdometry_m = 1e6;
constexpr double kFarthestAgreement_m = 1e3;
constexpr int kAgreementsFrom = 5;  // version of the link

json companion_pose_to_json(const Pose2& pose) {
  return {{"x_m", pose.x_m}, {"y_m", pose.y_m}, {"theta_rad", pose.theta_rad}};
}

ExplorationId read_exploration_of(ObjectReader& reader, const std::string& key) {
  ExplorationId id(reader.text(key, 100));
  if (id.empty()) reader.problem(key, "'" + key + "' must not be empty.");
  return id;
}

Pose2 read_companion_pose(ObjectReader& outer, const std::string& key, double farthest_m) {
  constexpr double kMostHeading_rad = 3.2;
  ObjectReader reader(outer.value(key), outer.path_of(key));
  const Pose2 pose{reader.number("x_m", -farthest_m, farthest_m), reader.number("y_m", -farthest_m, farthest_m),
                   reader.number("theta_rad", -kMostHeading_rad, kMostHeading_rad)};
  outer.close(reader);
  return pose;
}

std::vector<CompanionAgreement> read_companion_agreements(ObjectReader& reader) {
  std::vector<CompanionAgreement> agreements;
  const json& version = reader.value("v");
  if (version.is_number_integer() && version < kAgreementsFrom) return agreements;
  const std::vector<json> items = reader.array("agreements", kMostCompanionAgreements);
  for (std::size_t i = 0; i < items.size(); ++i) {
    ObjectReader item(items[i], reader.path_of("agreements") + "/" + std::to_string(i));
    CompanionAgreement one;
    one.own = item.integer("own", 0, kMostCompanionPictures - 1);
    one.others = item.integer("others", 0, kMostCompanionPictures - 1);
    one.own_from_others = read_companion_pose(item, "own_from_others", kFarthestAgreement_m);
    one.own_looked = item.boolean("own_looked");
    reader.close(item);
    agreements.push_back(one);
  }
  return agreements;
}

std::optional<Eigen::Vector2d> read_companion_target(ObjectReader& reader) {
  constexpr double kFarthest_m = 1e5;
  if (reader.value("target").is_null()) return std::nullopt;
  const std::vector<double> at_m = reader.numbers("target", 2);
  if (at_m.size() != 2) return std::nullopt;
  Eigen::Vector2d target_m(at_m[0], at_m[1]);
  if (!(target_m.cwiseAbs().maxCoeff() <= kFarthest_m)) reader.problem("target", "'target' must lie within 100 km.");
  return target_m;
}

}  // namespace

void add_fields(json& value, const Companion& m) {
  value["exploration"] = m.exploration.str();
  value["with"] = or_null(m.with);
}

void add_fields(json& value, const CompanionView& m) {
  value["exploration"] = m.exploration.str();
  value["index"] = m.index;
  value["view"] = kept_view_to_json(m.view);
  value["appearance"] = json::binary(m.appearance);
}

void add_fields(json& value, const CompanionState& m) {
  value["exploration"] = m.exploration.str();
  value["pictures"] = m.pictures;
  value["odometry"] = companion_pose_to_json(m.odometry);
  value["target"] = nullptr;
  if (m.target_m) value["target"] = {m.target_m->x(), m.target_m->y()};
  value["drives"] = m.drives;
  value["has"] = m.has;
  value["agreements"] = json::array();
  for (const CompanionAgreement& one : m.agreements)
    value["agreements"].push_back({{"own", one.own},
                                   {"others", one.others},
                                   {"own_from_others", companion_pose_to_json(one.own_from_others)},
                                   {"own_looked", one.own_looked}});
}

Companion read_companion(ObjectReader& reader) {
  Companion m;
  m.exploration = read_exploration_of(reader, "exploration");
  if (!reader.value("with").is_null()) m.with = read_exploration_of(reader, "with");
  return m;
}

CompanionView read_companion_view(ObjectReader& reader) {
  CompanionView m;
  m.exploration = read_exploration_of(reader, "exploration");
  m.index = reader.integer("index", 0, kMostCompanionPictures - 1);
  m.view = reader.take(kept_view_from_json(reader.value("view"), reader.path_of("view")));
  const json& appearance = reader.value("appearance");
  if (appearance.is_binary() && appearance.get_binary().size() <= kMostCompanionBytes) {
    m.appearance = appearance.get_binary();
  } else {
    reader.problem("appearance", "'appearance' must be bytes, at most 2 MiB.");
  }
  return m;
}

CompanionState read_companion_state(ObjectReader& reader) {
  CompanionState m;
  m.exploration = read_exploration_of(reader, "exploration");
  m.pictures = reader.integer("pictures", 0, kMostCompanionPictures);
  m.odometry = read_companion_pose(reader, "odometry", kFarthestOdometry_m);
  m.target_m = read_companion_target(reader);
  m.drives = reader.boolean("drives");
  m.has = reader.integer("has", 0, kMostCompanionPictures);
  m.agreements = read_companion_agreements(reader);
  return m;
}

}  // namespace homeward::wire
