// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace homeward::testing {

/// Whether a bridge takes `name` for the type of a topic: ROS 1 knows no name but its own ("geometry_msgs/Twist"), ROS
/// 2 takes both its own ("geometry_msgs/msg/Twist") and that of ROS 1.
bool names_type(const std::string& name, const std::string& type);

/// A message as the nodes of a topic of this type get it from a bridge: what a Twist or TwistStamped leaves out is
/// zero, and the stamp of a header that is there is now; nothing where it has other fields. Messages of other types as
/// they are.
std::optional<nlohmann::json> as_published(const std::string& type, const nlohmann::json& msg);

}  // namespace homeward::testing
