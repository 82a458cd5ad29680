// SPDX-License-Identifier: Apache-2.0
#include "server/routes/socket_routes.hpp"

#include "server/routes/operation_roles.hpp"

namespace homeward::server {
namespace {

// For who asks for a socket's path without a handshake.
Response upgrade_required(Request&) {
  Response response = problem(426, "Upgrade required", "This is a WebSocket.");
  response.headers["upgrade"] = "websocket";
  return response;
}

Upgrade open_link(Driving& driving, const Request& request) {
  const RobotId robot(request.parameter("robot"));
  if (const auto known = driving.get(robot); !known) return problem_of(known);
  if (request.caller.robot != robot.str()) {
    return problem({ErrorCode::kForbidden, "This token does not speak for robot " + robot.str() + ".", request.path});
  }
  return driving.open_link(robot);
}

}  // namespace

void add_socket_routes(Router& router, Driving& driving, EventHub& events, EventHub::MakeSnapshot snapshot) {
  Driving* d = &driving;
  EventHub* hub = &events;
  router.add({operation("open_events"), upgrade_required,
              [hub, snapshot = std::move(snapshot)](Request&) -> Upgrade { return hub->subscribe(snapshot); }});
  router.add({operation("open_link"), upgrade_required, [d](Request& request) { return open_link(*d, request); }});
}

}  // namespace homeward::server
