// SPDX-License-Identifier: Apache-2.0
#include "server/auth/secrets.hpp"

#include <sodium.h>

#include <array>
#include <stdexcept>
#include <vector>

namespace homeward::server {
namespace {

std::string hexadecimal(const unsigned char* bytes, std::size_t count) {
  std::vector<char> text(count * 2 + 1);
  sodium_bin2hex(text.data(), text.size(), bytes, count);
  return {text.data(), count * 2};
}

}  // namespace

void start_secrets() {
  if (sodium_init() < 0) throw std::runtime_error("libsodium cannot find a source of random numbers");
}

std::string random_secret() {
  std::array<unsigned char, 32> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  std::array<char, 64> text{};
  sodium_bin2base64(text.data(), text.size(), bytes.data(), bytes.size(), sodium_base64_VARIANT_URLSAFE_NO_PADDING);
  return {text.data()};
}

std::string random_id(const std::string& prefix) {
  std::array<unsigned char, 8> bytes{};
  randombytes_buf(bytes.data(), bytes.size());
  return prefix + hexadecimal(bytes.data(), bytes.size());
}

std::string hash_of_bytes(const std::string& bytes) {
  std::array<unsigned char, crypto_generichash_BYTES> hash{};
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
                     nullptr, 0);
  return hexadecimal(hash.data(), hash.size());
}

std::string hash_of_secret(const std::string& secret) { return hash_of_bytes("homeward secret:" + secret); }

bool equal_in_constant_time(const std::string& a, const std::string& b) {
  return a.size() == b.size() && sodium_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::string hash_of_password(const std::string& password) {
  std::array<char, crypto_pwhash_STRBYTES> hash{};
  if (crypto_pwhash_str(hash.data(), password.data(), password.size(), crypto_pwhash_OPSLIMIT_INTERACTIVE,
                        crypto_pwhash_MEMLIMIT_INTERACTIVE) != 0) {
    throw std::runtime_error("not enough memory to hash a password");
  }
  return {hash.data()};
}

bool password_matches(const std::string& hash, const std::string& password) {
  return crypto_pwhash_str_verify(hash.c_str(), password.data(), password.size()) == 0;
}

const std::string& hash_of_nobody() {
  static const std::string hash = hash_of_password(random_secret());
  return hash;
}

}  // namespace homeward::server
