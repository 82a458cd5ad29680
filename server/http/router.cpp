// SPDX-License-Identifier: Apache-2.0
#include "server/http/router.hpp"

#include <set>

namespace homeward::server {
namespace {

std::vector<std::string> segments_of(std::string_view path) {
  std::vector<std::string> segments;
  while (!path.empty()) {
    path.remove_prefix(1);  // the slash
    const std::size_t end = std::min(path.find('/'), path.size());
    segments.emplace_back(path.substr(0, end));
    path.remove_prefix(end);
  }
  return segments;
}

bool is_parameter(const std::string& segment) { return segment.size() > 2 && segment.front() == '{'; }

}  // namespace

void Router::add(Route route) {
  std::vector<std::string> segments = segments_of(route.operation.pattern);
  entries_.push_back({std::move(route), std::move(segments)});
}

Router::Match Router::find(const std::string& method, const std::string& path) const {
  Match match;
  if (path.empty() || path.front() != '/') return match;
  const std::vector<std::string> asked = segments_of(path);
  const std::string wanted = method == "HEAD" ? "GET" : method;
  std::set<std::string> allowed;
  int best_literals = -1;
  for (const Entry& entry : entries_) {
    if (entry.segments.size() != asked.size()) continue;
    std::map<std::string, std::string> parameters;
    int literals = 0;
    bool fits = true;
    for (std::size_t i = 0; i < asked.size() && fits; ++i) {
      const std::string& pattern = entry.segments[i];
      if (is_parameter(pattern)) {
        const auto decoded = percent_decoded(asked[i]);
        fits = decoded && !decoded->empty() && decoded->size() <= 600;
        if (fits) parameters[pattern.substr(1, pattern.size() - 2)] = *decoded;
      } else {
        fits = pattern == asked[i];
        ++literals;
      }
    }
    if (!fits) continue;
    const std::string offered(entry.route.operation.method);
    allowed.insert(offered);
    // A path spelled out beats one with parameters: maps/import is not a map called "import".
    if (offered == wanted && literals > best_literals) {
      best_literals = literals;
      match.route = &entry.route;
      match.parameters = std::move(parameters);
    }
  }
  if (allowed.contains("GET")) allowed.insert("HEAD");
  if (!allowed.empty()) allowed.insert("OPTIONS");
  for (const std::string& one : allowed) match.allowed += (match.allowed.empty() ? "" : ", ") + one;
  return match;
}

std::vector<Operation> Router::operations() const {
  std::vector<Operation> operations;
  for (const Entry& entry : entries_) operations.push_back(entry.route.operation);
  return operations;
}

}  // namespace homeward::server
