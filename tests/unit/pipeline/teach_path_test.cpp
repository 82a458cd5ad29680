// SPDX-License-Identifier: Apache-2.0
#include "pipeline/teach_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "camera/camera.hpp"
#include "core/angles.hpp"
#include "core/index.hpp"
#include "support/taught_room.hpp"

namespace homeward::pipeline::teach_path_test {
namespace {

using homeward::testing::bend;
using homeward::testing::PaintedRoom;

/// The pictures of a drive through a painted room.
std::vector<Image> drive(const std::vector<Pose2>& poses, const camera::Camera& camera) {
  std::vector<Image> pictures;
  for (const Pose2& pose : poses) {
    const Image grey = homeward::testing::lens_picture(PaintedRoom{}, pose, camera);
    Image& rgb = pictures.emplace_back(grey.width_px, grey.height_px, 3);
    for (std::size_t i = 0; i < rgb.data.size(); ++i) rgb.data[i] = grey.data[i / 3];
  }
  return pictures;
}

/// The first so many of them as a tour; some cannot be read.
class RoomTour final : public TourSource {
 public:
  RoomTour(const std::vector<Image>& pictures, const std::vector<Pose2>& poses, std::size_t count, bool odometry)
      : pictures_(pictures) {
    for (std::size_t i = 0; i < count; ++i) {
      images_.push_back({ImageId("room/" + std::to_string(100 + i) + ".png"), std::nullopt,
                         odometry ? std::optional(poses[i]) : std::nullopt});
    }
  }
  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t index) const override {
    if (broken_.contains(index)) return fail(ErrorCode::kTruncatedImage, "Half a picture.");
    return pictures_[index];
  }

  std::vector<TourMark> marks_;
  std::set<std::size_t> broken_;

 private:
  const std::vector<Image>& pictures_;
  std::vector<TourImage> images_;
};

class TeachPath : public ::testing::Test {
 protected:
  TeachPath() {
    config_.most_features = 100;
    config_.least_features = 60;
  }
  static Result<std::vector<std::uint8_t>> bytes(std::size_t index) {
    return std::vector<std::uint8_t>{static_cast<std::uint8_t>(index), 7};
  }
  [[nodiscard]] Result<PathMap> teach(const RoomTour& tour) const {
    return teach_path(tour, camera_, "room", config_, bytes);
  }

  static void SetUpTestSuite() {
    poses_ = bend(16);
    pictures_ = drive(poses_, *camera::Camera::create(homeward::testing::small_lens_camera()).value());
  }
  [[nodiscard]] static RoomTour tour(std::size_t count = 16, bool odometry = true) {
    return {pictures_, poses_, count, odometry};
  }

  static inline std::vector<Pose2> poses_;
  static inline std::vector<Image> pictures_;
  camera::CameraConfig camera_ = homeward::testing::small_lens_camera();
  repeat::TeachConfig config_;
};

TEST_F(TeachPath, MakesAMapOfKeyImagesWithTheirPicturesAndArcs) {
  RoomTour room = tour();
  room.marks_ = {{"115.png", "window"}};
  room.broken_ = {3};
  const auto made = teach(room);
  ASSERT_TRUE(made) << made.error().message;
  const map::TopologicalMap& map = made->map;
  ASSERT_TRUE(map.path);
  const map::MapPath& path = *map.path;
  ASSERT_EQ(made->skipped.size(), 1U);
  EXPECT_EQ(made->skipped[0].where, "room/103.png");
  EXPECT_EQ(map.images.size(), 15U);
  ASSERT_GE(path.images.size(), 3U);
  ASSERT_EQ(path.pictures.size(), path.images.size());
  ASSERT_EQ(map.places.size(), path.images.size());
  std::size_t members = 0;
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    const map::Place& place = map.places[i];
    EXPECT_EQ(place.prototype, path.images[i]);
    EXPECT_EQ(map.images[at(path.taught.key_images[i].picture)].id, path.images[i]);
    EXPECT_NE(std::ranges::find(place.members, place.prototype), place.members.end());
    EXPECT_FALSE(place.appearances.empty());
    // The number in its name is its number in the tour, broken pictures counted.
    EXPECT_EQ(path.pictures[i][0], std::stoi(path.images[i].str().substr(5, 3)) - 100);
    members += place.members.size();
  }
  EXPECT_EQ(members, map.images.size());
  ASSERT_EQ(map.edges.size(), 2 * path.taught.arcs.size());
  int with_bearing = 0;
  for (std::size_t i = 0; i < path.taught.arcs.size(); ++i) {
    const map::Edge& there = map.edges[2 * i];
    const map::Edge& back = map.edges[2 * i + 1];
    const Pose2& from = *map.images[at(path.taught.key_images[i].picture)].odometry;
    const Pose2& to = *map.images[at(path.taught.key_images[i + 1].picture)].odometry;
    EXPECT_EQ(there.from, back.to);
    EXPECT_EQ(there.to, back.from);
    EXPECT_NEAR(there.length_m, (position_m(to) - position_m(from)).norm(), 1e-9);
    EXPECT_NEAR(*there.turn_rad, to.theta_rad - from.theta_rad, 0.02);
    EXPECT_EQ(*back.turn_rad, -*there.turn_rad);
    ASSERT_EQ(there.bearing_rad.has_value(), path.taught.arcs[i].has_baseline);
    ASSERT_EQ(back.bearing_rad.has_value(), path.taught.arcs[i].has_baseline);
    if (!there.bearing_rad) continue;
    ++with_bearing;
    const Pose2 seen = inverse(from) * to;
    EXPECT_NEAR(wrap_angle(*there.bearing_rad - std::atan2(seen.y_m, seen.x_m)), 0.0, 0.1);
    const Pose2 behind = inverse(to) * from;
    EXPECT_NEAR(wrap_angle(*back.bearing_rad - std::atan2(behind.y_m, behind.x_m)), 0.0, 0.1);
  }
  EXPECT_GE(with_bearing, 1);
  ASSERT_EQ(map.destinations.size(), 1U);
  EXPECT_EQ(map.destinations[0].image.str(), "room/115.png");
  EXPECT_EQ(map.destinations[0].place, map.places.back().id);
  EXPECT_EQ(map.places.back().label, "window");
}

TEST_F(TeachPath, WithoutOdometryLengthsAreNumbersOfPictures) {
  const auto made = teach(tour(16, false));
  ASSERT_TRUE(made);
  const auto& keys = made->map.path->taught.key_images;
  ASSERT_EQ(made->map.edges.size(), 2 * (keys.size() - 1));
  for (std::size_t i = 0; i < made->map.edges.size(); ++i) {
    EXPECT_EQ(made->map.edges[i].length_from, map::LengthSource::kTourImages);
    EXPECT_EQ(made->map.edges[i].length_m, keys[i / 2 + 1].picture - keys[i / 2].picture);
  }
}

TEST_F(TeachPath, SaysWhatIsWrongAndWhere) {
  RoomTour room = tour();
  room.marks_ = {{"999.png", "nowhere"}};
  const auto unmarked = teach(room);
  ASSERT_FALSE(unmarked);
  EXPECT_EQ(unmarked.error().where, "999.png");
  room.marks_.clear();
  for (std::size_t i = 0; i < poses_.size(); ++i) room.broken_.insert(i);
  EXPECT_EQ(teach(room).error().code, ErrorCode::kTruncatedImage);
  EXPECT_EQ(teach(tour(0)).error().code, ErrorCode::kEmptyInput);
  EXPECT_EQ(teach(tour(1)).error().code, ErrorCode::kTooFewImages);
  camera::CameraConfig wide = camera_;
  wide.width_px = 300;
  const auto other = teach_path(tour(), wide, "room", config_, bytes);
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().code, ErrorCode::kWrongImageSize);
  EXPECT_EQ(other.error().where, "room/100.png");
  const auto unread = [](std::size_t) -> Result<std::vector<std::uint8_t>> {
    return fail(ErrorCode::kIo, "gone", "x");
  };
  EXPECT_EQ(teach_path(tour(), camera_, "room", config_, unread).error().code, ErrorCode::kIo);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ(teach_path(tour(), camera_, "room", config_, bytes, {}, stop.get_token()).error().code,
            ErrorCode::kCancelled);
}

}  // namespace
}  // namespace homeward::pipeline::teach_path_test
