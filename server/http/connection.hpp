// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include <boost/asio.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/beast/core.hpp>
#include <memory>
#include <vector>

#include "server/http/front.hpp"
#include "server/http/open_connections.hpp"
#include "server/ws/websocket_session.hpp"

namespace homeward::server {

/// A connection's place among those that may be open at once; given back when this goes.
class ConnectionPlace {
 public:
  ConnectionPlace(OpenConnections& open, OpenConnections::Id id) : open_(open), id_(id) {}
  ConnectionPlace(const ConnectionPlace&) = delete;
  ConnectionPlace& operator=(const ConnectionPlace&) = delete;
  ~ConnectionPlace() { open_.leave(id_); }
  [[nodiscard]] OpenConnections::Id id() const { return id_; }

 private:
  OpenConnections& open_;
  OpenConnections::Id id_;
};

/// A WebSocket and the request that it began with.
struct OpenSocket {
  std::shared_ptr<const Request> handshake;
  std::weak_ptr<WebSocketSession> session;
};

/// What the connections of a server share. Outlives them.
struct Serving {
  Front& front;
  const ServerLimits& limits;
  boost::asio::io_context& context;
  OpenConnections& open;
  std::vector<OpenSocket>& sockets;
  const bool& ending;  // no socket may be opened any more
};

/// Reads requests from a connection and answers each, until one of both ends it or it becomes a WebSocket. Closes it
/// where there is no place for it. What is thrown while it is served ends this connection alone.
boost::asio::awaitable<void> serve_connection(Serving serving, boost::beast::tcp_stream stream);

}  // namespace homeward::server
