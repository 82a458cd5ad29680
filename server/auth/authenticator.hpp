// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "db/store.hpp"
#include "server/auth/failure_counter.hpp"
#include "server/http/message.hpp"
#include "server/time/clock.hpp"

namespace homeward::server {

inline constexpr std::string_view kSessionCookie = "homeward_session";

/// Knows who asks. Secrets are looked up by their hash; what was found is remembered for a few seconds, so that a stop
/// need not wait for the disk.
class Authenticator {
 public:
  Authenticator(db::Store& store, const Clock& clock) : store_(store), clock_(clock) {}

  /// The caller of a request; nothing when it brings no secret. Errors: kUnauthenticated (a wrong or old secret).
  Result<std::optional<Caller>> identify(const Request& request);
  /// The same from memory alone, without waiting; nothing when it has to be looked up.
  std::optional<Caller> identify_at_once(const Request& request);

  struct SignedIn {
    db::User user;
    std::string secret;  // for the cookie
  };
  /// Takes as long for a name that does not exist. Errors: kUnauthenticated, kRateLimited.
  Result<SignedIn> log_in(const std::string& name, const std::string& password, const std::string& remote);
  /// Seconds that a refused login has to wait.
  int seconds_to_wait(const std::string& name, const std::string& remote);
  /// Errors: kForbidden (wrong or used token), kInvalidInput, kRateLimited.
  Result<SignedIn> set_up(const std::string& token, const std::string& name, const std::string& password,
                          const std::string& remote);
  Status log_out(const Request& request);
  /// Forgets what is remembered, after a token was revoked or a person changed.
  void forget();

 private:
  Result<SignedIn> begin_session(db::User user);

  struct Remembered {
    Caller caller;
    SteadyTime until;
  };
  db::Store& store_;
  const Clock& clock_;
  FailureCounter failures_;
  std::mutex mutex_;
  std::map<std::string, Remembered> remembered_;  // by the hash of the secret
};

/// What a name and a password must be like. Errors: kInvalidInput.
Status check_new_account(const std::string& name, const std::string& password);

}  // namespace homeward::server
