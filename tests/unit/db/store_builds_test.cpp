// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "support/sample_map.hpp"
#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_builds_test {
namespace {

class StoreBuilds : public StoreTest {
 protected:
  MapId new_map() {
    MapRecord map;
    map.name = "house";
    return store().add_map(map)->id;
  }
  void build(const MapId& id, std::int64_t revision, const std::string& report) {
    map::TopologicalMap contents = testing::sample_map();
    contents.revision = revision;
    AlongWithContents along;
    if (!report.empty()) along.build = MapBuild{report, {1, 2, static_cast<std::uint8_t>(revision)}};
    ASSERT_TRUE(store().save_map_contents(id, contents, {}, revision - 1, along));
  }
};

TEST_F(StoreBuilds, OutliveTheProgramAndWhatIsLearntAfterThem) {
  const MapId map = new_map();
  build(map, 1, "<html>first</html>");
  build(map, 2, "");  // learnt
  open();
  EXPECT_EQ(store().build_revision(map).value(), 1);
  EXPECT_EQ(store().build_report(map).value(), "<html>first</html>");
  EXPECT_EQ(store().build_similarity(map)->revision, 1);
  EXPECT_EQ(store().build_similarity(map)->bytes, (std::vector<std::uint8_t>{1, 2, 1}));
}

TEST_F(StoreBuilds, TheLatestReplacesTheOneBefore) {
  const MapId map = new_map();
  build(map, 1, "first");
  build(map, 2, "second");
  EXPECT_EQ(store().build_revision(map).value(), 2);
  EXPECT_EQ(store().build_report(map).value(), "second");
}

TEST_F(StoreBuilds, AreNotFoundWhereNoneWasMadeAndGoWithTheirMap) {
  EXPECT_EQ(store().build_report(MapId("none")).error().code, ErrorCode::kNotFound);
  const MapId map = new_map();
  EXPECT_EQ(store().build_report(map).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().build_revision(map).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().build_similarity(map).error().code, ErrorCode::kNotFound);
  build(map, 1, "first");
  ASSERT_TRUE(store().remove_map(map));
  open();  // nothing is amiss in the database
  EXPECT_EQ(store().build_report(map).error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace homeward::db::store_builds_test
