// SPDX-License-Identifier: Apache-2.0
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "map/state.hpp"
#include "support/sample_map.hpp"
#include "unit/db/store_fixture.hpp"

namespace homeward::db::store_content_test {
namespace {

using ::testing::ElementsAre;

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

class StoreContent : public StoreTest {
 protected:
  TourId new_tour(TimeUs created_us = 1) {
    Tour tour;
    tour.name = "morning";
    tour.camera = "{}";
    tour.created_us = created_us;
    return store().add_tour(tour)->id;
  }
  Result<PutImage> put(const TourId& tour, std::int64_t number, std::vector<std::uint8_t> bytes) {
    TourImage image;
    image.number = number;
    image.odometry = Pose2{1.0, 2.0, 0.5};
    image.t_us = 77;
    return store().put_image(tour, image, bytes);
  }
  MapId new_map(std::vector<TourId> tours = {}) {
    MapRecord map;
    map.name = "house";
    map.tours = std::move(tours);
    return store().add_map(map)->id;
  }
  [[nodiscard]] std::size_t map_files() const {
    const std::filesystem::directory_iterator files(folder() / "maps");
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }
};

TEST_F(StoreContent, PuttingAnImageAgainChangesNothing) {
  const TourId tour = new_tour();
  EXPECT_EQ(put(tour, 0, {1, 2, 3}).value(), PutImage::kNew);
  EXPECT_EQ(put(tour, 0, {1, 2, 3}).value(), PutImage::kSame);
  EXPECT_EQ(put(tour, 0, {1, 2, 4}).value(), PutImage::kConflict);
  EXPECT_EQ(put(tour, 4, {9}).value(), PutImage::kNew);
  open();
  EXPECT_THAT(store().image_bytes(tour, 0).value(), ElementsAre(1, 2, 3));
  const Tour found = store().tour(tour).value();
  EXPECT_EQ(found.images, 2);
  EXPECT_THAT(found.missing, ElementsAre(1, 2, 3));
  const auto images = store().tour_images(tour).value();
  EXPECT_EQ(images.at(1).file, "000004.jpg");
  EXPECT_EQ(images.at(1).t_us, 77);
  EXPECT_DOUBLE_EQ(images.at(1).odometry->theta_rad, 0.5);
  EXPECT_EQ(images.at(0).size, 3);
}

TEST_F(StoreContent, ASweepBelongsToItsImageAndGoesWithTheTour) {
  const TourId tour = new_tour();
  TourSweep sweep{3, {}, {}};
  sweep.sweep.ranges_m = {1.2345F, std::numeric_limits<float>::infinity(), 2e5F, std::nanf("")};
  sweep.sweep.angle_step_rad = 0.01;
  EXPECT_EQ(store().put_sweep(tour, sweep).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(put(tour, 3, {1}));
  sweep.file = "000002.jpg";
  EXPECT_EQ(store().put_sweep(tour, sweep).error().code, ErrorCode::kConflict) << "of another image";
  sweep.file = "000003.jpg";
  EXPECT_EQ(store().put_sweep(tour, sweep).value(), PutImage::kNew);
  EXPECT_EQ(store().put_sweep(tour, sweep).value(), PutImage::kSame);
  open();
  TourSweep other = sweep;
  other.sweep.robot_from_scan.x_m = 0.1;
  EXPECT_EQ(store().put_sweep(tour, other).value(), PutImage::kConflict);
  sweep.sweep.angle_min_rad = -0.0;
  EXPECT_EQ(store().put_sweep(tour, sweep).value(), PutImage::kSame) << "as others write 0";
  const auto kept = store().sweeps(tour).value();
  ASSERT_EQ(kept.size(), 1U);
  const std::vector<float>& ranges_m = kept.at(3).ranges_m;
  EXPECT_FLOAT_EQ(ranges_m.at(0), 1.235F) << "whole millimetres";
  EXPECT_TRUE(std::isinf(ranges_m.at(1)));
  EXPECT_TRUE(std::isinf(ranges_m.at(2))) << "100 km and more saw nothing";
  EXPECT_TRUE(std::isinf(ranges_m.at(3)));
  ASSERT_TRUE(store().complete_tour(tour));
  EXPECT_EQ(store().put_sweep(tour, sweep).value(), PutImage::kSame);
  ASSERT_TRUE(store().remove_tour(tour));
  EXPECT_EQ(store().sweeps(tour).error().code, ErrorCode::kNotFound);
}

TEST_F(StoreContent, AKeptSweepThatCannotBeReadIsNamed) {
  const TourId tour = new_tour();
  TourSweep sweep{0, {}, {}};
  sweep.sweep.ranges_m = {1.0F};
  sweep.sweep.angle_step_rad = 0.01;
  ASSERT_TRUE(put(tour, 0, {1}));
  ASSERT_TRUE(store().put_sweep(tour, sweep));
  SQLite::Database((folder() / "homeward.db").string(), SQLite::OPEN_READWRITE)
      .exec("UPDATE tour_sweeps SET sweep = x'a161'");
  const auto kept = store().sweeps(tour);
  ASSERT_FALSE(kept);
  EXPECT_EQ(kept.error().code, ErrorCode::kCorruptFile);
  EXPECT_EQ(kept.error().where, "tours/" + tour.str() + "/images/0/sweep");
}

TEST_F(StoreContent, ATourThatIsCompleteTakesNoMore) {
  const TourId tour = new_tour();
  ASSERT_TRUE(put(tour, 0, {1}));
  ASSERT_TRUE(store().complete_tour(tour));
  EXPECT_TRUE(store().complete_tour(tour));
  EXPECT_EQ(put(tour, 1, {2}).error().code, ErrorCode::kConflict);
  EXPECT_EQ(put(tour, 0, {1}).value(), PutImage::kSame);
  EXPECT_EQ(store().complete_tour(TourId("none")).error().code, ErrorCode::kNotFound);
}

TEST_F(StoreContent, AnImageNameIsUsedOnceAndHasNoFolder) {
  const TourId tour = new_tour();
  const std::vector<std::uint8_t> bytes = {1};
  TourImage image;
  image.file = "a.jpg";
  ASSERT_TRUE(store().put_image(tour, image, bytes));
  image.number = 1;
  EXPECT_EQ(store().put_image(tour, image, bytes).error().code, ErrorCode::kConflict);
  image.file = "../a.jpg";
  EXPECT_EQ(store().put_image(tour, image, bytes).error().code, ErrorCode::kInvalidInput);
}

TEST_F(StoreContent, ADamagedPictureIsNotGivenOut) {
  const TourId tour = new_tour();
  ASSERT_TRUE(put(tour, 0, {1, 2, 3}));
  std::ofstream(folder() / "tours" / tour.str() / "0.jpg") << "xyz";
  EXPECT_EQ(store().image_bytes(tour, 0).error().code, ErrorCode::kCorruptFile);
}

TEST_F(StoreContent, MarksAreReplacedAsAWhole) {
  const TourId tour = new_tour();
  ASSERT_TRUE(store().set_marks(tour, {{"a.jpg", "kitchen"}, {"b.jpg", "bed"}}));
  ASSERT_TRUE(store().set_marks(tour, {{"c.jpg", "hall"}}));
  const auto marks = store().marks(tour).value();
  ASSERT_EQ(marks.size(), 1U);
  EXPECT_EQ(marks[0].label, "hall");
}

TEST_F(StoreContent, AMapIsSavedByRevisionAndItsOldFileGoes) {
  const TourId tour = new_tour();
  const MapId id = new_map({tour});
  EXPECT_EQ(store().load_map_contents(id).error().code, ErrorCode::kNotFound);
  map::TopologicalMap contents = testing::sample_map();
  contents.revision = 1;
  const Thumbnails thumbnails = {{contents.images[0].id, {7}}};
  const auto saved = store().save_map_contents(id, contents, thumbnails, 0);
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_EQ(saved->places, static_cast<std::int64_t>(contents.places.size()));
  contents.revision = 2;
  EXPECT_EQ(store().save_map_contents(id, contents, thumbnails, 0).error().code, ErrorCode::kStaleRevision);
  ASSERT_TRUE(store().save_map_contents(id, contents, thumbnails, 1));
  EXPECT_EQ(map_files(), 1U);
  std::ofstream(folder() / "maps" / "left.behind") << "x";
  open();
  EXPECT_EQ(map_files(), 1U);
  EXPECT_EQ(store().map(id)->state, wire::MapState::kReady);
  EXPECT_THAT(store().map(id)->tours, ElementsAre(tour));
  EXPECT_EQ(store().load_map_contents(id)->map.revision, 2);
  EXPECT_EQ(store().load_map_contents(id)->thumbnails, thumbnails);
  EXPECT_EQ(store().remove_tour(tour).error().code, ErrorCode::kConflict);
  ASSERT_TRUE(store().remove_map(id));
  EXPECT_EQ(map_files(), 0U);
  EXPECT_TRUE(store().remove_tour(tour));
}

TEST_F(StoreContent, AnEditIsKeptWithoutWritingTheMapAnew) {
  const MapId id = new_map();
  map::TopologicalMap contents = testing::sample_map();
  const Thumbnails thumbnails = {{contents.images[0].id, {7}}};
  ASSERT_TRUE(store().save_map_contents(id, contents, thumbnails, 0));
  const auto bytes_of = [&](const map::TopologicalMap& map, const Thumbnails& pictures) {
    EXPECT_TRUE(save_map(folder() / "compared", map, pictures));
    std::ifstream stream(folder() / "compared", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  const std::filesystem::path file = folder() / "maps" / (id.str() + ".r4.homeward");
  const auto written = std::filesystem::last_write_time(file);
  contents.unedited = map::state_of(contents);
  for (int i = 0; i < 3; ++i) {
    ++contents.revision;
    contents.places[0].label = "bedroom " + std::to_string(i);
    contents.edges[0].blocked = i == 1;
    contents.edits.push_back(contents.edits[0]);
    contents.destinations.push_back(contents.destinations[0]);
    contents.destinations.back().id = DestinationId("d" + std::to_string(i + 2));
    EXPECT_EQ(store().save_map_edit(id, contents, contents.revision - 2).error().code, ErrorCode::kStaleRevision);
    ASSERT_TRUE(store().save_map_edit(id, contents, contents.revision - 1));
    const StoredMap loaded = store().load_map_contents(id).value();
    EXPECT_EQ(bytes_of(loaded.map, loaded.thumbnails), bytes_of(contents, thumbnails)) << i;
  }
  EXPECT_EQ(std::filesystem::last_write_time(file), written);
  open();
  EXPECT_EQ(map_files(), 1U);
  EXPECT_EQ(store().map(id)->revision, contents.revision);
  StoredMap loaded = store().load_map_contents(id).value();
  EXPECT_EQ(bytes_of(loaded.map, loaded.thumbnails), bytes_of(contents, thumbnails));
  const auto imported = store().import_map({}, text_of(store().map_file_bytes(id).value()));
  ASSERT_TRUE(imported) << imported.error().message;
  EXPECT_EQ(imported->revision, contents.revision) << "what is exported has the edits";
  EXPECT_EQ(map_files(), 2U);
  open();
  loaded = store().load_map_contents(id).value();
  EXPECT_EQ(bytes_of(loaded.map, loaded.thumbnails), bytes_of(contents, thumbnails));
  ++contents.revision;
  ASSERT_TRUE(store().save_map_contents(id, contents, {}, contents.revision - 1));
  ASSERT_TRUE(store().remove_map(id));
  EXPECT_EQ(map_files(), 1U);
}

TEST_F(StoreContent, EditsOfOtherPlacesAreNotPutOverAMap) {
  const MapId id = new_map();
  map::TopologicalMap contents = testing::sample_map();
  ASSERT_TRUE(store().save_map_contents(id, contents, {}, 0));
  ++contents.revision;
  contents.places[1].id = PlaceId("p7");
  contents.edges.clear();
  contents.destinations.clear();
  ASSERT_TRUE(store().save_map_edit(id, contents, contents.revision - 1));
  EXPECT_EQ(store().load_map_contents(id).error().code, ErrorCode::kCorruptFile);
}

TEST_F(StoreContent, AnExportedMapIsImported) {
  const MapId id = new_map();
  map::TopologicalMap contents = testing::sample_map();
  contents.revision = 5;
  ASSERT_TRUE(store().save_map_contents(id, contents, {}, 0));
  const auto bytes = store().map_file_bytes(id).value();
  const auto imported = store().import_map({}, text_of(bytes));
  ASSERT_TRUE(imported) << imported.error().message;
  EXPECT_EQ(imported->revision, 5);
  EXPECT_EQ(imported->name, contents.name);
  EXPECT_TRUE(store().load_map_contents(imported->id));
  EXPECT_EQ(store().import_map({}, "123").error().code, ErrorCode::kCorruptFile);
  EXPECT_EQ(store().maps()->size(), 2U);
  EXPECT_EQ(map_files(), 2U);
}

TEST_F(StoreContent, JobsThatAreNotOverAreFoundAfterARestart) {
  wire::JobView job;
  job.map = new_map();
  const wire::JobView open_job = *store().add_job(job);
  wire::JobView failed = *store().add_job(job);
  failed.state = wire::JobState::kFailed;
  failed.error = Error{ErrorCode::kTooFewImages, "too few", "tours/1"};
  ASSERT_TRUE(store().update_job(failed));
  open();
  const auto unfinished = store().unfinished_jobs().value();
  ASSERT_EQ(unfinished.size(), 1U);
  EXPECT_EQ(unfinished[0].id, open_job.id);
  EXPECT_EQ(store().job(failed.id)->error->code, ErrorCode::kTooFewImages);
  EXPECT_EQ(store().job(failed.id)->error->where, "tours/1");
  EXPECT_EQ(store().jobs()->size(), 2U);
  failed.skipped = 2;
  failed.notes = {{wire::ReasonCode::kPicturesLeftOutOf,
                   {{"left_out", std::int64_t{2}},
                    {"all", std::int64_t{40}},
                    {"first", std::vector{wire::reason_at({ErrorCode::kIo, "It is gone.", "t1/7.jpg"})}}}},
                  {wire::ReasonCode::kPictureOlder}};
  ASSERT_TRUE(store().update_job(failed));
  EXPECT_EQ(store().job(failed.id)->skipped, 2);
  EXPECT_EQ(store().job(failed.id)->notes, failed.notes);
  EXPECT_TRUE(store().job(open_job.id)->notes.empty());
  job.map = MapId("none");
  EXPECT_EQ(store().add_job(job).error().code, ErrorCode::kNotFound);
}

Drive drive_on(const MapId& map, const std::string& mission, TimeUs created_us) {
  return {MissionId(mission), map, "hw2", created_us, {{PlaceId("p1"), {1, 2, 3}}, {PlaceId(), {}}}};
}

TEST_F(StoreContent, WhatDrivesSawIsKeptUntilNewerDrivesComeOrNobodyWantsIt) {
  const MapId map = new_map();
  EXPECT_EQ(store().add_drive(drive_on(MapId("none"), "m0", 1)).error().code, ErrorCode::kNotFound);
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(store().add_drive(drive_on(map, "m" + std::to_string(i), i)));
  open();
  const auto kept = store().drives(map).value();
  ASSERT_EQ(kept.size(), 8U) << "the oldest make room";
  EXPECT_EQ(kept.front().str(), "m2");
  const Drive drive = store().drive(kept.front()).value();
  EXPECT_EQ(drive.feature_config_id, "hw2");
  ASSERT_EQ(drive.sights.size(), 2U);
  EXPECT_EQ(drive.sights[0].place.str(), "p1");
  EXPECT_THAT(drive.sights[0].appearance, ElementsAre(1, 2, 3));
  EXPECT_TRUE(drive.sights[1].place.empty());
  EXPECT_TRUE(drive.sights[1].appearance.empty());
  EXPECT_EQ(store().drive(MissionId("m0")).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(store().use_drives({kept.front()}));
  EXPECT_EQ(store().drives(map)->size(), 7U);
  EXPECT_EQ(store().kept_drives(map)->size(), 8U);
  EXPECT_TRUE(store().drive(kept.front())) << "what it saw stays";
  ASSERT_TRUE(store().set_map_refine(map, wire::RefineMode::kOff));
  EXPECT_TRUE(store().kept_drives(map)->empty());
  ASSERT_TRUE(store().add_drive(drive_on(map, "m20", 20)));
  EXPECT_TRUE(store().kept_drives(map)->empty()) << "nobody wants it";
  ASSERT_TRUE(store().set_map_refine(map, wire::RefineMode::kAsk));
  ASSERT_TRUE(store().add_drive(drive_on(map, "m20", 20)));
  EXPECT_EQ(store().kept_drives(map)->size(), 1U);
  ASSERT_TRUE(store().remove_map(map));
  EXPECT_EQ(store().drive(MissionId("m20")).error().code, ErrorCode::kNotFound);
}

TEST_F(StoreContent, ContentsToursDrivesAndJobChangeTogetherOrNotAtAll) {
  const TourId first = new_tour();
  const TourId second = new_tour();
  const MapId id = new_map({first});
  map::TopologicalMap contents = testing::sample_map();
  contents.revision = 1;
  ASSERT_TRUE(store().save_map_contents(id, contents, {}, 0));
  ASSERT_TRUE(store().add_drive(drive_on(id, "m1", 1)));
  ASSERT_TRUE(store().add_drive(drive_on(id, "m2", 2)));
  wire::JobView job;
  job.kind = wire::JobKind::kAdd;
  job.map = id;
  job.tours = {second};
  job = *store().add_job(job);
  job.state = wire::JobState::kDone;
  job.gained = 3;
  job.taken = true;
  job.drives = {MissionId("m1")};
  contents.revision = 2;
  AlongWithContents along{{TourId("none")}, {MissionId("m1")}, job};
  EXPECT_EQ(store().save_map_contents(id, contents, {}, 1, along).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(store().map(id)->revision, 1);
  EXPECT_EQ(store().load_map_contents(id)->map.revision, 1);
  EXPECT_EQ(store().drives(id)->size(), 2U);
  EXPECT_EQ(store().unfinished_jobs()->size(), 1U);
  along.new_tours = {second};
  const auto saved = store().save_map_contents(id, contents, {}, 1, along);
  ASSERT_TRUE(saved) << saved.error().message;
  EXPECT_THAT(saved->tours, ElementsAre(first, second));
  open();
  EXPECT_THAT(store().map(id)->tours, ElementsAre(first, second));
  EXPECT_THAT(*store().drives(id), ElementsAre(MissionId("m2")));
  const wire::JobView after = store().job(job.id).value();
  EXPECT_EQ(after.state, wire::JobState::kDone);
  EXPECT_EQ(after.gained, 3);
  EXPECT_TRUE(after.taken);
  EXPECT_THAT(after.tours, ElementsAre(second));
  EXPECT_THAT(after.drives, ElementsAre(MissionId("m1")));
}

TEST_F(StoreContent, AMapRemembersWhatBecomesOfDrives) {
  const MapId id = new_map();
  EXPECT_EQ(store().map(id)->refine, wire::RefineMode::kAsk);
  ASSERT_TRUE(store().set_map_refine(id, wire::RefineMode::kAuto));
  open();
  EXPECT_EQ(store().map(id)->refine, wire::RefineMode::kAuto);
  EXPECT_EQ(store().set_map_refine(MapId("none"), wire::RefineMode::kOff).error().code, ErrorCode::kNotFound);
}

TEST_F(StoreContent, AnswersAreKeptForADay) {
  const RequestKey key{"anna", "POST /maps", "k1"};
  ASSERT_TRUE(store().keep_answer(key, {202, std::string("{\0}", 3)}, 1000));
  ASSERT_TRUE(store().keep_answer(key, {500, "later"}, 1001));
  const TimeUs day_us = 24LL * 3600 * 1'000'000;
  const auto answer = store().answer(key, 1000 + day_us - 1).value();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 202);
  EXPECT_EQ(answer->body, std::string("{\0}", 3));
  EXPECT_FALSE(store().answer(key, 1000 + day_us)->has_value());
  EXPECT_FALSE(store().answer({"berta", "POST /maps", "k1"}, 1001)->has_value());
}

TEST_F(StoreContent, HowMissionsFaredOnWaysIsCounted) {
  const MapId map = new_map();
  const std::vector<DrivenWay> two = {{PlaceId("p1"), PlaceId("p2")}, {PlaceId("p2"), PlaceId("p3")}};
  ASSERT_TRUE(store().count_way_drives(map, two, true, 5));
  ASSERT_TRUE(store().count_way_drives(map, {two[0]}, true, 6));
  ASSERT_TRUE(store().count_way_drives(map, {two[0]}, false, 7));
  open();
  const auto ways = store().way_drives(map).value();
  ASSERT_EQ(ways.size(), 2U);
  EXPECT_EQ(ways[0].driven, 2);
  EXPECT_EQ(ways[0].failed, 1);
  EXPECT_EQ(ways[0].last_driven_us, 6);
  EXPECT_EQ(ways[0].last_failed_us, 7);
  EXPECT_EQ(ways[1].driven, 1);
  EXPECT_EQ(store().count_way_drives(MapId("none"), two, true, 8).error().code, ErrorCode::kNotFound);
  ASSERT_TRUE(store().remove_map(map));
  EXPECT_TRUE(store().way_drives(map)->empty());
}

}  // namespace
}  // namespace homeward::db::store_content_test
