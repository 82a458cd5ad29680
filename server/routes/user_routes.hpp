// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "server/auth/authenticator.hpp"
#include "server/http/router.hpp"
#include "server/time/clock.hpp"

namespace homeward::server {

/// Users: adding and removing them, their roles and passwords.
void add_user_routes(Router& router, Authenticator& authenticator, db::Store& store, const Clock& clock);

/// A user as others may see him.
nlohmann::json user_to_json(const db::User& user);

/// The Set-Cookie header of a session; an empty secret ends it. A browser keeps it to TLS where that is how it came.
std::string session_cookie(const Request& request, const std::string& secret);

}  // namespace homeward::server
