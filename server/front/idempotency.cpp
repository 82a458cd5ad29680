// SPDX-License-Identifier: Apache-2.0
#include "server/front/idempotency.hpp"

#include <spdlog/spdlog.h>

#include "db/secrets.hpp"

namespace homeward::server {

Response Idempotency::run(Request& request, bool secret, const std::function<Response(Request&)>& handler) {
  const std::string text = request.header("idempotency-key");
  if (request.method != "POST" || text.empty() || request.caller.id.empty()) return handler(request);
  if (text.size() > 200) return problem({ErrorCode::kInvalidInput, "A key has at most 200 bytes.", "Idempotency-Key"});
  const db::RequestKey key{request.caller.id, request.method + " " + request.path, text};
  const std::string name = key.caller + "\n" + key.route + "\n" + key.key;
  {
    const std::scoped_lock lock(mutex_);
    if (!running_.insert(name).second) {
      return problem({ErrorCode::kConflict, "The same request is being worked on.", "Idempotency-Key"});
    }
  }
  const auto done = [&](Response response) {
    const std::scoped_lock lock(mutex_);
    running_.erase(name);
    return response;
  };
  const auto kept = store_.answer(key, clock_.wall_us());
  if (!kept) return done(problem_of(kept));
  const std::string request_hash = db::secret_hash(request.body);
  if (*kept) {
    if (!(*kept)->request_hash.empty() && (*kept)->request_hash != request_hash) {
      return done(problem({ErrorCode::kInvalidInput, "This key was used for another request.", "Idempotency-Key"}));
    }
    Response again;
    again.status = (*kept)->status;
    again.body = (*kept)->body;
    if (!again.body.empty()) again.headers["content-type"] = "application/json";
    again.headers["idempotency-replayed"] = "true";
    return done(again);
  }
  Response response;
  try {
    response = handler(request);
  } catch (...) {
    done({});
    throw;
  }
  if (!secret && response.status >= 200 && response.status < 300) {
    // What was asked for is done, whether or not that can be kept.
    const Status status = store_.keep_answer(key, {response.status, response.body, request_hash}, clock_.wall_us());
    if (!status) spdlog::warn("the answer to {} cannot be kept: {}", key.route, status.error().message);
  }
  return done(response);
}

}  // namespace homeward::server
