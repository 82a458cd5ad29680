// SPDX-License-Identifier: Apache-2.0
// Damaged map files: each is loaded whole or refused with a sentence, and the file is left as it is.
#include <gtest/gtest.h>

#include "db/map_file.hpp"
#include "fuzz/mutate.hpp"
#include "support/sample_map.hpp"
#include "support/sample_path.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::map_file_test {
namespace {

using testing::Bytes;
using testing::Mutator;
using testing::ScratchFolder;

/// With one of everything, a taught path too.
map::TopologicalMap whole_map() {
  map::TopologicalMap map = testing::sample_map();
  map.path = std::make_shared<const map::MapPath>(testing::sample_path());
  return map;
}

TEST(FuzzMapFile, IsLoadedWholeOrRefused) {
  const ScratchFolder folder;
  ASSERT_TRUE(db::save_map(folder.path() / "good.map", whole_map(), {}));
  const std::string text = folder.text("good.map");
  const Bytes good(text.begin(), text.end());
  Mutator mutator(1);
  int refused = 0;
  int saved = 0;
  constexpr int kRounds = 400;
  for (int i = 0; i < kRounds; ++i) {
    const Bytes bytes = mutator.damaged(good);
    const std::string damaged(bytes.begin(), bytes.end());
    const auto file = folder.put("damaged.map", damaged);
    const auto loaded = db::load_map(file);
    EXPECT_EQ(folder.text("damaged.map"), damaged);  // reading changes nothing
    EXPECT_EQ(folder.count(), saved > 0 ? 3 : 2);    // and leaves nothing beside it
    if (loaded) {
      EXPECT_FALSE(loaded->map.places.empty());
      if (++saved > 10) continue;
      EXPECT_TRUE(db::save_map(folder.path() / "again.map", loaded->map, loaded->thumbnails));
      continue;
    }
    ++refused;
    const Error& error = loaded.error();
    EXPECT_TRUE(error.code == ErrorCode::kCorruptFile || error.code == ErrorCode::kUnsupportedFormat)
        << static_cast<int>(error.code) << error.message;
    EXPECT_NE(error.where.find("damaged.map"), std::string::npos) << error.where;
    EXPECT_EQ(error.message.find('\n'), std::string::npos);
  }
  EXPECT_GT(refused, kRounds / 4);
  EXPECT_LT(refused, kRounds);
}

TEST(FuzzMapFile, StartsOfAMapAreRefused) {
  const ScratchFolder folder;
  ASSERT_TRUE(db::save_map(folder.path() / "good.map", whole_map(), {}));
  const std::string good = folder.text("good.map");
  for (std::size_t length = 0; length < good.size(); length += 1 + good.size() / 60) {
    EXPECT_FALSE(db::load_map(folder.put("part.map", good.substr(0, length)))) << length;
  }
}

}  // namespace
}  // namespace homeward::map_file_test
