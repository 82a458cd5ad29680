// SPDX-License-Identifier: Apache-2.0
#include "wire/exploration_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/enum_names.hpp"
#include "wire/json_reader.hpp"
#include "wire/json_write.hpp"
#include "wire/reason_json.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr EnumNames<ExplorationPhase, 5> kPhases({"waiting", "exploring", "paused", "ended", "uploaded"});
constexpr double kFarthest_m = 1e5;
constexpr double kMostHeading_rad = 3.2;
constexpr std::int64_t kMostPictures = 100'000;
constexpr std::size_t kMostNodes = 20'000;
constexpr int kMostCells = 1000;  // of a row or a column
constexpr std::size_t kMostRuns = 200'000;
constexpr std::int64_t kFloorKinds = 4;
constexpr std::size_t kLeastCorners = 3;

json point_to_json(const Eigen::Vector2d& point_m) { return {point_m.x(), point_m.y()}; }

json points_to_json(const std::vector<Eigen::Vector2d>& points_m) {
  json list = json::array();
  for (const Eigen::Vector2d& point_m : points_m) list.push_back(point_to_json(point_m));
  return list;
}

std::optional<Eigen::Vector2d> point_from_json(const json& value) {
  if (!value.is_array() || value.size() != 2 || !value[0].is_number() || !value[1].is_number()) return std::nullopt;
  const Eigen::Vector2d point_m(value[0].get<double>(), value[1].get<double>());
  if (!(point_m.cwiseAbs().maxCoeff() <= kFarthest_m)) return std::nullopt;
  return point_m;
}

std::string no_point(const std::string& what) { return what + " must be [x, y] in metres, within 100 km."; }

json floor_to_json(const FloorReport& floor) {
  json runs = json::array();
  for (std::size_t begin = 0; begin < floor.cells.size();) {
    std::size_t end = begin + 1;
    while (end < floor.cells.size() && floor.cells[end] == floor.cells[begin]) ++end;
    runs.push_back(kFloorKinds * static_cast<std::int64_t>(end - begin) +
                   static_cast<std::int64_t>(floor.cells[begin]));
    begin = end;
  }
  return {{"cell_m", floor.cell_m},   {"x_m", floor.origin_m.x()}, {"y_m", floor.origin_m.y()},
          {"columns", floor.columns}, {"rows", floor.rows},        {"runs", std::move(runs)}};
}

std::optional<FloorReport> read_floor(ObjectReader& outer) {
  const json& value = outer.value("floor");
  if (value.is_null()) return std::nullopt;
  ObjectReader reader(value, outer.path_of("floor"));
  FloorReport floor;
  floor.cell_m = reader.number("cell_m", 0.01, 10.0);
  floor.origin_m = {reader.number("x_m", -kFarthest_m, kFarthest_m), reader.number("y_m", -kFarthest_m, kFarthest_m)};
  floor.columns = static_cast<int>(reader.integer("columns", 1, kMostCells));
  floor.rows = static_cast<int>(reader.integer("rows", 1, kMostCells));
  const std::size_t size = static_cast<std::size_t>(floor.columns) * static_cast<std::size_t>(floor.rows);
  for (const json& item : reader.array("runs", kMostRuns)) {
    const std::int64_t run = item.is_number_integer() ? item.get<std::int64_t>() : 0;
    const std::int64_t left = static_cast<std::int64_t>(size - floor.cells.size());
    if (run < kFloorKinds || run / kFloorKinds > left) {
      reader.problem("runs", "'runs' must be as many cells as columns times rows, none empty.");
      break;
    }
    floor.cells.insert(floor.cells.end(), static_cast<std::size_t>(run / kFloorKinds),
                       static_cast<FloorKind>(run % kFloorKinds));
  }
  if (floor.cells.size() != size)
    reader.problem("runs", "'runs' must be as many cells as columns times rows, none empty.");
  outer.close(reader);
  return floor;
}

std::optional<Pose2> read_pose(ObjectReader& outer) {
  const json& value = outer.value("pose");
  if (value.is_null()) return std::nullopt;
  ObjectReader reader(value, outer.path_of("pose"));
  const Pose2 pose{reader.number("x_m", -kFarthest_m, kFarthest_m), reader.number("y_m", -kFarthest_m, kFarthest_m),
                   reader.number("theta_rad", -kMostHeading_rad, kMostHeading_rad)};
  outer.close(reader);
  return pose;
}

std::optional<SharedExploration> read_shared(ObjectReader& outer) {
  const json& value = outer.value("companion");
  if (value.is_null()) return std::nullopt;
  ObjectReader reader(value, outer.path_of("companion"));
  SharedExploration shared{ExplorationId(reader.text("exploration", 100)), reader.boolean("joined"),
                           reader.integer("pictures", 0, kMostPictures)};
  if (shared.exploration.empty()) reader.problem("exploration", "'exploration' must not be empty.");
  outer.close(reader);
  return shared;
}

std::vector<std::array<int, 2>> read_loops(ObjectReader& reader, std::size_t nodes) {
  std::vector<std::array<int, 2>> loops;
  for (const json& item : reader.array("loops", kMostNodes)) {
    const auto names_node = [&](const json& number) {
      return number.is_number_integer() && number >= 0 && number < nodes;
    };
    if (!item.is_array() || item.size() != 2 || !names_node(item[0]) || !names_node(item[1])) {
      reader.problem("loops", "A loop must be the numbers of two nodes.");
      return {};
    }
    loops.push_back({item[0].get<int>(), item[1].get<int>()});
  }
  return loops;
}

}  // namespace

json fences_to_json(const std::vector<Fence>& fences_m) {
  json list = json::array();
  for (const Fence& fence_m : fences_m) list.push_back(points_to_json(fence_m));
  return list;
}

Result<std::vector<Fence>> fences_from_json(const json& value, const std::string& path) {
  if (!value.is_array() || value.size() > kMostFences)
    return fail(ErrorCode::kInvalidInput, "'fences' must be an array of at most 100 fences.", path);
  std::vector<Fence> fences_m;
  for (const json& item : value) {
    const std::string at = path + "/" + std::to_string(fences_m.size());
    if (!item.is_array() || item.size() < kLeastCorners || item.size() > kMostFenceCorners)
      return fail(ErrorCode::kInvalidInput, "A fence must have 3 to 100 corners.", at);
    Fence& fence_m = fences_m.emplace_back();
    for (const json& corner : item) {
      const auto point_m = point_from_json(corner);
      if (!point_m)
        return fail(ErrorCode::kInvalidInput, no_point("A corner"), at + "/" + std::to_string(fence_m.size()));
      fence_m.push_back(*point_m);
    }
  }
  return fences_m;
}

json exploration_to_json(const ExplorationReport& report) {
  json value = {{"id", report.id.str()},
                {"phase", kPhases.name(report.phase)},
                {"reason", reason_to_json(report.reason)},
                {"pictures", report.pictures},
                {"driven_m", report.driven_m},
                {"explored_s", report.explored_s},
                {"unreached", report.unreached},
                {"pose", nullptr},
                {"target", nullptr},
                {"nodes", points_to_json(report.nodes_m)},
                {"loops", report.loops},
                {"floor", nullptr},
                {"fences", fences_to_json(report.fences_m)},
                {"uploaded", report.uploaded},
                {"tour", or_null(report.tour)},
                {"companion", nullptr}};
  if (report.pose)
    value["pose"] = {{"x_m", report.pose->x_m}, {"y_m", report.pose->y_m}, {"theta_rad", report.pose->theta_rad}};
  if (report.target_m) value["target"] = point_to_json(*report.target_m);
  if (report.companion) {
    value["companion"] = {{"exploration", report.companion->exploration.str()},
                          {"joined", report.companion->joined},
                          {"pictures", report.companion->pictures}};
  }
  if (report.floor) value["floor"] = floor_to_json(*report.floor);
  return value;
}

Result<ExplorationReport> exploration_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  ExplorationReport report;
  report.id = ExplorationId(reader.text("id", 100));
  report.phase = reader.choice("phase", kPhases);
  if (const json& reason = reader.value("reason"); !reason.is_null())
    report.reason = reader.take(reason_from_json(reason, reader.path_of("reason")));
  report.pictures = reader.integer("pictures", 0, kMostPictures);
  report.driven_m = reader.number("driven_m", 0.0, 1e6);
  report.explored_s = reader.number("explored_s", 0.0, 1e7);
  report.unreached = reader.integer("unreached", 0, kMostPictures);
  report.pose = read_pose(reader);
  if (const json& target = reader.value("target"); !target.is_null()) {
    report.target_m = point_from_json(target);
    if (!report.target_m) reader.problem("target", no_point("'target'"));
  }
  for (const json& item : reader.array("nodes", kMostNodes)) {
    const auto node_m = point_from_json(item);
    if (!node_m) reader.problem("nodes", no_point("A node"));
    report.nodes_m.push_back(node_m.value_or(Eigen::Vector2d::Zero()));
  }
  report.loops = read_loops(reader, report.nodes_m.size());
  report.floor = read_floor(reader);
  report.fences_m = reader.take(fences_from_json(reader.value("fences"), reader.path_of("fences")));
  report.uploaded = reader.number("uploaded", 0.0, 1.0);
  if (!reader.value("tour").is_null()) report.tour = TourId(reader.text("tour", 100));
  report.companion = read_shared(reader);
  if (report.id.empty()) reader.problem("id", "'id' must not be empty.");
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return report;
}

}  // namespace homeward::wire
