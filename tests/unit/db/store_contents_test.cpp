// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <fstream>

#include "support/sample_map.hpp"
#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_contents_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

namespace fs = std::filesystem;

class StoreContents : public StoreTest {
 protected:
  TourId new_tour(const std::string& id, int pictures) {
    Tour tour;
    tour.id = TourId(id);
    tour.name = id;
    tour.camera = "{}";
    EXPECT_TRUE(store().add_tour(tour));
    for (std::uint8_t i = 0; i < pictures; ++i) put(tour.id, i);
    return tour.id;
  }
  void put(const TourId& tour, std::uint8_t number) {
    TourImage image;
    image.number = number;
    EXPECT_TRUE(store().put_image(tour, image, std::vector<std::uint8_t>{number, 1, 2}));
  }
  MapId new_map(const std::string& id) {
    MapRecord map;
    map.id = MapId(id);
    map.name = id;
    EXPECT_TRUE(store().add_map(map));
    return map.id;
  }
  void save(const MapId& map, std::int64_t revision) {
    contents_.revision = revision;
    EXPECT_TRUE(store().save_map_contents(map, contents_, {}, revision - 1));
  }
  void copy_database(const std::string& from, const std::string& to) const {
    fs::copy_file(folder() / from, folder() / to, fs::copy_options::overwrite_existing);
  }
  [[nodiscard]] bool has(const std::string& file) const { return fs::exists(folder() / file); }

  map::TopologicalMap contents_ = testing::sample_map();
};

TEST_F(StoreContents, PuttingAnOlderDatabaseInPlaceRemovesNothing) {
  const MapId kept = new_map("kept");
  save(kept, 1);
  const TourId morning = new_tour("morning", 2);
  close();
  copy_database("homeward.db", "older.db");
  open();
  save(kept, 2);
  save(new_map("newer"), 1);
  put(morning, 2);
  new_tour("evening", 1);
  close();
  copy_database("older.db", "homeward.db");
  open();
  const StoreCondition condition = store().condition();
  EXPECT_THAT(condition.quarantined,
              UnorderedElementsAre("quarantine/maps/kept.r2.homeward", "quarantine/maps/newer.r1.homeward",
                                   "quarantine/tours/morning/2.jpg", "quarantine/tours/evening"));
  for (const std::string& file : condition.quarantined) EXPECT_TRUE(has(file)) << file;
  EXPECT_TRUE(has("quarantine/tours/evening/0.jpg"));
  EXPECT_THAT(condition.missing, ElementsAre("maps/kept.r1.homeward")) << "that revision was replaced";
  EXPECT_EQ(store().load_map_contents(kept).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().image_bytes(morning, 1)->size(), 3U);
  EXPECT_TRUE(load_map(folder() / "quarantine/maps/kept.r2.homeward")) << "whole, to be taken in again";
}

TEST_F(StoreContents, AMapWithoutItsContentsIsMissingUntilTheyAreBackOrItIsBuiltAgain) {
  const MapId map = new_map("house");
  const MapId other = new_map("other");
  save(map, 1);
  save(other, 1);
  close();
  fs::rename(folder() / "maps/house.r1.homeward", folder() / "elsewhere");
  fs::remove(folder() / "maps/other.r1.homeward");
  open();
  EXPECT_EQ(store().condition().missing_files, 2);
  fs::rename(folder() / "elsewhere", folder() / "maps/house.r1.homeward");
  EXPECT_THAT(store().condition().missing, ElementsAre("maps/other.r1.homeward"));
  save(other, 2);
  EXPECT_EQ(store().condition().missing_files, 0);
}

TEST_F(StoreContents, APictureThatIsMissingIsToldAndComesBackWithTheSameUpload) {
  const TourId tour = new_tour("tour", 2);
  close();
  fs::remove(folder() / "tours/tour/1.jpg");
  open();
  EXPECT_THAT(store().condition().missing, ElementsAre("tours/tour/1.jpg"));
  put(tour, 1);
  EXPECT_EQ(store().condition().missing_files, 0);
  EXPECT_THAT(store().image_bytes(tour, 1).value(), ElementsAre(1, 1, 2));
}

TEST_F(StoreContents, WhatAKilledWriterLeftIsClearedAndNothingElse) {
  const MapId map = new_map("house");
  save(map, 1);
  save(map, 2);
  new_tour("tour", 1);
  close();
  for (const char* file : {"maps/house.r3.homeward.part", "maps/new.arrived", "tours/tour/1.jpg.part"}) {
    std::ofstream(folder() / file) << "half";
  }
  fs::copy_file(folder() / "maps/house.r2.homeward", folder() / "maps/house.r1.homeward");
  fs::create_directory(folder() / "tours/never");
  open();
  EXPECT_FALSE(has("maps/house.r3.homeward.part"));
  EXPECT_FALSE(has("maps/new.arrived"));
  EXPECT_FALSE(has("tours/tour/1.jpg.part"));
  EXPECT_FALSE(has("maps/house.r1.homeward")) << "the map has gone on from it";
  EXPECT_FALSE(has("tours/never"));
  EXPECT_TRUE(has("maps/house.r2.homeward"));
  EXPECT_THAT(store().condition().quarantined, IsEmpty());
  EXPECT_GT(store().condition().free_bytes, 0);
  EXPECT_FALSE(store().condition().database);
}

TEST_F(StoreContents, ARemovalThatWasCutOffIsFinishedOrUndoneAsItsRowSays) {
  const MapId map = new_map("house");
  save(map, 1);
  const TourId tour = new_tour("tour", 1);
  close();
  fs::rename(folder() / "maps/house.r1.homeward", folder() / "maps/house.r1.homeward.removed");
  fs::rename(folder() / "tours/tour", folder() / "tours/tour.removed");
  fs::create_directories(folder() / "tours/gone.removed");
  std::ofstream(folder() / "tours/gone.removed/0.jpg") << "somebody's home";
  std::ofstream(folder() / "maps/gone.r1.homeward.removed") << "a map";
  open();
  EXPECT_TRUE(store().load_map_contents(map));
  EXPECT_EQ(store().image_bytes(tour, 0)->size(), 3U);
  EXPECT_FALSE(has("tours/gone.removed"));
  EXPECT_FALSE(has("maps/gone.r1.homeward.removed"));
  EXPECT_FALSE(has("quarantine"));
}

TEST_F(StoreContents, QuarantineWritesNothingOver) {
  for (const char* text : {"first", "second"}) {
    close();
    std::ofstream(folder() / "maps/notes.txt") << text;
    open();
  }
  EXPECT_THAT(store().condition().quarantined, ElementsAre("quarantine/maps/notes.txt~2"));
  std::string first;
  std::ifstream(folder() / "quarantine/maps/notes.txt") >> first;
  EXPECT_EQ(first, "first");
}

}  // namespace
}  // namespace homeward::db::store_contents_test
