// SPDX-License-Identifier: Apache-2.0
#include "server/routes/robot_routes.hpp"

#include <limits>

#include "server/http/json_body.hpp"
#include "server/routes/operation_roles.hpp"
#include "wire/mission_json.hpp"
#include "wire/plan_pose_json.hpp"
#include "wire/robot_json.hpp"

namespace homeward::server {
namespace {

using nlohmann::json;

RobotId robot_in(const Request& request) { return RobotId(request.parameter("robot")); }

Response robot_response(const Result<wire::RobotView>& robot) {
  return robot ? json_response(200, wire::robot_to_json(*robot)) : problem_of(robot);
}

Response lease_response(const Result<wire::LeaseView>& lease) {
  return lease ? json_response(200, {{"lease", wire::lease_to_json(*lease)}}) : problem_of(lease);
}

Response add_robot(Driving& driving, Authenticator& authenticator, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string name = reader.line("name", 200);
  if (name.empty()) reader.problem("name", "A robot needs a name.");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const auto robot = driving.add(name);
  if (!robot) return problem_of(robot);
  const auto token = authenticator.add_token(name, wire::Role::kRobot, robot->id);
  if (!token) return problem_of(token);
  return json_response(201, {{"id", robot->id.str()}, {"name", robot->name}, {"token", token->secret}});
}

Response set_map(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  std::optional<MapId> map;
  const json& value = reader.value("map");
  if (value.is_string()) {
    map = MapId(value.get<std::string>());
  } else if (!value.is_null() || !body->contains("map")) {
    reader.problem("map", "The id of a map, or null.");
  }
  if (const Status status = reader.finish(); !status) return problem_of(status);
  return robot_response(driving.set_map(robot_in(request), map));
}

Response set_place(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  Driving::SaidPlace said;
  if (reader.has("label")) {
    said.label = reader.text("label", 200);
    if (said.label.empty()) reader.problem("label", "A label is not empty.");
    if (reader.has("place")) reader.problem("place", "A robot is at a place or at a label, not both.");
  } else {
    said.place = PlaceId(reader.text("place", 100));
    if (said.place.empty()) reader.problem("place", "The id of a place, or else a label.");
  }
  if (const Status status = reader.finish(); !status) return problem_of(status);
  said.by = request.caller.name;
  return robot_response(driving.set_place(robot_in(request), said));
}

Response take_lease(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const bool take_over = reader.has("take_over") && reader.boolean("take_over");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  return lease_response(driving.take_lease(robot_in(request), request.caller, take_over));
}

Result<std::string> lease_id_in(const json& body) {
  wire::ObjectReader reader(body, "body");
  std::string lease = reader.text("lease_id", 100);
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return lease;
}

Response keep_lease(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  const auto lease = lease_id_in(*body);
  if (!lease) return problem_of(lease);
  return lease_response(driving.keep_lease(robot_in(request), *lease));
}

Response release_lease(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  const auto lease = lease_id_in(*body);
  if (!lease) return problem_of(lease);
  const Status status = driving.release_lease(robot_in(request), *lease);
  return status ? empty_response(204) : problem_of(status);
}

Response start_mission(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  Driving::MissionRequest asked;
  asked.lease_id = reader.text("lease_id", 100);
  if (reader.has("destination")) {
    asked.destination = DestinationId(reader.text("destination", 100));
    if (reader.has("place")) reader.problem("place", "A mission goes to a destination or a place, not both.");
  } else {
    asked.place = PlaceId(reader.text("place", 100));
  }
  if (const Status status = reader.finish(); !status) return problem_of(status);
  asked.by = request.caller.name;
  const auto mission = driving.start(robot_in(request), asked);
  return mission ? json_response(201, wire::mission_to_json(*mission)) : problem_of(mission);
}

Response answer(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  Driving::GivenAnswer given;
  given.lease_id = reader.text("lease_id", 100);
  given.question = reader.integer("question", 1, std::numeric_limits<std::int64_t>::max());
  given.here = reader.boolean("here");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  given.by = request.caller.name;
  const auto mission = driving.answer(robot_in(request), MissionId(request.parameter("mission")), given);
  return mission ? json_response(202, wire::mission_to_json(*mission)) : problem_of(mission);
}

Response list_missions(Driving& driving, db::Store& store, const Request& request) {
  if (const auto robot = driving.get(robot_in(request)); !robot) return problem_of(robot);
  const auto missions = store.missions(robot_in(request));
  if (!missions) return problem_of(missions);
  json list = json::array();
  for (const wire::MissionView& mission : *missions) list.push_back(wire::mission_to_json(mission));
  return json_response(200, {{"missions", list}});
}

Response mission_plan(Driving& driving, db::Store& store, const Request& request) {
  const MissionId id(request.parameter("mission"));
  if (const auto mission = driving.mission(robot_in(request), id); !mission) return problem_of(mission);
  const auto poses = store.plan_poses(id);
  return poses ? json_response(200, wire::mission_plan_to_json(id, *poses)) : problem_of(poses);
}

// A stop that is asked for badly is still a stop: a body that cannot be read only loses its reason.
Response stop(Driving& driving, const Request& request) {
  std::string reason;
  if (const auto body = json_body(request); body && body->is_object()) {
    const auto found = body->find("reason");
    if (found != body->end() && found->is_string()) reason = found->get<std::string>().substr(0, 300);
  }
  for (char& c : reason) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  const auto stop_id = driving.stop(robot_in(request), request.caller.name, reason);
  return stop_id ? json_response(202, {{"stop_id", *stop_id}}) : problem_of(stop_id);
}

}  // namespace

void add_robot_routes(Router& router, Driving& driving, Authenticator& authenticator, db::Store& store) {
  Driving* d = &driving;
  db::Store* db = &store;
  Authenticator* auth = &authenticator;
  router.add({operation("list_robots"), [d](Request&) {
                json list = json::array();
                for (const wire::RobotView& robot : d->list()) list.push_back(wire::robot_to_json(robot));
                return json_response(200, {{"robots", list}});
              }});
  router.add({operation("add_robot"), [d, auth](Request& request) { return add_robot(*d, *auth, request); }});
  router.add({operation("get_robot"), [d](Request& request) { return robot_response(d->get(robot_in(request))); }});
  router.add({operation("remove_robot"), [d, auth](Request& request) {
                const Status removed = d->remove(robot_in(request));
                if (!removed) return problem_of(removed);
                auth->forget_tokens_of(robot_in(request));
                return empty_response(204);
              }});
  router.add({operation("set_robot_map"), [d](Request& request) { return set_map(*d, request); }});
  router.add({operation("set_robot_place"), [d](Request& request) { return set_place(*d, request); }});
  router.add({operation("take_lease"), [d](Request& request) { return take_lease(*d, request); }});
  router.add({operation("keep_lease"), [d](Request& request) { return keep_lease(*d, request); }});
  router.add({operation("release_lease"), [d](Request& request) { return release_lease(*d, request); }});
  router.add({operation("list_missions"), [d, db](Request& request) { return list_missions(*d, *db, request); }});
  router.add({operation("start_mission"), [d](Request& request) { return start_mission(*d, request); }});
  router.add({operation("get_mission"), [d](Request& request) {
                const auto mission = d->mission(robot_in(request), MissionId(request.parameter("mission")));
                return mission ? json_response(200, wire::mission_to_json(*mission)) : problem_of(mission);
              }});
  router.add({operation("get_mission_plan"), [d, db](Request& request) { return mission_plan(*d, *db, request); }});
  router.add({operation("answer_question"), [d](Request& request) { return answer(*d, request); }});
  router.add({operation("stop_robot"), [d](Request& request) { return stop(*d, request); }});
  router.add({operation("get_frame"), [d](Request& request) {
                const auto frame = d->frame(robot_in(request));
                return frame ? bytes_response(*frame, "image/jpeg") : problem_of(frame);
              }});
}

}  // namespace homeward::server
