// SPDX-License-Identifier: Apache-2.0
#include "db/secrets.hpp"
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

wire::Role stored_role(const std::string& name) {
  const std::optional<wire::Role> value = wire::role(name);
  if (!value) refuse(ErrorCode::kCorruptFile, "The database holds the unknown role '" + name + "'.");
  return *value;
}

constexpr const char* kUserByName =
    "SELECT id, name, role, password_hash, created_us FROM users WHERE name = ? COLLATE NOCASE";
constexpr const char* kUserById = "SELECT id, name, role, password_hash, created_us FROM users WHERE id = ?";

User user_of(SQLite::Statement& row) {
  return {UserId(text(row, 0)), text(row, 1), stored_role(text(row, 2)), text(row, 3), integer(row, 4)};
}

std::optional<User> find_user(SQLite::Database& database, const char* sql, const std::string& value) {
  SQLite::Statement row = prepared(database, sql, value);
  return row.executeStep() ? std::optional(user_of(row)) : std::nullopt;
}

User insert_user(SQLite::Database& database, User user) {
  if (user.id.empty()) user.id = UserId(random_id());
  if (find_user(database, kUserByName, user.name)) {
    refuse(ErrorCode::kConflict, "There is already a person called '" + user.name + "'.", "name");
  }
  execute(database, "INSERT INTO users (id, name, role, password_hash, created_us) VALUES (?, ?, ?, ?, ?)", user.id,
          user.name, std::string(wire::role_name(user.role)), user.password_hash, user.created_us);
  return user;
}

Token token_of(SQLite::Statement& row) {
  Token token;
  token.id = text(row, 0);
  token.name = text(row, 1);
  token.hash = text(row, 2);
  token.role = stored_role(text(row, 3));
  if (const auto robot = optional_text(row, 4)) token.robot = RobotId(*robot);
  token.created_us = integer(row, 5);
  token.expires_us = optional_integer(row, 6);
  return token;
}

[[noreturn]] void no_such_user(const UserId& id) {
  refuse(ErrorCode::kNotFound, "There is no person with this id.", "users/" + id.str());
}

/// A server without an admin could never be changed again.
void keep_an_admin(SQLite::Database& database) {
  SQLite::Statement row = prepared(database, "SELECT count(*) FROM users WHERE role = 'admin'");
  row.executeStep();
  if (integer(row, 0) == 0) refuse(ErrorCode::kConflict, "The last admin cannot go.", "users");
}

}  // namespace

Result<User> SqliteStore::add_user(User user) {
  return database_.work([&](SQLite::Database& database) { return insert_user(database, user); });
}

Result<std::vector<User>> SqliteStore::users() {
  return database_.read([&](SQLite::Database& database) {
    std::vector<User> found;
    SQLite::Statement row =
        prepared(database, "SELECT id, name, role, password_hash, created_us FROM users ORDER BY name");
    while (row.executeStep()) found.push_back(user_of(row));
    return found;
  });
}

Result<std::optional<User>> SqliteStore::user_by_name(const std::string& name) {
  return database_.read([&](SQLite::Database& database) { return find_user(database, kUserByName, name); });
}

Result<std::optional<User>> SqliteStore::user(const UserId& id) {
  return database_.read([&](SQLite::Database& database) { return find_user(database, kUserById, id.str()); });
}

Status SqliteStore::set_password_hash(const UserId& id, const std::string& password_hash) {
  return database_.work([&](SQLite::Database& database) {
    if (execute(database, "UPDATE users SET password_hash = ? WHERE id = ?", password_hash, id) == 0) no_such_user(id);
    execute(database, "DELETE FROM sessions WHERE user = ?", id);
  });
}

Status SqliteStore::set_role(const UserId& id, wire::Role role) {
  return database_.work([&](SQLite::Database& database) {
    const std::optional<User> before = find_user(database, kUserById, id.str());
    if (!before) no_such_user(id);
    execute(database, "UPDATE users SET role = ? WHERE id = ?", std::string(wire::role_name(role)), id);
    if (before->role == wire::Role::kAdmin) keep_an_admin(database);
  });
}

Status SqliteStore::remove_user(const UserId& id) {
  return database_.work([&](SQLite::Database& database) {
    const std::optional<User> before = find_user(database, kUserById, id.str());
    if (!before) no_such_user(id);
    execute(database, "DELETE FROM users WHERE id = ?", id);
    if (before->role == wire::Role::kAdmin) keep_an_admin(database);
  });
}

Result<Session> SqliteStore::add_session(Session session) {
  return database_.work([&](SQLite::Database& database) {
    if (!find_user(database, kUserById, session.user.str())) no_such_user(session.user);
    execute(database, "DELETE FROM sessions WHERE expires_us <= ?", session.created_us);
    execute(database, "INSERT INTO sessions (hash, user, created_us, expires_us) VALUES (?, ?, ?, ?)", session.hash,
            session.user, session.created_us, session.expires_us);
    return session;
  });
}

Result<std::vector<Session>> SqliteStore::sessions() {
  return database_.read([&](SQLite::Database& database) {
    std::vector<Session> found;
    SQLite::Statement row =
        prepared(database, "SELECT hash, user, created_us, expires_us FROM sessions ORDER BY rowid");
    while (row.executeStep()) found.push_back({text(row, 0), UserId(text(row, 1)), integer(row, 2), integer(row, 3)});
    return found;
  });
}

Status SqliteStore::remove_session(const std::string& hash) {
  return database_.work(
      [&](SQLite::Database& database) { execute(database, "DELETE FROM sessions WHERE hash = ?", hash); });
}

Result<Token> SqliteStore::add_token(Token token) {
  return database_.work([&](SQLite::Database& database) {
    if (token.id.empty()) token.id = random_id();
    execute(database,
            "INSERT INTO tokens (id, name, hash, role, robot, created_us, expires_us) VALUES (?, ?, ?, ?, ?, ?, ?)",
            token.id, token.name, token.hash, std::string(wire::role_name(token.role)), token.robot, token.created_us,
            token.expires_us);
    return token;
  });
}

Result<std::vector<Token>> SqliteStore::tokens() {
  return database_.read([&](SQLite::Database& database) {
    std::vector<Token> found;
    SQLite::Statement row = prepared(
        database, "SELECT id, name, hash, role, robot, created_us, expires_us FROM tokens ORDER BY created_us, rowid");
    while (row.executeStep()) found.push_back(token_of(row));
    return found;
  });
}

Status SqliteStore::revoke_token(const std::string& id) {
  return database_.work([&](SQLite::Database& database) {
    if (execute(database, "DELETE FROM tokens WHERE id = ?", id) == 0) {
      refuse(ErrorCode::kNotFound, "There is no token with this id.", "tokens/" + id);
    }
  });
}

Status SqliteStore::set_setup_hash(const std::string& hash) {
  return database_.work([&](SQLite::Database& database) {
    execute(database, "INSERT OR REPLACE INTO settings (key, value) VALUES ('setup_hash', ?)", hash);
  });
}

Result<std::optional<std::string>> SqliteStore::setup_hash() {
  return database_.read([&](SQLite::Database& database) -> std::optional<std::string> {
    SQLite::Statement row = prepared(database, "SELECT value FROM settings WHERE key = 'setup_hash'");
    return row.executeStep() ? std::optional(text(row, 0)) : std::nullopt;
  });
}

Result<User> SqliteStore::finish_setup(const std::string& hash, User admin) {
  return database_.work([&](SQLite::Database& database) {
    if (execute(database, "DELETE FROM settings WHERE key = 'setup_hash' AND value = ?", hash) == 0) {
      refuse(ErrorCode::kForbidden, "This set-up link is not valid, or was used before.", "token");
    }
    admin.role = wire::Role::kAdmin;
    return insert_user(database, admin);
  });
}

}  // namespace homeward::db
