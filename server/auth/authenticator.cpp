// SPDX-License-Identifier: Apache-2.0
#include "server/auth/authenticator.hpp"

#include <algorithm>

#include "db/secrets.hpp"
#include "server/auth/passwords.hpp"

namespace homeward::server {
namespace {

constexpr TimeUs kSessionUs = 30LL * 24 * 3600 * 1'000'000;

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

Caller caller_of(const db::Token& token) {
  Caller caller;
  caller.id = token.id;
  caller.name = token.name;
  caller.role = token.role;
  if (token.robot) caller.robot = token.robot->str();
  return caller;
}

Caller caller_of(const db::User& user) {
  Caller caller;
  caller.id = user.id.str();
  caller.name = user.name;
  caller.role = user.role;
  caller.by_cookie = true;
  return caller;
}

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

Status Authenticator::load() {
  const auto users = store_.users();
  if (!users) return pass_on(users);
  const auto sessions = store_.sessions();
  if (!sessions) return pass_on(sessions);
  const auto tokens = store_.tokens();
  if (!tokens) return pass_on(tokens);
  const std::scoped_lock lock(mutex_);
  std::map<UserId, const db::User*> by_id;
  for (const db::User& user : *users) by_id[user.id] = &user;
  for (const db::Session& session : *sessions) {
    const auto user = by_id.find(session.user);
    if (user != by_id.end()) sessions_[session.hash] = {caller_of(*user->second), session.expires_us};
  }
  for (const db::Token& token : *tokens) tokens_[token.hash] = {caller_of(token), token.expires_us};
  return {};
}

std::optional<Caller> Authenticator::holder(const Holders& among, const std::string& secret) const {
  const std::string hash = db::secret_hash(secret);
  const std::scoped_lock lock(mutex_);
  const auto found = among.find(hash);
  if (found == among.end()) return std::nullopt;
  const auto until_us = found->second.until_us;
  if (until_us && *until_us <= clock_.wall_us()) return std::nullopt;
  return found->second.caller;
}

Result<std::optional<Caller>> Authenticator::identify(const Request& request) const {
  const auto secret = secret_of(request);
  if (!secret) return std::optional<Caller>();
  auto caller = holder(secret->by_cookie ? sessions_ : tokens_, secret->text);
  // A browser with an old cookie is a stranger, not an attacker: it must still be able to sign in.
  if (!caller && !secret->by_cookie) {
    return fail(ErrorCode::kUnauthenticated, "This token is not known, or it was revoked.", "Authorization");
  }
  return caller;
}

int Authenticator::seconds_to_wait(const std::string& name, const std::string& remote) {
  return std::max(failures_.seconds_to_wait(failure_key(name, remote), clock_.steady()),
                  failures_of_address_.seconds_to_wait(remote, clock_.steady()));
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
    failures_of_address_.failed(remote, clock_.steady());
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
  const std::scoped_lock alone(accounts_mutex_);
  // As he is now: checking a password takes a while.
  const auto now = store_.user(user.id);
  if (!now) return pass_on(now);
  if (!*now || (*now)->password_hash != user.password_hash) {
    return fail(ErrorCode::kUnauthenticated, "The name or the password is wrong.", "login");
  }
  SignedIn result{**now, db::random_secret()};
  db::Session session;
  session.hash = db::secret_hash(result.secret);
  session.user = result.user.id;
  session.created_us = clock_.wall_us();
  session.expires_us = session.created_us + kSessionUs;
  if (const auto added = store_.add_session(session); !added) return pass_on(added);
  const std::scoped_lock lock(mutex_);
  std::erase_if(sessions_, [&](const auto& entry) { return entry.second.until_us <= session.created_us; });
  sessions_[session.hash] = {caller_of(result.user), session.expires_us};
  return result;
}

Status Authenticator::log_out(const Request& request) {
  const auto secret = secret_of(request);
  if (!secret || !secret->by_cookie) return {};
  const std::string hash = db::secret_hash(secret->text);
  if (const Status status = store_.remove_session(hash); !status) return status;
  const std::scoped_lock lock(mutex_);
  sessions_.erase(hash);
  return {};
}

void Authenticator::end_sessions(const UserId& user) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(sessions_, [&](const auto& entry) { return entry.second.caller.id == user.str(); });
}

Status Authenticator::check_password(const UserId& id, const std::string& password, const std::string& remote) {
  const auto user = store_.user(id);
  if (!user) return pass_on(user);
  if (!*user) return fail(ErrorCode::kNotFound, "There is no person with this id.", "users/" + id.str());
  const std::string& name = (*user)->name;
  if (const int wait = seconds_to_wait(name, remote); wait > 0) return wait_first(wait);
  if (password_matches((*user)->password_hash, password)) return {};
  failures_.failed(failure_key(name, remote), clock_.steady());
  failures_of_address_.failed(remote, clock_.steady());
  return fail(ErrorCode::kForbidden, "The old password is another one.", "body/old_password");
}

Result<db::User> Authenticator::set_password(const UserId& id, const std::string& password) {
  const auto user = store_.user(id);
  if (!user) return pass_on(user);
  if (!*user) return fail(ErrorCode::kNotFound, "There is no person with this id.", "users/" + id.str());
  if (const Status status = check_new_account((*user)->name, password); !status) return pass_on(status);
  db::User changed = **user;
  changed.password_hash = hash_of_password(password);
  const std::scoped_lock alone(accounts_mutex_);
  if (const Status set = store_.set_password_hash(id, changed.password_hash); !set) return pass_on(set);
  end_sessions(id);
  return changed;
}

Status Authenticator::set_role(const UserId& id, wire::Role role) {
  const std::scoped_lock alone(accounts_mutex_);
  if (const Status set = store_.set_role(id, role); !set) return set;
  const std::scoped_lock lock(mutex_);
  for (auto& [hash, holder] : sessions_) {
    if (holder.caller.id == id.str()) holder.caller.role = role;
  }
  return {};
}

Status Authenticator::remove_user(const UserId& id) {
  const std::scoped_lock alone(accounts_mutex_);
  if (const Status removed = store_.remove_user(id); !removed) return removed;
  end_sessions(id);
  return {};
}

Result<NewToken> Authenticator::add_token(const std::string& name, wire::Role role,
                                          const std::optional<RobotId>& robot) {
  const std::string secret = db::random_secret();
  db::Token token;
  token.name = name;
  token.hash = db::secret_hash(secret);
  token.role = role;
  token.robot = robot;
  token.created_us = clock_.wall_us();
  const auto added = store_.add_token(token);
  if (!added) return pass_on(added);
  const std::scoped_lock lock(mutex_);
  tokens_[added->hash] = {caller_of(*added), added->expires_us};
  return NewToken{added->id, secret};
}

Status Authenticator::revoke_token(const std::string& id) {
  if (const Status status = store_.revoke_token(id); !status) return status;
  const std::scoped_lock lock(mutex_);
  std::erase_if(tokens_, [&](const auto& entry) { return entry.second.caller.id == id; });
  return {};
}

void Authenticator::forget_tokens_of(const RobotId& robot) {
  const std::scoped_lock lock(mutex_);
  std::erase_if(tokens_, [&](const auto& entry) { return entry.second.caller.robot == robot.str(); });
}

}  // namespace homeward::server
