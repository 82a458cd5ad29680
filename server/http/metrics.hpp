// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace homeward::server {

/// What Prometheus reads at /metrics. Thread-safe.
class Metrics {
 public:
  Metrics();
  ~Metrics();
  /// One answered request; `route` is the pattern, never the path, so that the number of series stays bounded.
  void answered(const std::string& method, const std::string& route, int status, double seconds);
  /// A value that is asked for when somebody reads the metrics.
  void gauge(const std::string& name, const std::string& help, std::function<double()> read);
  [[nodiscard]] std::string text();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace homeward::server
