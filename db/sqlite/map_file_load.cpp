// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "db/map_file.hpp"
#include "db/sqlite/failure_words.hpp"
#include "db/sqlite/map_file_contents.hpp"
#include "db/sqlite/map_file_schema.hpp"
#include "db/sqlite/map_graph_part.hpp"

namespace homeward::db {
namespace {

constexpr std::string_view kSqliteStart{"SQLite format 3\0", 16};
constexpr off_t kMostBytes = off_t{4} << 30;

[[noreturn]] void refuse(ErrorCode code, std::string message) { throw LoadFailure({code, std::move(message), {}}); }

[[noreturn]] void refuse_for_errno(const char* what) {
  refuse(ErrorCode::kIo, std::string(what) + ": " + std::strerror(errno) + ".");
}

struct Descriptor {
  explicit Descriptor(int opened) : value(opened) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
  int value;
};

struct SqliteFree {
  void operator()(std::uint8_t* bytes) const { sqlite3_free(bytes); }
};

/// The bytes of a file, in memory that an SQLite connection may own.
struct FileBytes {
  std::unique_ptr<std::uint8_t, SqliteFree> bytes;
  std::size_t count = 0;
};

/// The first bytes of a file, as many as there are.
void check_start(std::span<const std::uint8_t> bytes) {
  const std::size_t known = std::min(bytes.size(), kSqliteStart.size());
  if (std::memcmp(bytes.data(), kSqliteStart.data(), known) != 0) {
    refuse(ErrorCode::kCorruptFile, "This file is not a Homeward map.");
  }
}

/// A map is read from memory: what lies beside the file (a journal) changes nothing, and nothing appears beside it.
FileBytes read_file(const std::filesystem::path& file) {
  const Descriptor descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (descriptor.value < 0) {
    if (errno == ENOENT || errno == ENOTDIR) refuse(ErrorCode::kNotFound, "There is no map file of this name.");
    refuse_for_errno("The map file may not be read");
  }
  struct stat about {};
  if (::fstat(descriptor.value, &about) != 0) refuse_for_errno("The map file cannot be read");
  if (S_ISDIR(about.st_mode)) refuse(ErrorCode::kInvalidInput, "This is a folder and not a map file.");
  if (!S_ISREG(about.st_mode)) refuse(ErrorCode::kInvalidInput, "This is not a plain file and so not a map file.");
  if (about.st_size == 0) refuse(ErrorCode::kCorruptFile, "The map file is empty.");
  if (about.st_size > kMostBytes) refuse(ErrorCode::kTooLarge, "The file is larger than a map may be (4 GiB).");
  // Before room is made for all of it: anybody may have sent this file.
  std::array<std::uint8_t, kSqliteStart.size()> start{};
  const ssize_t begun = ::pread(descriptor.value, start.data(), start.size(), 0);
  if (begun < 0) refuse_for_errno("The map file cannot be read");
  check_start(std::span(start).first(static_cast<std::size_t>(begun)));
  FileBytes read;
  read.count = static_cast<std::size_t>(about.st_size);
  read.bytes.reset(static_cast<std::uint8_t*>(sqlite3_malloc64(read.count)));
  if (!read.bytes) throw std::bad_alloc();
  std::size_t done = 0;
  while (done < read.count) {
    const ssize_t count = ::read(descriptor.value, read.bytes.get() + done, read.count - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse_for_errno("The map file cannot be read");
    if (count == 0) refuse(ErrorCode::kIo, "The map file became shorter while it was read; try again.");
    done += static_cast<std::size_t>(count);
  }
  return read;
}

void give_bytes(SQLite::Database& database, FileBytes read) {
  const auto count = static_cast<sqlite3_int64>(read.count);
  constexpr unsigned kFlags = SQLITE_DESERIALIZE_FREEONCLOSE | SQLITE_DESERIALIZE_READONLY;
  // Takes the bytes over, also when it fails.
  if (sqlite3_deserialize(database.getHandle(), "main", read.bytes.release(), count, count, kFlags) != SQLITE_OK) {
    refuse(ErrorCode::kCorruptFile, "The map file cannot be opened: " + std::string(database.getErrorMsg()) + ".");
  }
}

/// Returns the version.
int check_kind_and_version(SQLite::Database& database) {
  const int application_id = database.execAndGet("PRAGMA application_id").getInt();
  if (application_id != kMapApplicationId) {
    refuse(ErrorCode::kCorruptFile, "This SQLite file is not a Homeward map.");
  }
  const int version = database.execAndGet("PRAGMA user_version").getInt();
  const std::string has = "The map file has version " + std::to_string(version) + "; this program reads versions " +
                          std::to_string(kOldestMapFileVersion) + " to " + std::to_string(kMapFileVersion) + ". ";
  if (version > kMapFileVersion) {
    refuse(ErrorCode::kUnsupportedFormat, has + "A newer Homeward wrote it: read it with that one.");
  }
  if (version < kOldestMapFileVersion) {
    refuse(ErrorCode::kUnsupportedFormat, has + "Rebuild the map from the kept images.");
  }
  return version;
}

void check_length(SQLite::Database& database, std::size_t bytes) {
  const std::int64_t pages = database.execAndGet("PRAGMA page_count").getInt64();
  const std::int64_t whole_bytes = pages * database.execAndGet("PRAGMA page_size").getInt64();
  if (static_cast<std::int64_t>(bytes) < whole_bytes) {
    refuse(ErrorCode::kCorruptFile, "The map file ends early: copy it again.");
  }
}

/// What the file says its content has; files of before the version that brought it have none.
void check_checksum(SQLite::Database& database, int version, const std::string& found) {
  SQLite::Statement select(database, kSelectChecksum);
  if (select.executeStep()) {
    if (select.getColumn(0).getString() == found) return;
  } else if (version < kFirstVersionWithChecksum) {
    return;
  }
  refuse(ErrorCode::kCorruptFile,
         "The map file is damaged: its content does not have its checksum. Copy it again, or build the map again.");
}

StoredMap read_map(const std::filesystem::path& file) {
  FileBytes read = read_file(file);
  const std::size_t bytes = read.count;
  SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  give_bytes(database, std::move(read));
  const int version = check_kind_and_version(database);
  check_length(database, bytes);
  MapContents contents = read_contents(database);
  check_checksum(database, version, contents.checksum);
  contents.stored.bytes = static_cast<std::int64_t>(bytes) - contents.stored.bytes;
  return std::move(contents.stored);
}

}  // namespace

void put_graph_part(std::span<const std::uint8_t> bytes, map::TopologicalMap& map) {
  FileBytes read;
  read.count = bytes.size();
  read.bytes.reset(static_cast<std::uint8_t*>(sqlite3_malloc64(read.count)));
  if (!read.bytes) throw std::bad_alloc();
  std::memcpy(read.bytes.get(), bytes.data(), bytes.size());
  check_start(bytes);
  SQLite::Database database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  give_bytes(database, std::move(read));
  read_graph_part(database, map);
}

Result<StoredMap> load_map(const std::filesystem::path& file) {
  try {
    return read_map(file);
  } catch (LoadFailure& failure) {
    Error error = std::move(failure.error);
    error.where = error.where.empty() ? file.string() : file.string() + ": " + error.where;
    return tl::unexpected<Error>(std::move(error));
  } catch (const nlohmann::json::exception&) {
    return fail(ErrorCode::kCorruptFile, "The map file is damaged: an entry of it cannot be understood.",
                file.string());
  } catch (const std::exception& failure) {
    return fail(ErrorCode::kCorruptFile, "The map file is damaged: " + words_of(failure) + ".", file.string());
  }
}

}  // namespace homeward::db
