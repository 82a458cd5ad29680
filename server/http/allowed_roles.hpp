// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "wire/role.hpp"

namespace homeward::server {

/// Who may call an operation.
class AllowedRoles {
 public:
  /// Everybody, also who is not signed in.
  static constexpr AllowedRoles anyone() {
    AllowedRoles roles;
    roles.anyone_ = true;
    return roles;
  }
  /// Who has this role or one that includes it (wire::includes).
  static constexpr AllowedRoles at_least(wire::Role least) {
    AllowedRoles roles;
    roles.least_ = least;
    return roles;
  }
  /// The same, and robots.
  static constexpr AllowedRoles at_least_or_robot(wire::Role least) {
    AllowedRoles roles = at_least(least);
    roles.robots_too_ = true;
    return roles;
  }

  [[nodiscard]] constexpr bool includes_anyone() const { return anyone_; }
  [[nodiscard]] constexpr bool allow(wire::Role role) const {
    return anyone_ || wire::includes(role, least_) || (robots_too_ && role == wire::Role::kRobot);
  }
  /// As proto/openapi.yaml writes it in x-homeward-role: "anyone", "viewer", "robot", "installer, robot".
  [[nodiscard]] std::string text() const {
    if (anyone_) return "anyone";
    return std::string(wire::role_name(least_)) + (robots_too_ ? ", robot" : "");
  }

 private:
  constexpr AllowedRoles() = default;

  bool anyone_ = false;
  bool robots_too_ = false;
  wire::Role least_ = wire::Role::kAdmin;
};

}  // namespace homeward::server
