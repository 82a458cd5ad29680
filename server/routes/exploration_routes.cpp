// SPDX-License-Identifier: Apache-2.0
#include "server/routes/exploration_routes.hpp"

#include "server/http/json_body.hpp"
#include "server/routes/operation_roles.hpp"
#include "wire/exploration_json.hpp"
#include "wire/mission_json.hpp"

namespace homeward::server {
namespace {

RobotId asked_robot(const Request& request) { return RobotId(request.parameter("robot")); }

std::optional<double> limit_in(wire::ObjectReader& reader, const std::string& key, double least, double most) {
  return reader.has(key) ? std::optional(reader.number(key, least, most)) : std::nullopt;
}

Response start_exploration(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  Driving::ExplorationRequest asked;
  asked.lease_id = reader.text("lease_id", 100);
  if (reader.has("exploration")) {
    asked.exploration = ExplorationId(reader.text("exploration", 100));
    if (asked.exploration->empty()) reader.problem("exploration", "The id of the exploration to go on with.");
  }
  asked.limit_m = limit_in(reader, "limit_m", 1.0, 1e5);
  asked.limit_s = limit_in(reader, "limit_s", 10.0, 1e6);
  asked.back_after_s = limit_in(reader, "back_after_s", 10.0, 1e6);
  if (const Status status = reader.finish(); !status) return problem_of(status);
  asked.by = request.caller.name;
  const auto mission = driving.start_exploration(asked_robot(request), asked);
  return mission ? json_response(201, wire::mission_to_json(*mission)) : problem_of(mission);
}

Response get_exploration(Driving& driving, const Request& request) {
  const auto report = driving.exploration(asked_robot(request));
  return report ? json_response(200, wire::exploration_to_json(**report)) : problem_of(report);
}

Response set_fences(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string lease = reader.text("lease_id", 100);
  const std::vector<wire::Fence> fences_m =
      reader.take(wire::fences_from_json(reader.value("fences"), reader.path_of("fences")));
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const Status sent = driving.set_fences(asked_robot(request), lease, fences_m);
  return sent ? empty_response(202) : problem_of(sent);
}

Response set_companion(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string lease = reader.text("lease_id", 100);
  std::optional<RobotId> other;
  if (!reader.value("robot").is_null()) {
    other = RobotId(reader.text("robot", 100));
    if (other->empty()) reader.problem("robot", "The id of the other robot, or null.");
  }
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const Status sent = driving.set_companion(asked_robot(request), lease, other);
  return sent ? empty_response(202) : problem_of(sent);
}

Response finish_exploration(Driving& driving, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string lease = reader.text("lease_id", 100);
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const Status sent = driving.finish_exploration(asked_robot(request), lease);
  return sent ? empty_response(202) : problem_of(sent);
}

}  // namespace

void add_exploration_routes(Router& router, Driving& driving) {
  Driving* d = &driving;
  router.add({operation("start_exploration"), [d](Request& request) { return start_exploration(*d, request); }});
  router.add({operation("get_exploration"), [d](Request& request) { return get_exploration(*d, request); }});
  router.add({operation("set_fences"), [d](Request& request) { return set_fences(*d, request); }});
  router.add({operation("set_companion"), [d](Request& request) { return set_companion(*d, request); }});
  router.add({operation("finish_exploration"), [d](Request& request) { return finish_exploration(*d, request); }});
}

}  // namespace homeward::server
