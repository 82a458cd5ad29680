// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace homeward {

/// The version of the programs, "1.2.3", as the project's CMakeLists.txt says it.
std::string_view project_version();

/// What a program calls itself in messages and recordings: "homeward-server/1.2.3".
std::string name_with_version(std::string_view program);

}  // namespace homeward
