// SPDX-License-Identifier: Apache-2.0
#include "agent/link/address.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

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

Result<WebSocketAddress> parse_websocket_address(const std::string& text) {
  const std::string example = "ws://192.168.1.7:9090";
  const auto wrong = [&](const std::string& why) {
    return fail(ErrorCode::kInvalidInput, why + " An address looks like " + example + ".", text);
  };
  const bool tls = text.starts_with("wss://");
  if (!tls && !text.starts_with("ws://")) return wrong("The address must begin with ws:// or wss://.");
  std::string host = text.substr(tls ? 6 : 5);
  WebSocketAddress address;
  if (const std::size_t slash = host.find('/'); slash != std::string::npos) {
    address.path = host.substr(slash);
    host.resize(slash);
  }
  // The path goes into a line of the handshake as it is.
  const bool plain = std::all_of(address.path.begin(), address.path.end(), [](char c) { return c > 0x20 && c < 0x7F; });
  if (!plain || address.path.find('#') != std::string::npos) {
    return wrong("The path of the address has characters that do not belong there; write them as %20 and the like.");
  }
  auto server = parse_host(host, {tls, "", tls ? "443" : "80"}, text, example);
  if (!server) return pass_on(server);
  address.server = std::move(*server);
  return address;
}

}  // namespace homeward::agent
