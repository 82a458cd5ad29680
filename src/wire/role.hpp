// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

namespace homeward::wire {

/// What somebody may do. Each person's role includes those before it; kRobot stands apart.
enum class Role { kViewer, kRider, kCarer, kInstaller, kAdmin, kRobot };

/// "viewer", "rider", "carer", "installer", "admin", "robot".
std::string_view role_name(Role role);

/// The role of that name; nothing when there is none.
std::optional<Role> role(std::string_view name);

/// Whether who has `role` may do all that `other` may.
constexpr bool includes(Role role, Role other) {
  if (role == Role::kRobot || other == Role::kRobot) return role == other;
  return role >= other;
}

}  // namespace homeward::wire
