// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "driving/body.hpp"
#include "wire/rosbridge_json.hpp"

namespace homeward::agent {

// What the agent says to a rosbridge (version 2 of its protocol, "ROSBRIDGE_PROTOCOL.md" of
// RobotWebTools/rosbridge_suite), and how the bridges of ROS 1 (0.11) and ROS 2 take it.

/// A topic that is listened to, and the least time between two messages that are of use.
struct RosSubscription {
  wire::RosTopic topic;
  int least_ms = 0;
};

/// Those of sensors: odometry, then the scan where there is one, pictures, and each sensor of the ring.
std::vector<RosSubscription> sensed_topics(const wire::RosbridgeFile& robot);
/// The rider's. Precondition: the robot has it.
RosSubscription rider_topic(const wire::RosbridgeFile& robot);

/// What is said first on a connection: `cmd_vel` is published, and listened to, since a bridge says nothing of what it
/// refuses; and the topics that are wanted.
std::vector<std::string> ros_greeting(const wire::RosbridgeFile& robot);
/// Asks anew for a topic on which nothing comes: the bridge of ROS 2 takes the quality of service of the publishers
/// that it knows when it is asked. The type is given as the other version of ROS writes it, too
/// ("sensor_msgs/LaserScan", "sensor_msgs/msg/LaserScan"): a bridge passes over the name that it does not know.
std::vector<std::string> ros_asked_again(const RosSubscription& subscription);
/// Publishes `cmd_vel` anew in the same way, and listens to it.
std::vector<std::string> ros_advertised_again(const wire::RosbridgeFile& robot);
/// What is said last: topics are given back.
std::vector<std::string> ros_farewell(const wire::RosbridgeFile& robot);
/// A Twist for the wheels. A stamped one has a header without a stamp, which a bridge fills in by the robot's clock; it
/// does so only where there is a header.
std::string ros_motion(const wire::RosbridgeFile& robot, const driving::Motion& motion);

}  // namespace homeward::agent
