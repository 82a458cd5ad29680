// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "db/store.hpp"
#include "server/auth/authenticator.hpp"
#include "server/http/router.hpp"

namespace homeward::server {

/// setup, login, logout, me, users, tokens.
void add_account_routes(Router& router, Authenticator& authenticator, db::Store& store);

/// A new token, and its secret to be shown once.
struct NewToken {
  std::string id;
  std::string secret;
};
Result<NewToken> make_token(db::Store& store, const std::string& name, db::Role role,
                            const std::optional<RobotId>& robot);

}  // namespace homeward::server
