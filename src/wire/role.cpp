// SPDX-License-Identifier: Apache-2.0
#include "wire/role.hpp"

#include "core/enum_names.hpp"

namespace homeward::wire {
namespace {

constexpr EnumNames<Role, 6> kRoles({"viewer", "rider", "carer", "installer", "admin", "robot"});

}  // namespace

std::string_view role_name(Role role) { return kRoles.name(role); }

std::optional<Role> role(std::string_view name) { return kRoles.find(name); }

}  // namespace homeward::wire
