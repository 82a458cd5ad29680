// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <list>
#include <memory>
#include <mutex>

#include "server/ws/socket.hpp"
#include "wire/event_json.hpp"

namespace homeward::server {

class EventSubscriber;

/// Tells dashboards what changed. Each subscriber keeps only the newest state of each object that it was not sent yet,
/// so that a slow one loses old states and never holds up others.
class EventHub {
 public:
  using MakeSnapshot = std::function<wire::Snapshot()>;

  /// Callable from any thread.
  void publish(const wire::Event& event);
  /// A new subscriber; `snapshot` is its first message, made before any change that it misses is lost.
  std::shared_ptr<SocketHandler> subscribe(const MakeSnapshot& snapshot);
  [[nodiscard]] std::size_t subscribers();

 private:
  std::mutex mutex_;
  std::list<std::weak_ptr<EventSubscriber>> subscribers_;
};

}  // namespace homeward::server
