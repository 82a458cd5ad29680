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

/// A new token, and its secret to be shown once.
struct NewToken {
  std::string id;
  std::string secret;
};

/// Knows who asks. All secrets are kept in memory, by their hashes, so that a stop waits neither for the store nor for
/// whoever uses it; what is added and taken back goes to the store first. Callable from any thread.
class Authenticator {
 public:
  Authenticator(db::Store& store, const Clock& clock) : store_(store), clock_(clock) {}

  /// Reads the secrets that hold, before the first request. Errors: those of the store.
  Status load();
  /// The caller of a request; nothing when it brings no secret or the cookie of an old session. Does not wait.
  /// Errors: kUnauthenticated (a token that is not known).
  [[nodiscard]] Result<std::optional<Caller>> identify(const Request& request) const;

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
  /// A session of a user who has shown who he is. Errors: kUnauthenticated (removed, or another password, meanwhile).
  Result<SignedIn> begin_session(db::User user);
  /// Errors: kNotFound, kForbidden (another one), kRateLimited.
  Status check_password(const UserId& id, const std::string& password, const std::string& remote);
  /// Ends the sessions of the user. Errors: kNotFound, kInvalidInput.
  Result<db::User> set_password(const UserId& id, const std::string& password);
  /// Holds at once, for open sessions too. Errors: kNotFound, kConflict (the last admin).
  Status set_role(const UserId& id, wire::Role role);
  /// With the sessions. Errors: kNotFound, kConflict (the last admin).
  Status remove_user(const UserId& id);
  /// `robot`: that the token speaks for, of role robot. Errors: those of the store.
  Result<NewToken> add_token(const std::string& name, wire::Role role, const std::optional<RobotId>& robot);
  /// Errors: kNotFound.
  Status revoke_token(const std::string& id);
  /// What speaks for a robot that the store no longer has.
  void forget_tokens_of(const RobotId& robot);

 private:
  /// Who holds a secret, and until when.
  struct Holder {
    Caller caller;
    std::optional<TimeUs> until_us;
  };
  using Holders = std::map<std::string, Holder>;  // by the hash of the secret

  void end_sessions(const UserId& user);
  [[nodiscard]] std::optional<Caller> holder(const Holders& among, const std::string& secret) const;

  db::Store& store_;
  const Clock& clock_;
  FailureCounter failures_;                                           // by address and name
  FailureCounter failures_of_address_{20, std::chrono::seconds(60)};  // whoever it tries to be
  std::mutex accounts_mutex_;  // who may change what a person may do, one at a time; taken before mutex_
  mutable std::mutex mutex_;   // of sessions_ and tokens_
  Holders sessions_;
  Holders tokens_;
};

/// What a name and a password must be like. Errors: kInvalidInput.
Status check_new_account(const std::string& name, const std::string& password);

}  // namespace homeward::server
