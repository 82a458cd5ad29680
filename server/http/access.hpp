// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "server/http/message.hpp"

namespace homeward::server {

/// Which names this server answers to. A browser that was led here under another name (DNS rebinding) is refused, and
/// so is a page of another site that uses the visitor's cookie.
class AccessPolicy {
 public:
  /// `extra_hosts`: names besides the loopback ones, without port. `proxies`: addresses that are believed when they say
  /// for whom they ask.
  explicit AccessPolicy(const std::set<std::string>& extra_hosts, std::set<std::string> proxies = {});

  /// Whether the Host header ("name", "name:port", "[::1]:port") names this server.
  [[nodiscard]] bool host_allowed(std::string_view host_header) const;
  /// Whether an Origin header ("http://name:port") is a page of this server: same host and port as asked for.
  [[nodiscard]] bool origin_allowed(std::string_view origin, std::string_view host_header) const;
  /// Whether a request that a cookie signs and that changes something, or opens a socket, comes from our own page.
  [[nodiscard]] bool from_own_page(const Request& request) const;
  /// The address that a request comes from: the last one of X-Forwarded-For where a proxy that is believed says so,
  /// otherwise the other end's.
  [[nodiscard]] std::string sender_of(const Request& request) const;
  /// Whether a proxy that is believed says that it was asked over TLS (X-Forwarded-Proto). To be asked with the other
  /// end's address in `remote`.
  [[nodiscard]] bool came_by_tls(const Request& request) const;

 private:
  std::set<std::string> hosts_;
  std::set<std::string> proxies_;
};

/// "name" of "name:port"; lower case; "[::1]" stays in brackets.
std::string host_without_port(std::string_view host);

/// Whether this is an IPv4 or IPv6 address.
bool is_ip_address(const std::string& text);

/// Whether an address to listen on is reachable from this machine alone.
bool is_loopback(std::string_view address);

/// Sent with every answer: no scripts but ours, no frames, no guessing of types.
void add_security_headers(Response& response);

}  // namespace homeward::server
