// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <set>
#include <string>

#include "core/result.hpp"
#include "server/time/clock.hpp"

namespace homeward::server {

struct AppConfig {
  std::filesystem::path data;
  std::string address = "127.0.0.1";
  std::uint16_t port = 8080;         // 0: any free one
  std::filesystem::path web;         // empty: no dashboard
  std::filesystem::path setup_file;  // where the one-time link is written besides the log; empty: nowhere
  std::set<std::string> allowed_hosts;
  std::set<std::string> trusted_proxies;  // addresses that are believed when they say for whom they ask
  bool allow_plain_http = false;
  int longest_mission_s = 0;  // a mission is stopped after it; 0: by the length of its way (planning/retry_policy.hpp)
  int threads = 0;            // of the pool for pictures and of builds; 0: as many as the machine has
};

/// Everything that is wrong with a configuration; empty when it is fine.
std::vector<std::string> problems(const AppConfig& config);

class Router;

/// The whole server: store, services, pools and front, wired together.
class App {
 public:
  /// `clock` has to outlive it. Errors: those of the store and of listening.
  static Result<std::unique_ptr<App>> start(const AppConfig& config, const Clock& clock = system_clock());
  ~App();
  App(const App&) = delete;
  App& operator=(const App&) = delete;

  [[nodiscard]] std::uint16_t port() const;
  /// The one-time link, or empty when there is an administrator already.
  [[nodiscard]] const std::string& setup_link() const;
  /// What is answered, and to whom.
  [[nodiscard]] const Router& router() const;

  // For tests that let the clock's time pass. From any thread.
  /// What it does by itself every wire::kPermitEvery_ms: permits, leases that end, heartbeats.
  void tick();
  /// Returns once no request, picture, job or write to the store waits or is being worked on.
  void work_off();

 private:
  struct Parts;
  App();
  std::unique_ptr<Parts> parts_;
};

}  // namespace homeward::server
