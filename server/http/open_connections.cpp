// SPDX-License-Identifier: Apache-2.0
#include "server/http/open_connections.hpp"

#include <algorithm>
#include <utility>

namespace homeward::server {

std::optional<OpenConnections::Id> OpenConnections::enter(const std::string& address, std::function<void()> cut,
                                                          SteadyTime now) {
  const Matches stranger = [](const Connection& c) { return c.is_stranger(); };
  const Matches stranger_from_there = [&](const Connection& c) { return c.is_stranger() && c.address == address; };
  if (count(stranger_from_there) >= limits_.strangers_of_address) evict(stranger_from_there);
  if (count(stranger) >= limits_.strangers) evict(stranger);
  if (connections_.size() >= limits_.most && !evict(stranger)) {
    const bool room = evict([](const Connection& c) { return !c.socket && !c.busy; });
    if (!room) return std::nullopt;
  }
  const Id id = next_++;
  connections_[id] = {address, std::move(cut), now};
  return id;
}

void OpenConnections::recognised(Id id, bool known) {
  const auto found = connections_.find(id);
  if (found != connections_.end()) found->second.known = known;
}

bool OpenConnections::is_recognised(Id id) const {
  const auto found = connections_.find(id);
  return found != connections_.end() && found->second.known;
}

void OpenConnections::began(Id id) {
  const auto found = connections_.find(id);
  if (found != connections_.end()) found->second.busy = true;
}

void OpenConnections::ended(Id id, SteadyTime now) {
  const auto found = connections_.find(id);
  if (found == connections_.end()) return;
  found->second.busy = false;
  found->second.since = now;
}

void OpenConnections::became_socket(Id id, std::function<void()> cut) {
  const auto found = connections_.find(id);
  if (found == connections_.end()) return cut();  // has had to go meanwhile
  found->second.socket = true;
  found->second.cut = std::move(cut);
}

void OpenConnections::cut_all() {
  const auto all = std::exchange(connections_, {});
  for (const auto& [id, connection] : all) connection.cut();
}

std::size_t OpenConnections::count(const Matches& matches) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(connections_, [&](const auto& entry) { return matches(entry.second); }));
}

/// Cuts the one of them that has waited longest, those that are being answered last; false when there is none. It has
/// left when this returns.
bool OpenConnections::evict(const Matches& matches) {
  auto longest = connections_.end();
  for (auto at = connections_.begin(); at != connections_.end(); ++at) {
    if (!matches(at->second)) continue;
    const auto rank = [](const Connection& c) { return std::pair(c.busy, c.since); };
    if (longest == connections_.end() || rank(at->second) < rank(longest->second)) longest = at;
  }
  if (longest == connections_.end()) return false;
  const std::function<void()> cut = std::move(longest->second.cut);
  connections_.erase(longest);
  cut();
  return true;
}

}  // namespace homeward::server
