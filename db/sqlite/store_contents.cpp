// SPDX-License-Identifier: Apache-2.0
#include <sys/statvfs.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>

#include "db/sqlite/durable_file.hpp"
#include "db/sqlite/sqlite_store.hpp"

namespace homeward::db {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMapFileEnd = ".homeward";
constexpr std::ptrdiff_t kMostLookedFor = 200;
constexpr std::size_t kMostNamed = 20;  // missing files, each by its name

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
  return entries;
}

/// What a writer that was killed has left: nobody was told that it was kept.
bool is_unfinished(const fs::path& file) { return file.extension() == ".part" || file.extension() == ".arrived"; }

/// The map and revision that the name of a map file says.
std::optional<std::pair<MapId, std::int64_t>> named_in(const fs::path& file) {
  const std::string name = file.filename().string();
  if (!name.ends_with(kMapFileEnd)) return std::nullopt;
  const std::string_view stem = std::string_view(name).substr(0, name.size() - kMapFileEnd.size());
  const std::size_t at = stem.rfind(".r");
  if (at == std::string_view::npos) return std::nullopt;
  std::int64_t revision = 0;
  const char* const end = stem.data() + stem.size();
  const auto [stop, error] = std::from_chars(stem.data() + at + 2, end, revision);
  if (error != std::errc() || stop != end) return std::nullopt;
  return std::pair(MapId(std::string(stem.substr(0, at))), revision);
}

std::string named(const fs::path& file, const fs::path& folder) { return file.lexically_relative(folder).string(); }

}  // namespace

void forget_file(const fs::path& file) {
  std::error_code ignored;
  fs::remove(file, ignored);
}

void forget_file_after(const Error& refused, const fs::path& file) {
  if (refused.code != ErrorCode::kIo) forget_file(file);
}

fs::path removed_name(const fs::path& file) { return file.string() + std::string(kRemovedEnd); }

void SqliteStore::put_aside(const fs::path& stray) {
  const fs::path wanted = folder_ / "quarantine" / stray.lexically_relative(folder_);
  std::error_code failure;  // of a full disk, or another one: then it stays where it is, and is no harm
  fs::create_directories(wanted.parent_path(), failure);
  fs::path free = wanted;
  for (int number = 2; fs::exists(fs::symlink_status(free)); ++number)
    free = wanted.string() + "~" + std::to_string(number);
  if (!failure) fs::rename(stray, free, failure);
  if (!failure) contents_.quarantined.push_back(named(free, folder_));
}

void SqliteStore::sort_map_files() {
  const auto known = database_.read([](SQLite::Database& database) {
    std::map<MapId, std::int64_t> found;
    SQLite::Statement row = prepared(database, "SELECT id, file_revision FROM maps");
    while (row.executeStep()) found[MapId(text(row, 0))] = integer(row, 1);
    return found;
  });
  if (!known) throw StoreFailure(known.error());
  const std::map<MapId, std::int64_t>& revisions = *known;
  for (const auto& [id, revision] : revisions) {
    const fs::path file = map_file(id, revision);
    if (revision > 0 && fs::exists(removed_name(file))) fs::rename(removed_name(file), file);  // the row stayed
  }
  for (const fs::path& file : entries_of(folder_ / "maps")) {
    if (is_unfinished(file) || file.extension() == kRemovedEnd) {
      forget_file(file);
      continue;
    }
    const auto name = named_in(file);
    const auto row = name ? revisions.find(name->first) : revisions.end();
    const bool is_a_maps = row != revisions.end() && row->second > 0;
    if (is_a_maps && name->second == row->second) continue;
    // One that its row has gone on from, and that a killed server had no time to clear.
    const bool outdated = is_a_maps && name->second < row->second && fs::exists(map_file(row->first, row->second));
    outdated ? forget_file(file) : put_aside(file);
  }
  for (const auto& [id, revision] : revisions) {
    if (revision > 0 && !fs::is_regular_file(map_file(id, revision)))
      contents_.missing.push_back(map_file(id, revision));
  }
}

void SqliteStore::sort_pictures() {
  const Result<std::vector<Tour>> known = tours();
  if (!known) throw StoreFailure(known.error());
  std::set<fs::path> folders;
  for (const Tour& tour : *known) {
    const fs::path folder = folder_ / "tours" / tour.id.str();
    folders.insert(folder);
    if (fs::exists(removed_name(folder))) fs::rename(removed_name(folder), folder);  // the row stayed
    make_folder_durably(folder);
    const Result<std::vector<TourImage>> images = tour_images(tour.id);
    if (!images) throw StoreFailure(images.error());
    std::set<fs::path> there;
    for (const fs::path& file : entries_of(folder)) there.insert(file);
    for (const TourImage& image : *images) {
      const fs::path file = image_file(tour.id, image.number, image.type);
      if (there.erase(file) == 0) contents_.missing.push_back(file);
    }
    for (const fs::path& stray : there) is_unfinished(stray) ? forget_file(stray) : put_aside(stray);
  }
  for (const fs::path& folder : entries_of(folder_ / "tours")) {
    if (folders.contains(folder)) continue;
    std::error_code ignored;
    if (folder.extension() == kRemovedEnd || fs::is_empty(folder, ignored)) {
      fs::remove_all(folder, ignored);
    } else {
      put_aside(folder);
    }
  }
}

void SqliteStore::need_no_longer(const fs::path& file_or_folder) {
  const std::scoped_lock lock(contents_mutex_);
  std::erase_if(contents_.missing,
                [&](const fs::path& file) { return file == file_or_folder || file.parent_path() == file_or_folder; });
}

StoreCondition SqliteStore::condition() {
  StoreCondition condition;
  const Status answers = database_.read(
      [](SQLite::Database& database) { prepared(database, "SELECT count(*) FROM settings").executeStep(); });
  if (!answers) condition.database = answers.error();
  {
    const std::scoped_lock lock(contents_mutex_);
    condition.quarantined = contents_.quarantined;
    // A few at a time: anybody may ask how the store is.
    const auto first = contents_.missing.begin();
    const auto last = first + std::min<std::ptrdiff_t>(kMostLookedFor, std::ssize(contents_.missing));
    contents_.missing.erase(std::remove_if(first, last,
                                           [](const fs::path& file) {
                                             std::error_code ignored;
                                             return fs::is_regular_file(file, ignored);
                                           }),
                            last);
    condition.missing_files = static_cast<std::int64_t>(contents_.missing.size());
    for (const fs::path& file : contents_.missing) {
      if (condition.missing.size() < kMostNamed) condition.missing.push_back(named(file, folder_));
    }
  }
  struct statvfs disk {};
  if (::statvfs(folder_.c_str(), &disk) == 0) {
    condition.free_bytes = static_cast<std::int64_t>(disk.f_bavail) * static_cast<std::int64_t>(disk.f_frsize);
  }
  return condition;
}

}  // namespace homeward::db
