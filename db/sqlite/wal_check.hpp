// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace homeward::db {

/// Before SQLite opens a database: whether the write-ahead log beside it, which a process that was killed has left,
/// lost something that was committed. SQLite takes a damaged frame for the end of the log and says nothing. A last
/// transaction that cannot be read is one that was cut off, as far as anybody can tell; a damage before it is none.
/// Format and checksums by "WAL-mode File Format" (sqlite.org/walformat.html); the judgement is ours.
/// Throws StoreFailure (kCorruptFile), std::system_error.
void check_write_ahead_log(const std::filesystem::path& database);

}  // namespace homeward::db
