// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <variant>

#include "server/http/message.hpp"
#include "server/http/open_connections.hpp"
#include "server/http/router.hpp"

namespace homeward::server {

inline constexpr std::size_t kAnswerSlice_bytes = 64UL * 1024;

/// What a connection may take, and how long.
struct ServerLimits {
  std::size_t max_header_bytes = 16UL * 1024;
  int header_timeout_ms = 15'000;  // for the head of a request, idle connections included
  int body_timeout_ms = 60'000;    // for a body
  int answer_timeout_ms = 10'000;  // for each kAnswerSlice_bytes of an answer to be taken
  ConnectionLimits connections;
};

/// Answers a request whose head and body were read. `reply` is called exactly once, from any thread.
using Reply = std::function<void(Response)>;

/// The application behind the front. Called from the socket thread alone; must not wait.
class Front {
 public:
  virtual ~Front() = default;
  /// Whether to read the body of this request, and how much of it: a limit, or the refusal. Nothing is read of a
  /// stranger where not everybody may ask. Sets the caller, and the sender's address.
  virtual std::variant<std::size_t, Response> admit(Request& request) = 0;
  virtual void answer(std::shared_ptr<Request> request, Reply reply) = 0;
  /// A WebSocket handshake: its handler, or the refusal. May take a while: `reply` as above.
  virtual void upgrade(std::shared_ptr<Request> request, std::function<void(Upgrade)> reply) = 0;
  /// Whether who has opened a socket with this handshake might still do so: asked about twice a second of each that is
  /// open, which is closed when not.
  [[nodiscard]] virtual bool still_welcome(const Request& handshake) const = 0;
};

}  // namespace homeward::server
