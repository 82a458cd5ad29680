// SPDX-License-Identifier: Apache-2.0
#include "agent/link/address.hpp"

#include <algorithm>
#include <cctype>

namespace homeward::agent {

Result<ServerAddress> parse_address(const std::string& text) {
  const auto wrong = [&](const std::string& why) {
    return fail(ErrorCode::kInvalidInput, why + " An address looks like http://127.0.0.1:8080.", text);
  };
  ServerAddress address;
  std::string rest;
  if (text.starts_with("http://")) {
    rest = text.substr(7);
    address.port = "80";
  } else if (text.starts_with("https://")) {
    rest = text.substr(8);
    address.tls = true;
    address.port = "443";
  } else {
    return wrong("The address must begin with http:// or https://.");
  }
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

}  // namespace homeward::agent
