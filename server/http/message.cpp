// SPDX-License-Identifier: Apache-2.0
#include "server/http/message.hpp"

#include "wire/problem_json.hpp"

namespace homeward::server {
namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// Text from outside may hold broken UTF-8; it is replaced, not thrown about.
std::string dumped(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

bool names_tag(std::string_view if_none_match, std::string_view tag) {
  const auto skip = [&](std::string_view characters) {
    if_none_match.remove_prefix(std::min(if_none_match.find_first_not_of(characters), if_none_match.size()));
  };
  skip(" \t");
  if (if_none_match.starts_with("*")) return true;
  while (!if_none_match.empty()) {
    skip(" \t,");
    if (if_none_match.starts_with("W/")) if_none_match.remove_prefix(2);
    if (!if_none_match.starts_with('"')) return false;
    const std::size_t end = if_none_match.find('"', 1);
    if (end == std::string_view::npos) return false;
    if (if_none_match.substr(0, end + 1) == tag) return true;
    if_none_match.remove_prefix(end + 1);
    skip(" \t");
  }
  return false;
}

Response json_response(int status, const nlohmann::json& value) {
  Response response;
  response.status = status;
  response.headers["content-type"] = "application/json";
  response.body = dumped(value);
  return response;
}

Response json_text_response(std::string text) {
  Response response;
  response.headers["content-type"] = "application/json";
  response.headers["cache-control"] = "private, no-cache";
  response.body = std::move(text);
  return response;
}

Response empty_response(int status) {
  Response response;
  response.status = status;
  return response;
}

Response bytes_response(std::span<const std::uint8_t> bytes, const std::string& content_type) {
  Response response;
  response.headers["content-type"] = content_type;
  response.body.assign(bytes.begin(), bytes.end());
  return response;
}

Response problem(const Error& error) {
  const nlohmann::json document = wire::problem_to_json(error);
  Response response = json_response(document.at("status").get<int>(), document);
  response.headers["content-type"] = "application/problem+json";
  if (error.code == ErrorCode::kOverloaded) response.headers["retry-after"] = "1";
  if (error.code == ErrorCode::kUnauthenticated) response.headers["www-authenticate"] = "Bearer";
  return response;
}

Response problem(int status, const std::string& title, const std::string& detail) {
  Response response = json_response(status, {{"type", "about:blank"},
                                             {"title", title},
                                             {"status", status},
                                             {"detail", detail},
                                             {"where", ""},
                                             {"code", "http"}});
  response.headers["content-type"] = "application/problem+json";
  return response;
}

std::optional<std::string> percent_decoded(std::string_view text, bool plus_is_space) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '+' && plus_is_space) {
      decoded.push_back(' ');
    } else if (text[i] == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const int high = hex_digit(text[i + 1]);
      const int low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0 || (high == 0 && low == 0)) return std::nullopt;
      decoded.push_back(static_cast<char>(high * 16 + low));
      i += 2;
    } else {
      decoded.push_back(text[i]);
    }
  }
  return decoded;
}

std::optional<std::map<std::string, std::string>> parse_query(std::string_view text) {
  std::map<std::string, std::string> query;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('&'), text.size());
    const std::string_view pair = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const auto key = percent_decoded(pair.substr(0, equals), true);
    const auto value = percent_decoded(pair.substr(std::min(equals + 1, pair.size())), true);
    if (!key || !value) return std::nullopt;
    if (!key->empty()) query[*key] = *value;
  }
  return query;
}

std::string cookie_value(const std::string& header, std::string_view name) {
  std::string_view rest = header;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    std::string_view pair = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    while (!pair.empty() && pair.front() == ' ') pair.remove_prefix(1);
    const std::size_t equals = pair.find('=');
    if (equals != std::string_view::npos && pair.substr(0, equals) == name) return std::string(pair.substr(equals + 1));
  }
  return {};
}

}  // namespace homeward::server
