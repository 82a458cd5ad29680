// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>

#include "db/secrets.hpp"
#include "db/sqlite/sqlite_store.hpp"
#include "wire/edit_json.hpp"

namespace homeward::db {
namespace {

constexpr const char* kDraftColumns =
    "id, map, name, author, created_us, version, edits, check_job, check_version, check_result IS NOT NULL";

std::string edits_text(const std::vector<map::Edit>& edits) {
  nlohmann::json list = nlohmann::json::array();
  for (const map::Edit& edit : edits) list.push_back(wire::logged_edit_to_json(edit));
  return list.dump();
}

std::vector<map::Edit> edits_of(const std::string& text, const wire::DraftId& id) {
  std::vector<map::Edit> edits;
  for (const nlohmann::json& value : nlohmann::json::parse(text)) {
    const auto edit = wire::logged_edit_from_json(value, "edits");
    if (!edit) refuse(ErrorCode::kCorruptFile, "The edits of a draft cannot be read.", "drafts/" + id.str());
    edits.push_back(*edit);
  }
  return edits;
}

DraftRecord draft_of(SQLite::Statement& row) {
  DraftRecord draft;
  draft.id = wire::DraftId(text(row, 0));
  draft.map = MapId(text(row, 1));
  draft.name = text(row, 2);
  draft.author = text(row, 3);
  draft.created_us = integer(row, 4);
  draft.version = integer(row, 5);
  draft.edits = edits_of(text(row, 6), draft.id);
  const auto job = optional_text(row, 7);
  if (job) draft.check = wire::DraftCheck{JobId(*job), integer(row, 8)};
  draft.checked = integer(row, 9) != 0;
  return draft;
}

[[noreturn]] void no_draft(const wire::DraftId& id) {
  refuse(ErrorCode::kNotFound, "There is no such draft; it may have been published or discarded.",
         "drafts/" + id.str());
}

DraftRecord found_draft(SQLite::Database& database, const wire::DraftId& id) {
  const std::string sql = std::string("SELECT ") + kDraftColumns + " FROM drafts WHERE id = ?";
  SQLite::Statement row = prepared(database, sql.c_str(), id);
  if (!row.executeStep()) no_draft(id);
  return draft_of(row);
}

}  // namespace

Result<DraftRecord> SqliteStore::add_draft(DraftRecord draft) {
  return database_.work([&](SQLite::Database& database) {
    if (!prepared(database, "SELECT id FROM maps WHERE id = ?", draft.map).executeStep()) {
      refuse(ErrorCode::kNotFound, "There is no map with this id.", "maps/" + draft.map.str());
    }
    if (draft.id.empty()) draft.id = wire::DraftId(random_id());
    execute(database,
            "INSERT INTO drafts (id, map, name, author, created_us, version, edits) VALUES (?, ?, ?, ?, ?, ?, ?)",
            draft.id, draft.map, draft.name, draft.author, draft.created_us, draft.version, edits_text(draft.edits));
    return draft;
  });
}

Result<std::vector<DraftRecord>> SqliteStore::drafts(const MapId& map) {
  return database_.read([&](SQLite::Database& database) {
    const std::string sql =
        std::string("SELECT ") + kDraftColumns + " FROM drafts WHERE map = ? ORDER BY created_us, rowid";
    SQLite::Statement row = prepared(database, sql.c_str(), map);
    std::vector<DraftRecord> found;
    while (row.executeStep()) found.push_back(draft_of(row));
    return found;
  });
}

Result<DraftRecord> SqliteStore::draft(const MapId& map, const wire::DraftId& id) {
  return database_.read([&](SQLite::Database& database) {
    DraftRecord draft = found_draft(database, id);
    if (draft.map != map) no_draft(id);
    return draft;
  });
}

Result<DraftRecord> SqliteStore::save_draft_edits(const wire::DraftId& id, const std::vector<map::Edit>& edits,
                                                  std::int64_t expected_version) {
  return database_.work([&](SQLite::Database& database) {
    DraftRecord draft = found_draft(database, id);
    if (draft.version != expected_version) {
      refuse(ErrorCode::kStaleRevision,
             "The draft is at version " + std::to_string(draft.version) + ", the change was made against " +
                 std::to_string(expected_version) + ".",
             "drafts/" + id.str());
    }
    draft.edits = edits;
    ++draft.version;
    execute(database, "UPDATE drafts SET edits = ?, version = ? WHERE id = ?", edits_text(edits), draft.version, id);
    return draft;
  });
}

Status SqliteStore::set_draft_check(const wire::DraftId& id, const wire::DraftCheck& check) {
  return database_.work([&](SQLite::Database& database) {
    if (execute(database, "UPDATE drafts SET check_job = ?, check_version = ? WHERE id = ?", check.job, check.version,
                id) == 0) {
      no_draft(id);
    }
  });
}

Status SqliteStore::keep_draft_findings(const wire::DraftId& id, const JobId& job, const std::string& findings) {
  return database_.work([&](SQLite::Database& database) {
    execute(database, "UPDATE drafts SET check_result = ? WHERE id = ? AND check_job = ?", findings, id, job);
  });
}

Result<std::optional<std::string>> SqliteStore::draft_findings(const wire::DraftId& id) {
  return database_.read([&](SQLite::Database& database) {
    SQLite::Statement row = prepared(database, "SELECT check_result FROM drafts WHERE id = ?", id);
    if (!row.executeStep()) no_draft(id);
    return optional_text(row, 0);
  });
}

Status SqliteStore::remove_draft(const wire::DraftId& id) {
  return database_.work([&](SQLite::Database& database) {
    if (execute(database, "DELETE FROM drafts WHERE id = ?", id) == 0) no_draft(id);
  });
}

}  // namespace homeward::db
