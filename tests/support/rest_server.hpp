// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace homeward::testing {

/// A web server for one client at a time, in a thread of its own, that answers what the test says.
class RestServer {
 public:
  struct Request {
    std::string method;
    std::string path;
    std::string idempotency_key;  // empty: none
    std::string body;
  };
  struct Reply {
    int status = 200;
    std::string body = {};
    bool lost = false;  // the connection ends in its place
  };
  using Handler = std::function<Reply(const Request& request)>;

  /// Listens on any port of 127.0.0.1. `handler` is called from the thread. Throws when it cannot.
  explicit RestServer(Handler handler);
  ~RestServer();
  RestServer(const RestServer&) = delete;
  RestServer& operator=(const RestServer&) = delete;

  [[nodiscard]] unsigned short port() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace homeward::testing
