// SPDX-License-Identifier: Apache-2.0
#include "wire/world_json.hpp"

#include <nlohmann/json.hpp>

#include "wire/json_reader.hpp"

namespace homeward::wire {
namespace {

using nlohmann::json;

constexpr std::size_t kMaxRooms = 1000;
constexpr std::size_t kMaxLamps = 5000;
constexpr double kFar_m = 10'000.0;

FloorPicture read_picture(ObjectReader& outer, const std::string& key) {
  ObjectReader reader(outer.value(key), outer.path_of(key));
  FloorPicture picture;
  picture.image = reader.text("image", 300);
  picture.resolution_m = reader.number("resolution_m", 0.005, 1.0);
  const std::vector<double> origin = reader.numbers("origin_m", 2);
  picture.origin_m = {origin[0], origin[1]};
  if (reader.has("robot_radius_m")) picture.robot_radius_m = reader.number("robot_radius_m", 0.05, 3.0);
  outer.close(reader);
  return picture;
}

WorldRoom read_room(ObjectReader& outer, const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  WorldRoom room;
  room.name = reader.text("name", 200);
  room.x_m = reader.number("x_m", -kFar_m, kFar_m);
  room.y_m = reader.number("y_m", -kFar_m, kFar_m);
  if (reader.has("outline_m")) {
    for (const json& corner : reader.array("outline_m", 1000)) {
      if (!corner.is_array() || corner.size() != 2 || !corner[0].is_number() || !corner[1].is_number()) {
        reader.problem("outline_m", "Each corner of 'outline_m' must be [x, y].");
        break;
      }
      room.outline_m.emplace_back(corner[0].get<double>(), corner[1].get<double>());
    }
  }
  outer.close(reader);
  return room;
}

WorldLamp read_lamp(ObjectReader& outer, const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  const std::vector<double> position = reader.numbers("position_m", 3);
  const WorldLamp lamp{{position[0], position[1], position[2]}, reader.number("strength", 0.0, 1000.0)};
  outer.close(reader);
  return lamp;
}

json picture_to_json(const FloorPicture& picture) {
  return {{"image", picture.image},
          {"resolution_m", picture.resolution_m},
          {"origin_m", {picture.origin_m.x(), picture.origin_m.y()}}};
}

}  // namespace

json world_to_json(const WorldFile& world) {
  json value = {{"format", "homeward-world"},
                {"version", 1},
                {"name", world.name},
                {"mesh", world.mesh},
                {"mesh_up", world.mesh_y_up ? "y" : "z"},
                {"outdoor", world.outdoor},
                {"start", {{"x_m", world.start.x_m}, {"y_m", world.start.y_m}, {"theta_rad", world.start.theta_rad}}},
                {"rooms", json::array()},
                {"lamps", json::array()}};
  for (const WorldRoom& room : world.rooms) {
    json entry = {{"name", room.name}, {"x_m", room.x_m}, {"y_m", room.y_m}};
    for (const Eigen::Vector2d& corner : room.outline_m) entry["outline_m"].push_back({corner.x(), corner.y()});
    value["rooms"].push_back(std::move(entry));
  }
  for (const WorldLamp& lamp : world.lamps) {
    value["lamps"].push_back(
        {{"position_m", {lamp.position_m.x(), lamp.position_m.y(), lamp.position_m.z()}}, {"strength", lamp.strength}});
  }
  if (world.occupancy) value["occupancy"] = picture_to_json(*world.occupancy);
  if (world.drivable) {
    value["drivable"] = picture_to_json(*world.drivable);
    value["drivable"]["robot_radius_m"] = world.drivable->robot_radius_m;
  }
  return value;
}

Result<WorldFile> world_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  reader.format("homeward-world", 1);
  WorldFile world;
  world.name = reader.text("name", 200);
  world.mesh = reader.text("mesh", 300);
  world.mesh_y_up = reader.choice("mesh_up", {"y", "z"}) == "y";
  if (reader.has("outdoor")) world.outdoor = reader.boolean("outdoor");
  ObjectReader start(reader.value("start"), reader.path_of("start"));
  world.start = {start.number("x_m", -kFar_m, kFar_m), start.number("y_m", -kFar_m, kFar_m),
                 start.number("theta_rad", -7.0, 7.0)};
  reader.close(start);
  const std::vector<json> rooms = reader.array("rooms", kMaxRooms);
  for (std::size_t i = 0; i < rooms.size(); ++i) {
    world.rooms.push_back(read_room(reader, rooms[i], reader.path_of("rooms") + "/" + std::to_string(i)));
  }
  const std::vector<json> lamps = reader.array("lamps", kMaxLamps);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    world.lamps.push_back(read_lamp(reader, lamps[i], reader.path_of("lamps") + "/" + std::to_string(i)));
  }
  if (reader.has("occupancy")) world.occupancy = read_picture(reader, "occupancy");
  if (reader.has("drivable")) world.drivable = read_picture(reader, "drivable");
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return world;
}

Result<WorldFile> parse_world(const std::string& text, const std::string& where) {
  const Result<json> value = parse_json(text, where);
  if (!value) return pass_on(value);
  return world_from_json(*value, where);
}

}  // namespace homeward::wire
