// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "db/store.hpp"
#include "server/auth/authenticator.hpp"
#include "server/http/router.hpp"

namespace homeward::server {

/// Accounts: setup, login, logout, me, tokens.
void add_account_routes(Router& router, Authenticator& authenticator, db::Store& store);

}  // namespace homeward::server
