// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <functional>
#include <memory>
#include <string>

#include "server/ws/socket.hpp"

namespace homeward::server {

/// One open WebSocket. Lives on the socket thread; wake() and close() may come from any. Messages are pulled from the
/// handler one at a time, so that a slow reader costs one message and not a queue.
class WebSocketSession : public Socket, public std::enable_shared_from_this<WebSocketSession> {
 public:
  using HttpRequest = boost::beast::http::request<boost::beast::http::string_body>;

  WebSocketSession(boost::beast::tcp_stream stream, std::shared_ptr<SocketHandler> handler,
                   std::function<void()> on_end);
  ~WebSocketSession() override;
  void accept(HttpRequest request);
  void wake() override;
  void close(std::uint16_t code, const std::string& reason) override;
  /// Cuts the connection at once. On the socket thread.
  void cut();

 private:
  void read();
  void write();
  void begin_close();
  /// Calls the handler; what it throws ends this socket. False when it did.
  template <class Call>
  bool guarded(const Call& call);
  void end();

  boost::beast::websocket::stream<boost::beast::tcp_stream> stream_;
  boost::asio::any_io_executor executor_;
  std::shared_ptr<SocketHandler> handler_;
  std::function<void()> on_end_;
  boost::beast::flat_buffer buffer_;
  HttpRequest request_;
  Outgoing being_written_;
  boost::asio::steady_timer taken_within_;
  bool open_ = false;
  bool writing_ = false;
  bool ended_ = false;
  bool closing_ = false;
  boost::beast::websocket::close_reason close_reason_;
};

}  // namespace homeward::server
