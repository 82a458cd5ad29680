// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace homeward::testing {

/// A rosbridge for tests, written from the public protocol description (version 2 of ROSBRIDGE_PROTOCOL.md in
/// RobotWebTools/rosbridge_suite): advertise, unadvertise, publish, subscribe with throttle_rate and queue_length,
/// unsubscribe, and status messages for what is wrong. It carries any JSON as a message and knows the types of the
/// topics that it was told to serve. Functions may be called from any thread.
class RosbridgeServer {
 public:
  struct Events {
    std::function<void(const std::string& topic, const nlohmann::json& msg)> published;  // by a client
  };
  /// Listens on 127.0.0.1; port 0: any. Throws when it cannot.
  RosbridgeServer(unsigned short port, Events events);
  ~RosbridgeServer();
  RosbridgeServer(const RosbridgeServer&) = delete;
  RosbridgeServer& operator=(const RosbridgeServer&) = delete;

  [[nodiscard]] unsigned short port() const;
  /// A node of the robot publishes or listens on this topic with this type.
  void serve_topic(const std::string& topic, const std::string& type);
  /// From a node of the robot to every client that has subscribed.
  void publish(const std::string& topic, nlohmann::json msg);
  /// Any text to every client, whole or broken.
  void send_raw(const std::string& text);
  /// Ends all connections without a word, as a cable that is pulled.
  void cut();
  /// Neither reads nor writes for a while, as a network that stalls.
  void freeze(std::chrono::milliseconds duration);
  /// No new connections, and those that there are end; or connections again.
  void refuse(bool refused);

  [[nodiscard]] int connections() const;                       // made so far
  [[nodiscard]] std::vector<std::string> subscribed() const;   // topics that a client listens to now
  [[nodiscard]] std::vector<nlohmann::json> received() const;  // all that clients have said

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace homeward::testing
