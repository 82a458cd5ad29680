// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace homeward::db {

/// Random bits as url-safe text: 22 characters for the 128 bits of an id, 43 for the 256 of a secret.
std::string random_id();
std::string random_secret();

/// What is kept of a secret: BLAKE2b-256, hexadecimal. Enough for random secrets; passwords need Argon2id.
std::string secret_hash(std::string_view secret);

/// SHA-256 of a file's bytes, hexadecimal.
std::string sha256_hex(std::span<const std::uint8_t> bytes);

}  // namespace homeward::db
