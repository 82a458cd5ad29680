// SPDX-License-Identifier: Apache-2.0
#include "db/secrets.hpp"

#include <sodium.h>

#include <array>
#include <stdexcept>

namespace homeward::db {
namespace {

void start_sodium() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium does not start");
}

template <std::size_t kBytes>
std::string random_text() {
  start_sodium();
  std::array<unsigned char, kBytes> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  std::array<char, sodium_base64_ENCODED_LEN(kBytes, sodium_base64_VARIANT_URLSAFE_NO_PADDING)> out{};
  return sodium_bin2base64(out.data(), out.size(), bytes.data(), bytes.size(),
                           sodium_base64_VARIANT_URLSAFE_NO_PADDING);
}

template <std::size_t kBytes>
std::string hexadecimal(const std::array<unsigned char, kBytes>& bytes) {
  std::array<char, 2 * kBytes + 1> out{};
  return sodium_bin2hex(out.data(), out.size(), bytes.data(), bytes.size());
}

}  // namespace

std::string random_id() { return random_text<16>(); }

std::string random_secret() { return random_text<32>(); }

std::string secret_hash(std::string_view secret) {
  start_sodium();
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  const std::string bytes(secret);
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                     nullptr, 0);
  return hexadecimal(hash);
}

std::string sha256_hex(std::span<const std::uint8_t> bytes) {
  std::array<unsigned char, crypto_hash_sha256_BYTES> hash{};
  crypto_hash_sha256(hash.data(), bytes.data(), bytes.size());
  return hexadecimal(hash);
}

}  // namespace homeward::db
