// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace homeward::server {

/// Must be called once before the others. Throws std::runtime_error when libsodium cannot start.
void start_secrets();

/// 32 random bytes as text that fits into a URL or a header.
std::string random_secret();
/// A short random id with a prefix: "t" -> "t4f8a...".
std::string random_id(const std::string& prefix);

/// What is stored of a secret: its BLAKE2b hash in hexadecimal. Enough for random secrets, not for passwords.
std::string hash_of_secret(const std::string& secret);
/// The same of any bytes, to compare contents.
std::string hash_of_bytes(const std::string& bytes);
bool equal_in_constant_time(const std::string& a, const std::string& b);

/// Argon2id with libsodium's interactive limits: about 0.1 s and 64 MiB each.
std::string hash_of_password(const std::string& password);
bool password_matches(const std::string& hash, const std::string& password);
/// A hash that no password matches, for names that do not exist: checking it takes as long as a real one.
const std::string& hash_of_nobody();

}  // namespace homeward::server
