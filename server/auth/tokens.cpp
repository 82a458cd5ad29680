// SPDX-License-Identifier: Apache-2.0
#include "server/auth/tokens.hpp"

#include "db/secrets.hpp"

namespace homeward::server {

Result<NewToken> make_token(db::Store& store, const Clock& clock, const std::string& name, wire::Role role,
                            const std::optional<RobotId>& robot) {
  const std::string secret = db::random_secret();
  db::Token token;
  token.name = name;
  token.hash = db::secret_hash(secret);
  token.role = role;
  token.robot = robot;
  token.created_us = clock.wall_us();
  const auto added = store.add_token(token);
  if (!added) return pass_on(added);
  return NewToken{added->id, secret};
}

}  // namespace homeward::server
