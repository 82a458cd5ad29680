// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "server/http/message.hpp"
#include "wire/json_reader.hpp"

namespace homeward::server {

/// The JSON of a request's body; an empty object when there is none. Errors: kInvalidInput; answer with not_json().
inline Result<nlohmann::json> json_body(const Request& request) {
  if (request.body.empty()) return nlohmann::json::object();
  return wire::parse_json(request.body, "body", 1024UL * 1024);
}

/// 400, as the contract says for what is no JSON at all.
inline Response not_json(const Error& error) { return problem(400, "The body is not JSON", error.message); }

}  // namespace homeward::server
