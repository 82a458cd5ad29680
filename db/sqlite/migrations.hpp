// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

namespace homeward::db {

/// The texts of db/migrations/, in the order of their numbers. Entry i takes a database from version i to i + 1.
std::span<const std::string_view> migrations();

}  // namespace homeward::db
