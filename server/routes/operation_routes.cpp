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

}  // namespace

void add_operation_routes(Router& router, Metrics& metrics, db::Store& store) {
  Metrics* m = &metrics;
  db::Store* db = &store;
  router.add({operation("healthz"), [](Request&) { return text_response(200, "text/plain; charset=utf-8", "ok\n"); }});
  router.add({operation("readyz"), [db](Request&) {
                const bool ready = db->setup_hash().has_value();
                return text_response(ready ? 200 : 503, "text/plain; charset=utf-8", ready ? "ready\n" : "not ready\n");
              }});
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
