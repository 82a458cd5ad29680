// SPDX-License-Identifier: Apache-2.0
#include "server/auth/passwords.hpp"

#include <sodium.h>

#include <array>
#include <stdexcept>

#include "db/secrets.hpp"

namespace homeward::server {
namespace {

void start_sodium() {
  static const bool started = sodium_init() >= 0;
  if (!started) throw std::runtime_error("libsodium finds no source of random numbers");
}

}  // namespace

std::string hash_of_password(const std::string& password) {
  start_sodium();
  std::array<char, crypto_pwhash_STRBYTES> hash{};
  if (crypto_pwhash_str(hash.data(), password.data(), password.size(), crypto_pwhash_OPSLIMIT_INTERACTIVE,
                        crypto_pwhash_MEMLIMIT_INTERACTIVE) != 0) {
    throw std::runtime_error("not enough memory to hash a password");
  }
  return {hash.data()};
}

bool password_matches(const std::string& hash, const std::string& password) {
  start_sodium();
  return crypto_pwhash_str_verify(hash.c_str(), password.data(), password.size()) == 0;
}

const std::string& hash_of_nobody() {
  static const std::string hash = hash_of_password(db::random_secret());
  return hash;
}

}  // namespace homeward::server
