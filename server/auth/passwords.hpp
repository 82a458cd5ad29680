// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace homeward::server {

/// Argon2id with libsodium's interactive limits: about 0.1 s and 64 MiB each. Throws std::runtime_error when there is
/// not enough memory.
std::string hash_of_password(const std::string& password);
bool password_matches(const std::string& hash, const std::string& password);
/// A hash that no password matches, for names that do not exist: checking it takes as long as a real one.
const std::string& hash_of_nobody();

}  // namespace homeward::server
