// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/http/allowed_roles.hpp"
#include "server/http/message.hpp"
#include "server/ws/socket.hpp"

namespace homeward::server {

/// Where a handler runs.
enum class Lane {
  kNow,      // on the socket thread at once: stops, health. Must not wait for anything
  kWork,     // on the request workers: the store, small things
  kHeavy,    // on the bounded pool for pictures; 503 when it is full
  kSlow,     // what may take seconds and nobody drives by: one at a time, behind all else; 503 when too many wait
  kBulk,     // whole maps: one at a time, behind all else; 503 when too many wait
  kPassword  // one at a time, a few of each address; 503 when too many wait
};

inline constexpr std::size_t kMaxSecretBody = 16UL * 1024;  // what a stranger may send: a name and a password
inline constexpr std::size_t kMaxJsonBody = 1024UL * 1024;
inline constexpr std::size_t kMaxImageBody = 32UL * 1024 * 1024;
inline constexpr std::size_t kMaxMapBody = 1024UL * 1024 * 1024;  // more than a map file of 50,000 places

/// What holds of an operation whoever asks for it and whatever it does.
struct Operation {
  std::string_view id;  // its operationId in proto/openapi.yaml
  std::string_view method;
  std::string_view pattern;  // "/api/v1/tours/{tour}/images/{n}"
  AllowedRoles roles;
  Lane lane = Lane::kWork;
  std::size_t max_body = 0;          // bytes
  bool answer_holds_secret = false;  // the answer must not lie on the disk nor stand in a log
};

/// What a WebSocket handshake comes to: a refusal, or what the socket is for.
using Upgrade = std::variant<Response, std::shared_ptr<SocketHandler>>;

using Handler = std::function<Response(Request&)>;
using SocketOpener = std::function<Upgrade(Request&)>;

struct Route {
  Operation operation;
  Handler handler;
  SocketOpener open_socket = nullptr;  // of an operation that is a WebSocket
};

/// Finds the handler of a request by method and path.
class Router {
 public:
  void add(Route route);

  struct Match {
    const Route* route = nullptr;                   // null: no such path, or not with this method
    std::string allowed;                            // methods of this path, "GET, HEAD, PUT"; empty: no such path
    std::map<std::string, std::string> parameters;  // decoded
  };
  /// HEAD is answered by GET's route.
  [[nodiscard]] Match find(const std::string& method, const std::string& path) const;
  /// The operations that have a route, in the order in which they were added.
  [[nodiscard]] std::vector<Operation> operations() const;

 private:
  struct Entry {
    Route route;
    std::vector<std::string> segments;
  };
  std::vector<Entry> entries_;
};

}  // namespace homeward::server
