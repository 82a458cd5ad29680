// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "db/store.hpp"
#include "server/auth/authenticator.hpp"
#include "server/http/router.hpp"
#include "server/time/clock.hpp"

namespace homeward::server {

/// Accounts: setup, login, logout, me, users, tokens.
void add_account_routes(Router& router, Authenticator& authenticator, db::Store& store, const Clock& clock);

}  // namespace homeward::server
