// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "core/pose2.hpp"

namespace homeward::scenario {

/// What somebody beside the robot says who is asked whether it is at its destination, by where it truly is. Nothing:
/// nobody says anything.
using Answers = std::function<std::optional<bool>(const Pose2& world_from_robot)>;

/// "nobody"; "right": the truth, which is that it is within half a metre; "yes", whatever is true. Nothing for another
/// name. `destination`: the true pose of its picture.
std::optional<Answers> answers_named(const std::string& name, const Pose2& destination);

}  // namespace homeward::scenario
