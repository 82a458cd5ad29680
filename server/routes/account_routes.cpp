// SPDX-License-Identifier: Apache-2.0
#include "server/routes/account_routes.hpp"

#include "server/http/json_body.hpp"
#include "server/routes/operation_roles.hpp"
#include "server/routes/user_routes.hpp"

namespace homeward::server {
namespace {

using nlohmann::json;

Response signed_in(int status, const Request& request, const Authenticator::SignedIn& result) {
  Response response = json_response(status, {{"user", user_to_json(result.user)}});
  response.headers["set-cookie"] = session_cookie(request, result.secret);
  return response;
}

Response rate_limited_or(const Error& error, int seconds) {
  Response response = problem(error);
  if (error.code == ErrorCode::kRateLimited) response.headers["retry-after"] = std::to_string(std::max(1, seconds));
  return response;
}

Response log_in(Authenticator& authenticator, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string name = reader.text("name", 200);
  const std::string password = reader.text("password", 1000);
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const auto result = authenticator.log_in(name, password, request.remote);
  if (!result) return rate_limited_or(result.error(), authenticator.seconds_to_wait(name, request.remote));
  return signed_in(200, request, *result);
}

Response set_up(Authenticator& authenticator, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string token = reader.text("token", 200);
  const std::string name = reader.line("name", 200);
  const std::string password = reader.text("password", 1000);
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const auto result = authenticator.set_up(token, name, password, request.remote);
  if (!result) return rate_limited_or(result.error(), authenticator.seconds_to_wait("set-up", request.remote));
  return signed_in(201, request, *result);
}

Response list_tokens(db::Store& store) {
  const auto tokens = store.tokens();
  if (!tokens) return problem_of(tokens);
  json list = json::array();
  for (const db::Token& token : *tokens) {
    list.push_back({{"id", token.id},
                    {"name", token.name},
                    {"role", wire::role_name(token.role)},
                    {"robot", token.robot ? json(token.robot->str()) : json(nullptr)},
                    {"created_us", token.created_us}});
  }
  return json_response(200, {{"tokens", list}});
}

Response add_token(Authenticator& authenticator, db::Store& store, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string name = reader.line("name", 200);
  const std::string role_text = reader.choice("role", {"viewer", "rider", "carer", "installer", "admin", "robot"});
  const auto robot = reader.optional_text("robot");
  if (const Status status = reader.finish(); !status) return problem_of(status);
  if (name.empty()) return problem({ErrorCode::kInvalidInput, "A token needs a name.", "body/name"});
  const wire::Role role = wire::role(role_text).value();
  if (robot && role != wire::Role::kRobot) {
    return problem({ErrorCode::kInvalidInput, "Only a token of role robot speaks for a robot.", "body/robot"});
  }
  // Nobody hands out more than he may do himself.
  if (role != wire::Role::kRobot && !wire::includes(request.caller.role, role)) {
    return problem({ErrorCode::kForbidden, "Your role cannot make a token of role " + role_text + ".", "body/role"});
  }
  std::optional<RobotId> id;
  if (robot) {
    id = RobotId(*robot);
    if (const auto known = store.robot(*id); !known) return problem_of(known);
  }
  const auto token = authenticator.add_token(name, role, id);
  if (!token) return problem_of(token);
  return json_response(201, {{"id", token->id}, {"token", token->secret}});
}

Response remove_token(Authenticator& authenticator, db::Store& store, const Request& request) {
  const auto tokens = store.tokens();
  if (!tokens) return problem_of(tokens);
  for (const db::Token& token : *tokens) {
    if (token.id == request.parameter("token") && token.role != wire::Role::kRobot &&
        !wire::includes(request.caller.role, token.role)) {
      const std::string role(wire::role_name(token.role));
      return problem({ErrorCode::kForbidden, "Your role cannot revoke a token of role " + role + ".", token.id});
    }
  }
  const Status status = authenticator.revoke_token(request.parameter("token"));
  return status ? empty_response(204) : problem_of(status);
}

Response setup_needed(db::Store& store) {
  const auto hash = store.setup_hash();
  if (!hash) return problem_of(hash);
  return json_response(200, {{"needed", hash->has_value()}});
}

}  // namespace

void add_account_routes(Router& router, Authenticator& authenticator, db::Store& store) {
  Authenticator* auth = &authenticator;
  db::Store* db = &store;
  router.add({operation("get_setup"), [db](Request&) { return setup_needed(*db); }});
  router.add({operation("set_up"), [auth](Request& request) { return set_up(*auth, request); }});
  router.add({operation("log_in"), [auth](Request& request) { return log_in(*auth, request); }});
  router.add({operation("log_out"), [auth](Request& request) {
                const Status status = auth->log_out(request);
                if (!status) return problem_of(status);
                Response response = empty_response(204);
                response.headers["set-cookie"] = session_cookie(request, "");
                return response;
              }});
  router.add({operation("get_me"), [](Request& request) {
                const Caller& caller = request.caller;
                return json_response(
                    200,
                    {{"user", {{"id", caller.id}, {"name", caller.name}, {"role", wire::role_name(caller.role)}}}});
              }});
  router.add({operation("list_tokens"), [db](Request&) { return list_tokens(*db); }});
  router.add({operation("add_token"), [auth, db](Request& request) { return add_token(*auth, *db, request); }});
  router.add({operation("remove_token"), [auth, db](Request& request) { return remove_token(*auth, *db, request); }});
}

}  // namespace homeward::server
