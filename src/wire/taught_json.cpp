// SPDX-License-Identifier: Apache-2.0
#include "wire/taught_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/enum_names.hpp"
#include "core/index.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr EnumNames<map::ArcEnd, 5> kArcEndNames({"features", "error", "common", "geometry", "end"});
constexpr EnumNames<map::CutReason, 3> kCutReasonNames({"features", "geometry", "error"});

std::string file_name(const ImageId& image) { return image.str().substr(image.str().rfind('/') + 1); }

json arc_to_json(const map::MapPath& path, const map::PathArc& arc) {
  const map::KeyImage& key = path.taught.key_images[at(arc.from)];
  const Eigen::Matrix3d& turn = arc.motion.current_from_target;
  const Eigen::Vector3d& direction = arc.motion.target_in_current;
  json value{{"from", file_name(path.images[at(arc.from)])},
             {"to", file_name(path.images[at(path.taught.to_key(arc))])},
             {"features", arc.matches.size()},
             {"common", key.common},
             {"error_px", arc.error_px},
             {"parallax_px", arc.parallax_px},
             {"direction_spread_rad", arc.direction_spread_rad},
             {"turn_rad", std::atan2(turn(1, 0), turn(0, 0))},
             {"ended_by", kArcEndNames.name(arc.ended_by)}};
  value["bearing_rad"] = arc.has_baseline ? json(std::atan2(direction.y(), direction.x())) : json();
  value["scale"] = key.scale ? json(key.scale->ratio) : json();
  return value;
}

}  // namespace

json taught_to_json(const std::string& file, const map::TopologicalMap& map, const std::vector<Error>& skipped) {
  const map::MapPath& path = *map.path;
  json value{{"map", file},
             {"pictures", map.images.size()},
             {"key_images", path.images.size()},
             {"arcs", json::array()},
             {"cuts", json::array()},
             {"bridged", json::array()},
             {"skipped", json::array()}};
  value["closed_at"] = path.taught.closing ? json(file_name(path.images[at(path.taught.closing->key_image)])) : json();
  for (const map::PathArc& arc : path.taught.arcs) value["arcs"].push_back(arc_to_json(path, arc));
  for (const map::PathCut& cut : path.taught.cuts) {
    json line{{"after", file_name(map.images[at(cut.last_picture)].id)}, {"why", cut_reason_name(cut.why)}};
    line["on_from"] = cut.next_picture ? json(file_name(map.images[at(*cut.next_picture)].id)) : json();
    value["cuts"].push_back(std::move(line));
  }
  for (const map::PathBridge& bridge : path.taught.bridges) {
    value["bridged"].push_back({{"after", file_name(map.images[at(bridge.last_picture)].id)},
                                {"on_from", file_name(map.images[at(bridge.next_picture)].id)},
                                {"matched", bridge.matched}});
  }
  for (const Error& error : skipped) value["skipped"].push_back({{"where", error.where}, {"message", error.message}});
  return value;
}

std::string cut_reason_name(map::CutReason why) { return std::string(kCutReasonNames.name(why)); }

}  // namespace homeward::wire
