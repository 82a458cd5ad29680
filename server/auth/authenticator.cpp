// SPDX-License-Identifier: Apache-2.0
#include "server/auth/authenticator.hpp"

#include "db/secrets.hpp"
#include "server/auth/passwords.hpp"

namespace homeward::server {
namespace {

constexpr std::chrono::seconds kRememberFor{20};
constexpr TimeUs kSessionUs = 30LL * 24 * 3600 * 1'000'000;
constexpr std::size_t kMostRemembered = 1000;

struct Secret {
  std::string text;
  bool by_cookie = false;
};

std::optional<Secret> secret_of(const Request& request) {
  const std::string authorization = request.header("authorization");
  if (authorization.size() > 7 && (authorization.starts_with("Bearer ") || authorization.starts_with("bearer "))) {
    return Secret{authorization.substr(7), false};
  }
  const std::string cookie = cookie_value(request.header("cookie"), kSessionCookie);
  if (!cookie.empty()) return Secret{cookie, true};
  return std::nullopt;
}

// A cookie's secret and a token's are different things even when they were equal.
std::string key_of(const Secret& secret) { return (secret.by_cookie ? "c" : "b") + db::secret_hash(secret.text); }

std::string failure_key(std::string name, const std::string& remote) {
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return remote + "\n" + name.substr(0, 200);
}

tl::unexpected<Error> wait_first(int seconds) {
  return fail(ErrorCode::kRateLimited, "Too many failed tries. Wait " + std::to_string(seconds) + " seconds.", "login");
}

}  // namespace

Status check_new_account(const std::string& name, const std::string& password) {
  if (name.empty() || name.size() > 200) {
    return fail(ErrorCode::kInvalidInput, "A name has 1 to 200 bytes.", "name");
  }
  if (password.size() < 8 || password.size() > 1000) {
    return fail(ErrorCode::kInvalidInput, "A password has at least 8 characters and at most 1000.", "password");
  }
  return {};
}

std::optional<Caller> Authenticator::identify_at_once(const Request& request) {
  const auto secret = secret_of(request);
  if (!secret) return std::nullopt;
  const std::scoped_lock lock(mutex_);
  const auto found = remembered_.find(key_of(*secret));
  if (found == remembered_.end() || found->second.until < clock_.steady()) return std::nullopt;
  return found->second.caller;
}

Result<std::optional<Caller>> Authenticator::identify(const Request& request) {
  const auto secret = secret_of(request);
  if (!secret) return std::optional<Caller>();
  if (auto caller = identify_at_once(request)) return caller;
  Caller caller;
  caller.by_cookie = secret->by_cookie;
  const std::string hash = db::secret_hash(secret->text);
  if (secret->by_cookie) {
    const auto session = store_.session_by_hash(hash, clock_.wall_us());
    if (!session) return pass_on(session);
    // A browser with an old cookie is a stranger, not an attacker: it must still be able to sign in.
    if (!*session) return std::optional<Caller>();
    const auto user = store_.user((*session)->user);
    if (!user) return pass_on(user);
    if (!*user) return std::optional<Caller>();
    caller.id = (*user)->id.str();
    caller.name = (*user)->name;
    caller.role = (*user)->role;
  } else {
    const auto token = store_.token_by_hash(hash, clock_.wall_us());
    if (!token) return pass_on(token);
    if (!*token)
      return fail(ErrorCode::kUnauthenticated, "This token is not known, or it was revoked.", "Authorization");
    caller.id = (*token)->id;
    caller.name = (*token)->name;
    caller.role = (*token)->role;
    if ((*token)->robot) caller.robot = (*token)->robot->str();
  }
  const std::scoped_lock lock(mutex_);
  if (remembered_.size() >= kMostRemembered) remembered_.clear();
  remembered_[key_of(*secret)] = {caller, clock_.steady() + kRememberFor};
  return std::optional<Caller>(caller);
}

int Authenticator::seconds_to_wait(const std::string& name, const std::string& remote) {
  return failures_.seconds_to_wait(failure_key(name, remote), clock_.steady());
}

Result<Authenticator::SignedIn> Authenticator::log_in(const std::string& name, const std::string& password,
                                                      const std::string& remote) {
  if (const int wait = seconds_to_wait(name, remote); wait > 0) return wait_first(wait);
  const auto user = store_.user_by_name(name);
  if (!user) return pass_on(user);
  const bool right = password_matches(*user ? (*user)->password_hash : hash_of_nobody(), password);
  const std::string key = failure_key(name, remote);
  if (!*user || !right) {
    failures_.failed(key, clock_.steady());
    return fail(ErrorCode::kUnauthenticated, "The name or the password is wrong.", "login");
  }
  failures_.succeeded(key);
  return begin_session(**user);
}

Result<Authenticator::SignedIn> Authenticator::set_up(const std::string& token, const std::string& name,
                                                      const std::string& password, const std::string& remote) {
  const std::string key = failure_key("set-up", remote);
  if (const int wait = failures_.seconds_to_wait(key, clock_.steady()); wait > 0) return wait_first(wait);
  if (const Status status = check_new_account(name, password); !status) return pass_on(status);
  db::User admin;
  admin.name = name;
  admin.role = wire::Role::kAdmin;
  admin.password_hash = hash_of_password(password);
  admin.created_us = clock_.wall_us();
  const auto user = store_.finish_setup(db::secret_hash(token), admin);
  if (!user) {
    if (user.error().code == ErrorCode::kForbidden) failures_.failed(key, clock_.steady());
    return pass_on(user);
  }
  failures_.succeeded(key);
  return begin_session(*user);
}

Result<Authenticator::SignedIn> Authenticator::begin_session(db::User user) {
  SignedIn result{std::move(user), db::random_secret()};
  db::Session session;
  session.hash = db::secret_hash(result.secret);
  session.user = result.user.id;
  session.created_us = clock_.wall_us();
  session.expires_us = session.created_us + kSessionUs;
  if (const auto added = store_.add_session(session); !added) return pass_on(added);
  return result;
}

Status Authenticator::log_out(const Request& request) {
  const auto secret = secret_of(request);
  forget();
  if (!secret || !secret->by_cookie) return {};
  const Status status = store_.remove_session(db::secret_hash(secret->text));
  forget();
  return status;
}

void Authenticator::forget() {
  const std::scoped_lock lock(mutex_);
  remembered_.clear();
}

}  // namespace homeward::server
