// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/result.hpp"
#include "wire/role.hpp"

namespace homeward::server {

/// Who asks, once a token or cookie was recognised. An empty id means nobody.
struct Caller {
  std::string id;    // of the user or token; what idempotency keys belong to
  std::string name;  // shown to others: who drives, who edited
  wire::Role role = wire::Role::kViewer;
  std::string robot;  // for role robot: the robot that the token is for, or empty
  bool by_cookie = false;
};

/// One request, whole. Names of headers are in lower case.
struct Request {
  std::string method;
  std::string path;                          // as sent, percent-encoded, without the query
  std::map<std::string, std::string> query;  // decoded
  std::map<std::string, std::string> headers;
  std::string body;
  std::string remote;                             // address of the other end, without port
  bool by_tls = false;                            // between the browser and a proxy that is believed
  std::map<std::string, std::string> parameters;  // of the route: {tour} -> "t3"
  Caller caller;

  [[nodiscard]] std::string header(const std::string& name) const {
    const auto found = headers.find(name);
    return found == headers.end() ? std::string() : found->second;
  }
  [[nodiscard]] const std::string& parameter(const std::string& name) const { return parameters.at(name); }
  [[nodiscard]] std::span<const std::uint8_t> bytes() const {
    return {reinterpret_cast<const std::uint8_t*>(body.data()), body.size()};
  }
};

/// Whether an If-None-Match header (RFC 9110 section 13.1.2: "*", or tags, weak ones too, with commas between them)
/// names `tag`, which is strong and in its quotes.
bool names_tag(std::string_view if_none_match, std::string_view tag);

struct Response {
  int status = 200;
  std::map<std::string, std::string> headers;
  std::string body;
};

Response json_response(int status, const nlohmann::json& value);
/// 200 with JSON that is text already, for the caller alone and to be asked for anew each time.
Response json_text_response(std::string text);
Response empty_response(int status);
Response bytes_response(std::span<const std::uint8_t> bytes, const std::string& content_type);

/// A problem document (RFC 9457) with the status that wire/error_table gives the code.
Response problem(const Error& error);
/// The same for what the error table does not know: HTTP's own complaints such as 400, 405 or 428.
Response problem(int status, const std::string& title, const std::string& detail);

template <class T>
Response problem_of(const Result<T>& failed) {
  return problem(failed.error());
}

/// Replaces %XX; nothing when an escape is broken or would hide a zero byte.
std::optional<std::string> percent_decoded(std::string_view text, bool plus_is_space = false);

/// Splits "a=1&b=2"; nothing when an escape is broken.
std::optional<std::map<std::string, std::string>> parse_query(std::string_view text);

/// The value of one cookie, or empty.
std::string cookie_value(const std::string& header, std::string_view name);

}  // namespace homeward::server
