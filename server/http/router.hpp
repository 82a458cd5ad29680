// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "server/http/message.hpp"

namespace homeward::server {

/// Where a handler runs.
enum class Lane {
  kNow,   // on the socket thread at once: stops, health. Must not wait for anything
  kWork,  // on the request workers: the store, small things
  kHeavy  // on the bounded pool for pictures and passwords; 503 when it is full
};

inline constexpr std::size_t kMaxJsonBody = 1024UL * 1024;
inline constexpr std::size_t kMaxImageBody = 32UL * 1024 * 1024;
inline constexpr std::size_t kMaxMapBody = 256UL * 1024 * 1024;

using Handler = std::function<Response(Request&)>;

struct Route {
  std::string method;
  std::string pattern;  // "/api/v1/tours/{tour}/images/{n}"
  std::string role;     // least role: "anyone", "viewer", ..., "robot"; "installer, robot" allows both
  Lane lane = Lane::kWork;
  std::size_t max_body = kMaxJsonBody;
  Handler handler;
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

 private:
  struct Entry {
    Route route;
    std::vector<std::string> segments;
  };
  std::vector<Entry> entries_;
};

}  // namespace homeward::server
