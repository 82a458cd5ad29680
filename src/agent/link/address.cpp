// SPDX-License-Identifier: Apache-2.0
#include "agent/link/address.hpp"

#include <algorithm>
#include <cctype>

namespace homeward::agent {

namespace {

/// `rest`: what follows the scheme; `address` holds the scheme's own port.
Result<ServerAddress> parse_host(std::string rest, ServerAddress address, const std::string& text,
                                 const std::string& example) {
  const auto wrong = [&](const std::string& why) {
    return fail(ErrorCode::kInvalidInput, why + " An address looks like " + example + ".", text);
  };
  if (rest.ends_with('/')) rest.pop_back();
  if (rest.find('/') != std::string::npos) return wrong("The address must not have a path.");
  const std::size_t colon = rest.rfind(':');
  const bool bracketed = rest.starts_with('[');
  if (colon != std::string::npos && (!bracketed || rest.find(']') < colon)) {
    address.port = rest.substr(colon + 1);
    rest = rest.substr(0, colon);
  }
  const bool digits =
      !address.port.empty() && address.port.size() <= 5 &&
      std::all_of(address.port.begin(), address.port.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  if (!digits) return wrong("The port must be a number.");
  if (bracketed && rest.ends_with(']')) rest = rest.substr(1, rest.size() - 2);
  if (rest.empty()) return wrong("The address names no host.");
  address.host = rest;
  return address;
}

}  // namespace

Result<ServerAddress> parse_address(const std::string& text) {
  const std::string example = "http://127.0.0.1:8080";
  if (text.starts_with("http://")) return parse_host(text.substr(7), {false, "", "80"}, text, example);
  if (text.starts_with("https://")) return parse_host(text.substr(8), {true, "", "443"}, text, example);
  return fail(ErrorCode::kInvalidInput,
              "The address must begin with http:// or https://. An address looks like " + example + ".", text);
}

Result<ServerAddress> parse_websocket_address(const std::string& text) {
  const std::string example = "ws://192.168.1.7:9090";
  if (text.starts_with("ws://")) return parse_host(text.substr(5), {false, "", "80"}, text, example);
  return fail(ErrorCode::kInvalidInput, "The address must begin with ws://. An address looks like " + example + ".",
              text);
}

}  // namespace homeward::agent
