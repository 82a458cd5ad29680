// SPDX-License-Identifier: Apache-2.0
#include "server/services/map_cache.hpp"

#include <gtest/gtest.h>

namespace homeward::server::map_cache_test {
namespace {

LoadedMap map_of(std::int64_t bytes, std::int64_t revision = 1, std::size_t thumbnail_bytes = 0) {
  db::StoredMap stored;
  stored.map.revision = revision;
  stored.bytes = bytes;
  if (thumbnail_bytes > 0) stored.thumbnails[ImageId("tour/1.jpg")] = std::vector<std::uint8_t>(thumbnail_bytes);
  return std::make_shared<const db::StoredMap>(std::move(stored));
}

const MapId kA("m_a");
const MapId kB("m_b");
const MapId kC("m_c");

TEST(MapCache, TheOldestMapsGoWhenAllTogetherHaveMoreBytesThanAllowed) {
  MapCache cache({8, 100});
  cache.keep(kA, map_of(40));
  cache.keep(kB, map_of(60));
  EXPECT_TRUE(cache.find(kA, 1));
  cache.keep(kC, map_of(40));
  EXPECT_FALSE(cache.find(kA, 1));
  EXPECT_TRUE(cache.find(kB, 1));
  EXPECT_TRUE(cache.find(kC, 1));
}

TEST(MapCache, ThumbnailsCountAsBytes) {
  MapCache cache({8, 100});
  cache.keep(kA, map_of(40));
  cache.keep(kB, map_of(10, 1, 60));
  EXPECT_FALSE(cache.find(kA, 1));
  EXPECT_TRUE(cache.find(kB, 1));
}

TEST(MapCache, TheOldestMapsGoWhenThereAreMoreThanAllowed) {
  MapCache cache({2, 100});
  cache.keep(kA, map_of(1));
  cache.keep(kB, map_of(1));
  cache.keep(kC, map_of(1));
  EXPECT_FALSE(cache.find(kA, 1));
  EXPECT_TRUE(cache.find(kB, 1));
}

TEST(MapCache, TheNewestStaysHoweverLargeItIsAndWhatWasDisplacedLivesWithItsHolder) {
  MapCache cache({8, 100});
  const LoadedMap held = map_of(40);
  cache.keep(kA, held);
  cache.keep(kB, map_of(5000));
  EXPECT_FALSE(cache.find(kA, 1));
  EXPECT_TRUE(cache.find(kB, 1));
  EXPECT_EQ(held->map.revision, 1);
}

TEST(MapCache, ARevisionTakesThePlaceOfTheOneBefore) {
  MapCache cache({8, 100});
  const LoadedMap first = map_of(60, 1);
  cache.keep(kB, map_of(40));
  cache.keep(kA, first);
  cache.keep_changed(kA, map_of(60, 2), first);
  EXPECT_TRUE(cache.find(kB, 1)) << "one of 60 and one of 40 fit";
  ASSERT_TRUE(cache.find(kA, 1));
  EXPECT_EQ(cache.find(kA, 1)->map.revision, 2);
  EXPECT_FALSE(cache.find(kA, 3));
}

TEST(MapCache, TheGraphIsComputedOnceForAMapThatIsKept) {
  MapCache cache;
  const LoadedMap kept = map_of(1);
  cache.keep(kA, kept);
  EXPECT_EQ(cache.graph(kA, kept), cache.graph(kA, kept));
  const LoadedMap stranger = map_of(1);
  EXPECT_NE(cache.graph(kB, stranger), cache.graph(kB, stranger));
}

}  // namespace
}  // namespace homeward::server::map_cache_test
