// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "figures.hpp"
#include "map/topological_map.hpp"
#include "support/http_client.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::bench {

/// What a process holds now, and the most it held since its peak was forgotten.
struct Usage {
  double resident_mib = 0.0;
  double peak_mib = 0.0;
  int descriptors = 0;
  double processor_s = 0.0;  // of all its threads, since it started
};

struct Robot {
  std::string id;
  std::string token;
};

/// The real homeward-server with an empty data folder on a free port, and its first administrator. Ended, its folder
/// removed, when this goes. Whatever fails throws std::runtime_error with the last lines of the server's log.
class ServerProcess {
 public:
  /// `bin`: the folder with homeward-server. `threads`: its --threads, 0 for its own choice.
  ServerProcess(const std::filesystem::path& bin, int threads);
  ~ServerProcess();
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Signed in as the administrator, by cookie.
  testing::HttpClient& admin() { return *admin_; }
  /// A new bearer token of that role.
  std::string token(const std::string& role);
  /// The id of the map on the server.
  std::string import_map(const map::TopologicalMap& map);
  /// A new robot on that map.
  Robot add_robot(const std::string& name, const std::string& map);
  /// The answer, which has to have that status.
  testing::Answer expect(int status, testing::Answer answer);

  [[nodiscard]] Usage usage() const;
  /// The peak of memory counts from now on.
  void forget_peak() const;

 private:
  void start(const std::filesystem::path& bin, int threads);
  void set_up();
  [[noreturn]] void give_up(const std::string& why) const;

  testing::ScratchFolder folder_;
  pid_t pid_ = -1;
  std::uint16_t port_ = 0;
  std::optional<testing::HttpClient> admin_;
};

/// Watches what a server holds, from now until told to stop.
class UsageWatch {
 public:
  explicit UsageWatch(const ServerProcess& server);
  /// Memory and descriptors at the start, at most and now, the server's processor time meanwhile, and this program's
  /// own: what the load took from the server.
  nlohmann::json figures();

 private:
  const ServerProcess& server_;
  Usage start_;
  double own_start_s_;
  std::atomic<int> most_descriptors_;
  std::jthread thread_;  // last: it uses what is above
};

}  // namespace homeward::bench
