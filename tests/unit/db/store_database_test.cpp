// SPDX-License-Identifier: Apache-2.0
#include "db/sqlite/store_database.hpp"

#include <gtest/gtest.h>

#include <future>
#include <thread>

#include "db/sqlite/keyed_mutex.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::db::store_database_test {
namespace {

std::int64_t count_of(SQLite::Database& database) {
  SQLite::Statement row = prepared(database, "SELECT count(*) FROM settings");
  row.executeStep();
  return integer(row, 0);
}

void set(SQLite::Database& database, const std::string& key) {
  execute(database, "INSERT INTO settings (key, value) VALUES (?, 'x')", key);
}

TEST(StoreDatabase, WhoReadsWaitsForNoWriterAndSeesWhatWasCommitted) {
  const testing::ScratchFolder folder;
  StoreDatabase database(folder.path() / "homeward.db");
  ASSERT_TRUE(database.work([](SQLite::Database& writer) { set(writer, "a"); }));
  const auto read = [&] { return database.read(count_of); };
  ASSERT_TRUE(database.work([&](SQLite::Database& writer) {
    set(writer, "b");
    std::vector<std::future<Result<std::int64_t>>> readers;
    for (int i = 0; i < 4; ++i) readers.push_back(std::async(std::launch::async, read));
    for (auto& reader : readers) {
      if (reader.wait_for(std::chrono::seconds(20)) != std::future_status::ready) std::abort();  // it would never end
      EXPECT_EQ(reader.get().value(), 1);
    }
  }));
  EXPECT_EQ(read().value(), 2);
}

TEST(StoreDatabase, AReaderCannotWrite) {
  const testing::ScratchFolder folder;
  StoreDatabase database(folder.path() / "homeward.db");
  const Status written = database.read([](SQLite::Database& reader) { set(reader, "a"); });
  EXPECT_FALSE(written);
  EXPECT_EQ(database.read(count_of).value(), 0);
}

TEST(KeyedMutex, HoldsOneNameAtATimeAndOthersBesideIt) {
  KeyedMutex locks;
  int inside = 0;
  int most = 0;
  std::vector<std::jthread> threads;
  const KeyedMutex::Hold other(locks, "other");
  for (int i = 0; i < 8; ++i) {
    threads.emplace_back([&] {
      for (int k = 0; k < 200; ++k) {
        const KeyedMutex::Hold alone(locks, "one");
        most = std::max(most, ++inside);
        --inside;
      }
    });
  }
  threads.clear();
  EXPECT_EQ(most, 1);
}

}  // namespace
}  // namespace homeward::db::store_database_test
