// SPDX-License-Identifier: Apache-2.0
#include "server/routes/user_routes.hpp"

#include "server/auth/passwords.hpp"
#include "server/http/json_body.hpp"
#include "server/routes/operation_roles.hpp"

namespace homeward::server {
namespace {

using nlohmann::json;

const std::vector<std::string>& roles_of_users() {
  static const std::vector<std::string> roles = {"viewer", "rider", "carer", "installer", "admin"};
  return roles;
}

UserId user_in(const Request& request) { return UserId(request.parameter("user")); }

Response list_users(db::Store& store) {
  const auto users = store.users();
  if (!users) return problem_of(users);
  json list = json::array();
  for (const db::User& user : *users) list.push_back(user_to_json(user));
  return json_response(200, {{"users", list}});
}

Response add_user(db::Store& store, const Clock& clock, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  db::User user;
  user.name = reader.line("name", 200);
  const std::string password = reader.text("password", 1000);
  const std::string role = reader.choice("role", roles_of_users());
  if (const Status status = reader.finish(); !status) return problem_of(status);
  if (const Status status = check_new_account(user.name, password); !status) return problem_of(status);
  user.role = wire::role(role).value();
  user.password_hash = hash_of_password(password);
  user.created_us = clock.wall_us();
  const auto added = store.add_user(user);
  if (!added) return problem_of(added);
  return json_response(201, {{"user", user_to_json(*added)}});
}

Response set_role(Authenticator& authenticator, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  wire::ObjectReader reader(*body, "body");
  const std::string role = reader.choice("role", roles_of_users());
  if (const Status status = reader.finish(); !status) return problem_of(status);
  const Status status = authenticator.set_role(user_in(request), wire::role(role).value());
  return status ? empty_response(204) : problem_of(status);
}

// One's own against the old one, which a borrowed browser does not know; an admin sets anybody else's.
Response set_password(Authenticator& authenticator, const Request& request) {
  const auto body = json_body(request);
  if (!body) return not_json(body.error());
  const bool own = request.caller.id == request.parameter("user");
  wire::ObjectReader reader(*body, "body");
  const std::string password = reader.text("password", 1000);
  const std::string old = own ? reader.text("old_password", 1000) : std::string();
  if (const Status status = reader.finish(); !status) return problem_of(status);
  if (!own && request.caller.role != wire::Role::kAdmin) {
    return problem({ErrorCode::kForbidden, "Only an admin sets the password of somebody else.", request.path});
  }
  if (own) {
    if (const Status right = authenticator.check_password(user_in(request), old, request.remote); !right) {
      return problem_of(right);
    }
  }
  const auto user = authenticator.set_password(user_in(request), password);
  if (!user) return problem_of(user);
  Response response = empty_response(204);
  if (own && request.caller.by_cookie) {  // its session has ended with all others
    const auto session = authenticator.begin_session(*user);
    if (!session) return problem_of(session);
    response.headers["set-cookie"] = session_cookie(request, session->secret);
  }
  return response;
}

}  // namespace

json user_to_json(const db::User& user) {
  return {{"id", user.id.str()}, {"name", user.name}, {"role", wire::role_name(user.role)}};
}

std::string session_cookie(const Request& request, const std::string& secret) {
  return std::string(kSessionCookie) + "=" + secret +
         "; Path=/; HttpOnly; SameSite=Strict; Max-Age=" + (secret.empty() ? "0" : "2592000") +
         (request.by_tls ? "; Secure" : "");
}

void add_user_routes(Router& router, Authenticator& authenticator, db::Store& store, const Clock& clock) {
  Authenticator* auth = &authenticator;
  db::Store* db = &store;
  const Clock* time = &clock;
  router.add({operation("list_users"), [db](Request&) { return list_users(*db); }});
  router.add({operation("add_user"), [db, time](Request& request) { return add_user(*db, *time, request); }});
  router.add({operation("remove_user"), [auth](Request& request) {
                const Status status = auth->remove_user(user_in(request));
                return status ? empty_response(204) : problem_of(status);
              }});
  router.add({operation("set_user_role"), [auth](Request& request) { return set_role(*auth, request); }});
  router.add({operation("set_password"), [auth](Request& request) { return set_password(*auth, request); }});
}

}  // namespace homeward::server
