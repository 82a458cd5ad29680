// SPDX-License-Identifier: Apache-2.0
#include "server/front/app_front.hpp"

#include <spdlog/spdlog.h>

#include <chrono>

namespace homeward::server {
namespace {

bool changes_something(const Request& request) {
  return request.method != "GET" && request.method != "HEAD" && request.method != "OPTIONS";
}

bool is_application_path(const std::string& path) { return path == "/api" || path.starts_with("/api/"); }

Response sign_in_first() {
  return problem({ErrorCode::kUnauthenticated, "Sign in, or send a token in the Authorization header.", ""});
}

Response broken(const std::string& what) {
  spdlog::error("a request failed: {}", what);
  return problem({ErrorCode::kInternal, "The server has a fault; its log says more.", ""});
}

// The answer to what is neither a route nor a page.
std::optional<Response> no_route(const Request& request, const Router::Match& match) {
  const bool page = match.allowed.empty() && !is_application_path(request.path);
  const std::string allowed = page ? "GET, HEAD, OPTIONS" : match.allowed;
  if (allowed.empty()) {
    return problem({ErrorCode::kNotFound, "There is no " + request.path + " here.", request.path});
  }
  if (page && (request.method == "GET" || request.method == "HEAD")) return std::nullopt;
  Response response = request.method == "OPTIONS"
                          ? empty_response(204)
                          : problem(405, "Method not allowed", "This path takes " + allowed + ".");
  response.headers["allow"] = allowed;
  return response;
}

}  // namespace

std::variant<std::size_t, Response> AppFront::admit(Request& request) {
  if (!parts_.access.host_allowed(request.header("host"))) {
    return problem({ErrorCode::kForbidden, "This server does not answer to that name; --allow-host adds one.", "Host"});
  }
  request.by_tls = parts_.access.came_by_tls(request);
  request.remote = parts_.access.sender_of(request);
  const Router::Match match = parts_.router.find(request.method, request.path);
  if (match.route == nullptr) {
    if (auto refused = no_route(request, match)) return *refused;
    return std::size_t{0};  // a page of the dashboard
  }
  const Operation& operation = match.route->operation;
  const auto caller = parts_.authenticator.identify(request);
  if (caller && *caller) request.caller = **caller;
  if (operation.roles.includes_anyone()) return operation.max_body;
  if (!caller) return problem_of(caller);
  if (auto refused = refusal(request, operation.roles, *caller)) return *refused;
  return operation.max_body;
}

void AppFront::answer(std::shared_ptr<Request> request, Reply reply) {
  const Router::Match match = parts_.router.find(request->method, request->path);
  if (match.route == nullptr) {
    const bool queued = parts_.workers.try_run([this, request, reply] {
      Response response;
      try {
        response = parts_.files.serve(*request);
        compressed_.compress(*request, response);
      } catch (const std::exception& exception) {
        response = broken(exception.what());
      }
      reply(std::move(response));
    });
    if (!queued) reply(problem({ErrorCode::kOverloaded, "The server is busy.", request->path}));
    return;
  }
  request->parameters = match.parameters;
  const Route* route = match.route;
  // Again: a secret may have been revoked while a body was on its way.
  const auto caller = parts_.authenticator.identify(*request);
  if (route->operation.lane == Lane::kNow) {
    if (!caller && !route->operation.roles.includes_anyone()) return reply(problem_of(caller));
    return reply(checked(*request, *route, caller ? *caller : std::nullopt));
  }
  // A wrong token is refused even where nobody needs one.
  if (!caller) return reply(problem_of(caller));
  const bool queued = queue(route->operation.lane, request->remote, [this, request, route, reply] {
    // And again: while it waited a role may have been taken away.
    const auto now = parts_.authenticator.identify(*request);
    Response response = now ? checked(*request, *route, *now) : problem_of(now);
    // Here, not on the socket thread: to give a gigabyte back takes a while.
    std::string().swap(request->body);
    reply(std::move(response));
  });
  if (!queued) reply(problem({ErrorCode::kOverloaded, "The server is busy; try again in a second.", request->path}));
}

bool AppFront::queue(Lane lane, const std::string& address, WorkPool::Task task) {
  if (lane == Lane::kPassword) return parts_.passwords.try_run(address, std::move(task));
  if (lane == Lane::kSlow) return parts_.slow.try_run(std::move(task));
  if (lane == Lane::kBulk) return parts_.bulk.try_run(std::move(task));
  return (lane == Lane::kHeavy ? parts_.heavy : parts_.workers).try_run(std::move(task));
}

std::optional<Response> AppFront::refusal(const Request& request, const AllowedRoles& roles,
                                          const std::optional<Caller>& caller) {
  if (roles.includes_anyone()) return std::nullopt;
  if (!caller) return sign_in_first();
  if (!roles.allow(caller->role)) {
    const std::string role(wire::role_name(caller->role));
    return problem(
        {ErrorCode::kForbidden, "This needs the role " + roles.text() + "; yours is " + role + ".", request.path});
  }
  return std::nullopt;
}

Response AppFront::checked(Request& request, const Route& route, const std::optional<Caller>& caller) {
  const auto began = parts_.clock.steady();
  const auto run = [&]() -> Response {
    if (auto refused = refusal(request, route.operation.roles, caller)) return *refused;
    const bool by_token = caller && !caller->by_cookie;
    if (changes_something(request) && !by_token) {
      const bool signed_by_cookie = caller && caller->by_cookie;
      const bool foreign_origin = !request.header("origin").empty() && !parts_.access.from_own_page(request);
      if (foreign_origin ||
          (signed_by_cookie && !route.operation.roles.includes_anyone() && !parts_.access.from_own_page(request))) {
        return problem({ErrorCode::kForbidden, "A change must come from a page of this server.", "Origin"});
      }
    }
    request.caller = caller.value_or(Caller{});
    // A stop must not wait for the disk, and stopping twice does no harm.
    if (route.operation.lane == Lane::kNow) return route.handler(request);
    Response answer = parts_.idempotency.run(request, route.operation.answer_holds_secret, route.handler);
    // How well a secret compresses beside what somebody else chose tells of it.
    if (!route.operation.answer_holds_secret) compressed_.compress(request, answer);
    return answer;
  };
  Response response;
  try {
    response = run();
  } catch (const std::exception& exception) {
    response = broken(exception.what());
  }
  const double seconds = std::chrono::duration<double>(parts_.clock.steady() - began).count();
  parts_.metrics.answered(request.method, std::string(route.operation.pattern), response.status, seconds);
  spdlog::debug("{} {} {} by {} in {:.1f} ms", request.method, route.operation.pattern, response.status,
                caller ? caller->id : "nobody", seconds * 1e3);
  return response;
}

void AppFront::upgrade(std::shared_ptr<Request> request, std::function<void(Upgrade)> reply) {
  if (!parts_.access.host_allowed(request->header("host"))) {
    return reply(problem({ErrorCode::kForbidden, "This server does not answer to that name.", "Host"}));
  }
  const Router::Match match = parts_.router.find(request->method, request->path);
  if (match.route == nullptr || !match.route->open_socket) {
    return reply(problem({ErrorCode::kNotFound, "There is no WebSocket at " + request->path + ".", request->path}));
  }
  const auto caller = parts_.authenticator.identify(*request);
  if (!caller) return reply(problem_of(caller));
  if (auto refused = refusal(*request, match.route->operation.roles, *caller)) return reply(*refused);
  const bool has_origin = !request->header("origin").empty();
  if (((*caller)->by_cookie || has_origin) && !parts_.access.from_own_page(*request)) {
    return reply(problem({ErrorCode::kForbidden, "A socket must be opened by a page of this server.", "Origin"}));
  }
  request->caller = **caller;
  request->parameters = match.parameters;
  const Route* route = match.route;
  const bool queued = parts_.workers.try_run([request, route, reply] {
    Upgrade opened;
    try {
      opened = route->open_socket(*request);
    } catch (const std::exception& exception) {
      opened = broken(exception.what());
    }
    reply(std::move(opened));
  });
  if (!queued) reply(problem({ErrorCode::kOverloaded, "The server is busy.", request->path}));
}

bool AppFront::still_welcome(const Request& handshake) const {
  const Router::Match match = parts_.router.find(handshake.method, handshake.path);
  if (match.route == nullptr) return false;
  const auto caller = parts_.authenticator.identify(handshake);
  return caller && !refusal(handshake, match.route->operation.roles, *caller);
}

}  // namespace homeward::server
