// SPDX-License-Identifier: Apache-2.0
#include "server/http/access.hpp"

#include <arpa/inet.h>

namespace homeward::server {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return result;
}

}  // namespace

AccessPolicy::AccessPolicy(const std::set<std::string>& extra_hosts, std::set<std::string> proxies)
    : proxies_(std::move(proxies)) {
  hosts_ = {"localhost", "127.0.0.1", "[::1]"};
  for (const std::string& host : extra_hosts) hosts_.insert(lower(host));
}

std::string host_without_port(std::string_view host) {
  if (!host.empty() && host.front() == '[') {
    const std::size_t end = host.find(']');
    return end == std::string_view::npos ? std::string() : lower(host.substr(0, end + 1));
  }
  return lower(host.substr(0, std::min(host.find(':'), host.size())));
}

bool AccessPolicy::host_allowed(std::string_view host_header) const {
  const std::string host = host_without_port(host_header);
  const std::string_view rest = host_header.substr(std::min(host.size(), host_header.size()));
  // Nothing but a port after it: "localhost:80@elsewhere" names elsewhere.
  const bool port = rest.empty() || (rest.front() == ':' && rest.find_first_not_of("0123456789", 1) == rest.npos);
  return port && hosts_.contains(host);
}

bool AccessPolicy::origin_allowed(std::string_view origin, std::string_view host_header) const {
  const std::string text = lower(origin);
  const std::size_t scheme = text.find("://");
  if (scheme == std::string::npos) return false;  // "null" among them
  const std::string protocol = text.substr(0, scheme);
  if (protocol != "http" && protocol != "https") return false;
  const std::string authority = text.substr(scheme + 3);
  return authority == lower(host_header) && host_allowed(authority);
}

bool AccessPolicy::from_own_page(const Request& request) const {
  const std::string origin = request.header("origin");
  if (!origin.empty()) return origin_allowed(origin, request.header("host"));
  return request.header("sec-fetch-site") == "same-origin";
}

std::string AccessPolicy::sender_of(const Request& request) const {
  if (!proxies_.contains(request.remote)) return request.remote;
  std::string sender = request.header("x-forwarded-for");
  sender.erase(0, sender.find_last_of(", ") + 1);  // whoever came before may say anything
  return is_ip_address(sender) ? sender : request.remote;
}

bool AccessPolicy::came_by_tls(const Request& request) const {
  return proxies_.contains(request.remote) && lower(request.header("x-forwarded-proto")) == "https";
}

bool is_ip_address(const std::string& text) {
  in6_addr parsed{};  // has room for both
  return inet_pton(AF_INET, text.c_str(), &parsed) == 1 || inet_pton(AF_INET6, text.c_str(), &parsed) == 1;
}

bool is_loopback(std::string_view address) {
  return address == "localhost" || address == "::1" || address == "[::1]" || address.substr(0, 4) == "127.";
}

void add_security_headers(Response& response) {
  auto& headers = response.headers;
  headers.try_emplace("content-security-policy",
                      "default-src 'self'; img-src 'self' blob:; object-src 'none'; base-uri 'none'; "
                      "form-action 'self'; frame-ancestors 'none'");
  headers.try_emplace("x-content-type-options", "nosniff");
  headers.try_emplace("x-frame-options", "DENY");
  headers.try_emplace("referrer-policy", "no-referrer");
  headers.try_emplace("cross-origin-resource-policy", "same-origin");
  headers.try_emplace("cache-control", "no-store");
}

}  // namespace homeward::server
