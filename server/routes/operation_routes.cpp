// SPDX-License-Identifier: Apache-2.0
#include "server/routes/operation_routes.hpp"

#include "server/routes/operation_roles.hpp"

#include "core/markup.hpp"

namespace homeward::server {
namespace {

Response text_response(int status, const std::string& type, std::string text) {
  Response response;
  response.status = status;
  response.headers["content-type"] = type;
  response.body = std::move(text);
  return response;
}

// Below this a picture may not find room any more.
constexpr std::int64_t kLeastFree_bytes = 64LL << 20;

// For everybody: how much is wrong, and no names. Those are in the log and, of files, in `missing`.
std::vector<std::string> why_not_ready(const db::StoreCondition& condition) {
  std::vector<std::string> why;
  if (condition.database) why.push_back("the database: " + condition.database->message);
  if (condition.free_bytes < kLeastFree_bytes) {
    why.push_back("the disk is full: " + std::to_string(condition.free_bytes >> 20) + " MiB are left");
  }
  if (condition.missing_files > 0) {
    why.push_back(std::to_string(condition.missing_files) +
                  " files of maps or tours are missing; the log of the start names them");
  }
  return why;
}

Response readiness(db::Store& store) {
  std::string why;
  for (const std::string& one : why_not_ready(store.condition())) why += (why.empty() ? "" : "; ") + one;
  return why.empty() ? text_response(200, "text/plain; charset=utf-8", "ready\n")
                     : problem(503, "Not ready", why + ".");
}

}  // namespace

void add_operation_routes(Router& router, Metrics& metrics, db::Store& store) {
  Metrics* m = &metrics;
  db::Store* db = &store;
  router.add({operation("healthz"), [](Request&) { return text_response(200, "text/plain; charset=utf-8", "ok\n"); }});
  router.add({operation("readyz"), [db](Request&) { return readiness(*db); }});
  router.add({operation("metrics"),
              [m](Request&) { return text_response(200, "text/plain; version=0.0.4; charset=utf-8", m->text()); }});
  router.add({operation("api_docs"), [](Request&) {
                return text_response(200, "text/html; charset=utf-8",
                                     "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\">"
                                     "<title>Homeward: the REST interface</title></head><body>"
                                     "<h1>The REST interface</h1><pre>" +
                                         escape_html(openapi_text()) + "</pre></body></html>");
              }});
}

}  // namespace homeward::server
