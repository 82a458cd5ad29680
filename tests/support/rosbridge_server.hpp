// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace homeward::testing {

/// A rosbridge for tests, which does what those of ROS 1 (rosbridge_suite 0.11.17) and ROS 2 do: advertise,
/// unadvertise, publish, subscribe with throttle_rate and queue_length, unsubscribe, fragments. As they do it tells its
/// clients nothing of what is wrong: a publication or subscription whose type's name or fields do not fit is passed
/// over; whoever publishes on a topic and listens to it hears himself. It answers pings when nothing else is to be
/// said. It carries any JSON as a message, but Twists as they are (ros_twists.hpp). Functions may be called from any
/// thread.
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
  /// From now on what nodes publish goes out so much later, while pings are answered at once: a bridge that waits until
  /// its client takes more.
  void delay(std::chrono::milliseconds time);
  /// From now on what clients say is taken up so much later; what was not when the connection ends never is.
  void take_up_after(std::chrono::milliseconds time);
  /// From now on a first message that does not authenticate its client ends the connection.
  void authenticate();
  /// From now on messages longer than this go out in fragments, unless the client has asked for longer ones.
  void fragment(std::size_t most_bytes);
  /// Ends all connections without a word, as a cable that is pulled.
  void cut();
  /// Neither reads nor writes for a while, as a network that stalls.
  void freeze(std::chrono::milliseconds duration);
  /// No new connections, and those that there are end; or connections again.
  void refuse(bool refused);

  [[nodiscard]] int connections() const;                       // made so far
  [[nodiscard]] std::vector<std::string> subscribed() const;   // topics that a client listens to now
  [[nodiscard]] std::vector<nlohmann::json> received() const;  // all that clients have said and that was taken up
  [[nodiscard]] std::vector<std::string> paths() const;        // that clients asked for when they connected

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace homeward::testing
