// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "db/store.hpp"
#include "server/time/clock.hpp"

namespace homeward::server {

/// A new token, and its secret to be shown once.
struct NewToken {
  std::string id;
  std::string secret;
};
/// Adds a token to the store; `robot`: that it speaks for, of role robot. Errors: those of the store.
Result<NewToken> make_token(db::Store& store, const Clock& clock, const std::string& name, wire::Role role,
                            const std::optional<RobotId>& robot);

}  // namespace homeward::server
