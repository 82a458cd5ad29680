// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "db/secrets.hpp"
#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/sqlite_store.hpp"
#include "wire/error_table.hpp"
#include "wire/reason_json.hpp"

namespace homeward::db {
namespace {

constexpr TimeUs kAnswersKeptUs = 24LL * 3600 * 1'000'000;

template <class Name>
std::vector<Name> ids_of(const std::string& list) {
  std::vector<Name> ids;
  for (const auto& id : nlohmann::json::parse(list)) ids.emplace_back(id.get<std::string>());
  return ids;
}

template <class Name>
std::string ids_text(const std::vector<Name>& ids) {
  nlohmann::json list = nlohmann::json::array();
  for (const Name& id : ids) list.push_back(id.str());
  return list.dump();
}

std::vector<wire::Reason> notes_of(const std::string& list) {
  std::vector<wire::Reason> notes;
  for (const auto& note : nlohmann::json::parse(list)) notes.push_back(wire::reason_from_text(note.dump()));
  return notes;
}

wire::JobView job_of(SQLite::Statement& row) {
  wire::JobView job;
  job.id = JobId(text(row, 0));
  const std::optional<wire::JobKind> kind = wire::kJobKindNames.find(text(row, 1));
  if (!kind) refuse(ErrorCode::kCorruptFile, "The database holds a job of an unknown kind.", "jobs/" + job.id.str());
  job.kind = *kind;
  job.map = MapId(text(row, 2));
  const std::optional<wire::JobState> state = wire::job_state(text(row, 3));
  if (!state) refuse(ErrorCode::kCorruptFile, "The database holds an unknown state.", "jobs/" + job.id.str());
  job.state = *state;
  job.stage = text(row, 4);
  job.share = real(row, 5);
  if (const auto code = optional_text(row, 6)) {
    const wire::ErrorRow* known = wire::error_row(*code);
    job.error = Error{known != nullptr ? known->code : ErrorCode::kInternal, text(row, 7), text(row, 8)};
  }
  job.created_us = integer(row, 9);
  job.skipped = integer(row, 10);
  job.notes = notes_of(text(row, 11));
  job.gained = integer(row, 12);
  job.taken = integer(row, 13) != 0;
  job.tours = ids_of<TourId>(text(row, 14));
  job.drives = ids_of<MissionId>(text(row, 15));
  job.draft = wire::DraftId(text(row, 16));
  return job;
}

std::vector<wire::JobView> jobs_of(SQLite::Statement row) {
  std::vector<wire::JobView> found;
  while (row.executeStep()) found.push_back(job_of(row));
  return found;
}

struct ErrorColumns {
  std::optional<std::string> code;
  std::optional<std::string> message;
  std::optional<std::string> where;
};

ErrorColumns error_columns(const wire::JobView& job) {
  if (!job.error) return {};
  return {std::string(wire::error_name(job.error->code)), job.error->message, job.error->where};
}

std::string notes_text(const wire::JobView& job) { return wire::reasons_to_json(job.notes).dump(); }

}  // namespace

Result<wire::JobView> SqliteStore::add_job(wire::JobView job) {
  return database_.work([&](SQLite::Database& database) {
    if (!prepared(database, "SELECT id FROM maps WHERE id = ?", job.map).executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + job.map.str());
    }
    if (job.id.empty()) job.id = JobId(random_id());
    const ErrorColumns error = error_columns(job);
    execute(database, "INSERT INTO jobs VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?, ?)", job.id,
            std::string(wire::kJobKindNames.name(job.kind)), job.map, std::string(wire::job_state_name(job.state)),
            job.stage, job.share, error.code, error.message, error.where, job.created_us, job.skipped, notes_text(job),
            job.gained, job.taken, ids_text(job.tours), ids_text(job.drives), job.draft);
    return job;
  });
}

void SqliteStore::write_job(SQLite::Database& database, const wire::JobView& job) {
  const ErrorColumns error = error_columns(job);
  if (execute(database,
              "UPDATE jobs SET state = ?, stage = ?, share = ?, error_code = ?, error_message = ?, error_where = ?, "
              "skipped = ?, notes = ?, gained = ?, taken = ?, drives = ? WHERE id = ?",
              std::string(wire::job_state_name(job.state)), job.stage, job.share, error.code, error.message,
              error.where, job.skipped, notes_text(job), job.gained, job.taken, ids_text(job.drives), job.id) == 0) {
    refuse(ErrorCode::kNotFound, "There is no job with this id.", "jobs/" + job.id.str());
  }
}

Status SqliteStore::update_job(const wire::JobView& job) {
  return database_.work([&](SQLite::Database& database) { write_job(database, job); });
}

Result<std::vector<wire::JobView>> SqliteStore::jobs() {
  return database_.read([&](SQLite::Database& database) {
    return jobs_of(prepared(database, "SELECT * FROM jobs ORDER BY created_us, rowid"));
  });
}

Result<std::vector<wire::JobView>> SqliteStore::unfinished_jobs() {
  return database_.read([&](SQLite::Database& database) {
    return jobs_of(
        prepared(database, "SELECT * FROM jobs WHERE state IN ('queued', 'running') ORDER BY created_us, rowid"));
  });
}

Result<wire::JobView> SqliteStore::job(const JobId& id) {
  return database_.read([&](SQLite::Database& database) {
    SQLite::Statement row = prepared(database, "SELECT * FROM jobs WHERE id = ?", id);
    if (!row.executeStep()) refuse(ErrorCode::kNotFound, "There is no job with this id.", "jobs/" + id.str());
    return job_of(row);
  });
}

Result<std::optional<StoredAnswer>> SqliteStore::answer(const RequestKey& key, TimeUs now_us) {
  return database_.read([&](SQLite::Database& database) -> std::optional<StoredAnswer> {
    SQLite::Statement row = prepared(
        database,
        "SELECT status, body, body_hash FROM answers WHERE caller = ? AND route = ? AND key = ? AND created_us > ?",
        key.caller, key.route, key.key, now_us - kAnswersKeptUs);
    if (!row.executeStep()) return std::nullopt;
    return StoredAnswer{static_cast<int>(integer(row, 0)), text(row, 1), text(row, 2)};
  });
}

Status SqliteStore::keep_answer(const RequestKey& key, const StoredAnswer& answer, TimeUs now_us) {
  return database_.work([&](SQLite::Database& database) {
    execute(database, "DELETE FROM answers WHERE created_us <= ?", now_us - kAnswersKeptUs);
    execute(database,
            "INSERT OR IGNORE INTO answers (caller, route, key, status, body, created_us, body_hash) "
            "VALUES (?, ?, ?, ?, CAST(? AS BLOB), ?, ?)",
            key.caller, key.route, key.key, answer.status, answer.body, now_us, answer.request_hash);
  });
}

}  // namespace homeward::db
