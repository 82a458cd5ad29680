// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>

#include "server/ws/socket.hpp"
#include "wire/event_json.hpp"

namespace homeward::server {

class EventSubscriber;

/// How often dashboards hear of a server that has nothing else to tell; a longer silence is one of the server or of the
/// network (proto/asyncapi.yaml).
inline constexpr std::chrono::seconds kHeartbeatEvery{1};

/// Tells dashboards what changed. Each subscriber keeps only the newest state of each object that it was not sent yet,
/// so that a slow one loses old states and never holds up others.
class EventHub {
 public:
  using MakeSnapshot = std::function<wire::Snapshot()>;

  /// Callable from any thread.
  void publish(const wire::Event& event);
  /// Publishes a heartbeat when the last one is kHeartbeatEvery old. To be called more often than that, from any
  /// thread.
  void beat(std::chrono::steady_clock::time_point now);
  /// A new subscriber; `snapshot` is its first message, made before any change that it misses is lost.
  std::shared_ptr<SocketHandler> subscribe(const MakeSnapshot& snapshot);
  [[nodiscard]] std::size_t subscribers();

 private:
  std::mutex mutex_;
  std::list<std::weak_ptr<EventSubscriber>> subscribers_;
  std::optional<std::chrono::steady_clock::time_point> beat_at_;  // the last one
};

}  // namespace homeward::server
