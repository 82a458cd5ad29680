// SPDX-License-Identifier: Apache-2.0
#include "files/tour_folder.hpp"

#include <gtest/gtest.h>

#include "imageio/decode.hpp"
#include "support/scratch_folder.hpp"

namespace homeward::files::tour_folder_test {
namespace {

using homeward::testing::ScratchFolder;

std::string picture(std::uint8_t grey) {
  Image image(16, 8, 3);
  std::ranges::fill(image.data, grey);
  const auto bytes = imageio::encode_png(image);
  return {bytes.begin(), bytes.end()};
}

struct Tour {
  Tour() {
    folder.put("tour/b.png", picture(20));
    folder.put("tour/a.PNG", picture(10));
    folder.put("tour/c.jpeg", picture(30));  // the content counts, not the ending
    folder.put("tour/notes.txt", "no picture");
  }
  [[nodiscard]] Result<TourFolder> open() const { return TourFolder::open(folder.path() / "tour"); }
  ScratchFolder folder;
};

TEST(TourFolder, TakesPicturesInTheOrderOfTheirNames) {
  const Tour tour;
  const auto opened = tour.open();
  ASSERT_TRUE(opened) << opened.error().message;
  ASSERT_EQ(opened->images().size(), 3U);
  EXPECT_EQ(opened->images()[0].id.str(), "tour/a.PNG");
  EXPECT_EQ(opened->images()[1].id.str(), "tour/b.png");
  EXPECT_EQ(opened->images()[2].id.str(), "tour/c.jpeg");
  EXPECT_FALSE(opened->images()[0].t_us);
  EXPECT_FALSE(opened->images()[0].odometry);
  EXPECT_TRUE(opened->marks().empty());
  for (std::size_t i = 0; i < 3; ++i) {
    const auto image = opened->read(i);
    ASSERT_TRUE(image) << image.error().message;
    EXPECT_EQ(image->data[0], 10 * (i + 1));
  }
}

TEST(TourFolder, HasTheSameNameHoweverItsPathIsWritten) {
  const Tour tour;
  for (const char* ending : {"tour/", "tour/.", "tour/../tour", "./tour"}) {
    const auto opened = TourFolder::open(tour.folder.path() / ending);
    ASSERT_TRUE(opened);
    EXPECT_EQ(opened->images()[0].id.str(), "tour/a.PNG") << ending;
  }
}

TEST(TourFolder, ReadsMarksTimesAndOdometry) {
  const Tour tour;
  tour.folder.put("tour/tour.json", R"({"marks":[{"image":"b.png","label":"kitchen"}]})");
  tour.folder.put("tour/times.csv", "filename,t_us\nc.jpeg,3000000\na.PNG,1000000\r\nb.png,2000000\n");
  tour.folder.put("tour/odometry.csv",
                  "t_us,x_m,y_m,theta_rad\n500000,0,0,3.0\n1500000,1.0,0,-3.0\n2500000,2.0,2.0,-3.0\n");
  const auto opened = tour.open();
  ASSERT_TRUE(opened) << opened.error().message << opened.error().where;
  ASSERT_EQ(opened->marks().size(), 1U);
  EXPECT_EQ(opened->marks()[0].image, "b.png");
  EXPECT_EQ(opened->marks()[0].label, "kitchen");
  EXPECT_EQ(opened->images()[1].t_us, 2'000'000);
  // Between two rows by share of time, headings over the shorter side.
  ASSERT_TRUE(opened->images()[0].odometry);
  EXPECT_NEAR(opened->images()[0].odometry->x_m, 0.5, 1e-9);
  EXPECT_NEAR(std::abs(opened->images()[0].odometry->theta_rad), kPi, 1e-9);
  EXPECT_NEAR(opened->images()[1].odometry->y_m, 1.0, 1e-9);
  EXPECT_FALSE(opened->images()[2].odometry);  // after the recording: nothing is made up
}

TEST(TourFolder, TakesOneRowForEachPictureWithoutTimes) {
  const Tour tour;
  tour.folder.put("tour/odometry.csv", "t_us,x_m,y_m,theta_rad\n1,0,0,0\n2,1,0,0\n3,2,0,7\n");
  const auto opened = tour.open();
  ASSERT_TRUE(opened);
  EXPECT_DOUBLE_EQ(opened->images()[2].odometry->x_m, 2.0);
  EXPECT_NEAR(opened->images()[2].odometry->theta_rad, 7.0 - 2.0 * kPi, 1e-12);
  tour.folder.put("tour/odometry.csv", "t_us,x_m,y_m,theta_rad\n1,0,0,0\n2,1,0,0\n");
  EXPECT_EQ(tour.open().error().code, ErrorCode::kInvalidInput);
}

TEST(TourFolder, StandsWildTimes) {
  const Tour tour;
  tour.folder.put("tour/times.csv", "filename,t_us\na.PNG,0\nb.png,5\nc.jpeg,9223372036854775807\n");
  tour.folder.put("tour/odometry.csv",
                  "t_us,x_m,y_m,theta_rad\n-9223372036854775808,0,0,0\n9223372036854775807,2,0,0\n");
  const auto opened = tour.open();
  ASSERT_TRUE(opened);
  EXPECT_NEAR(opened->images()[0].odometry->x_m, 1.0, 1e-6);
  EXPECT_NEAR(opened->images()[2].odometry->x_m, 2.0, 1e-6);
}

TEST(TourFolder, NeverReadsTheTruth) {
  const Tour tour;
  tour.folder.put("tour/poses.csv", "broken,,,\n\xff");
  ASSERT_TRUE(tour.open());
  EXPECT_FALSE(tour.open()->images()[0].odometry);
}

TEST(TourFolder, NamesFileAndLineOfWhatIsWrong) {
  const auto error_of = [](const char* file, const char* text) {
    const Tour tour;
    tour.folder.put(std::string("tour/") + file, text);
    const auto opened = tour.open();
    EXPECT_FALSE(opened) << file << ": " << text;
    return opened ? Error{} : opened.error();
  };
  EXPECT_TRUE(error_of("times.csv", "name,time\n").where.ends_with("times.csv:1"));
  EXPECT_TRUE(error_of("times.csv", "filename,t_us\na.PNG,1\nb.png,soon\n").where.ends_with("times.csv:3"));
  EXPECT_TRUE(error_of("times.csv", "filename,t_us\na.PNG\n").where.ends_with("times.csv:2"));
  EXPECT_TRUE(error_of("odometry.csv", "t_us,x_m,y_m,theta_rad\n1,0,nan,0\n").where.ends_with("odometry.csv:2"));
  for (const char* text : {"{", "[]", R"({"marks":3})", R"({"marks":[{"image":"a.PNG"}]})"}) {
    const Error error = error_of("tour.json", text);
    EXPECT_EQ(error.code, ErrorCode::kInvalidInput);
    EXPECT_TRUE(error.where.ends_with("tour.json"));
  }
}

constexpr const char* kScans =
    R"({"format":"homeward-scans","version":1,"angle_min_rad":-1.5,"angle_step_rad":0.5,"range_max_m":8,)"
    R"("robot_from_scan":{"x_m":0.3,"y_m":0,"theta_rad":0.1}})";

TEST(TourFolder, ReadsSweepsWithTheirGeometry) {
  const Tour tour;
  tour.folder.put("tour/scans.json", kScans);
  tour.folder.put("tour/scans.csv", "filename,r0,r1,r2\r\nc.jpeg,1.5,,8.000\na.PNG,0,2,3\nother.jpg,1,1,1\n");
  const auto opened = tour.open();
  ASSERT_TRUE(opened) << opened.error().message << opened.error().where;
  ASSERT_TRUE(opened->images()[2].sweep);
  const RangeSweep& sweep = *opened->images()[2].sweep;
  ASSERT_EQ(sweep.ranges_m.size(), 3U);
  EXPECT_FLOAT_EQ(sweep.ranges_m[0], 1.5F);
  EXPECT_FALSE(std::isfinite(sweep.ranges_m[1]));
  EXPECT_FLOAT_EQ(sweep.ranges_m[2], 8.0F);
  EXPECT_DOUBLE_EQ(sweep.angle_min_rad, -1.5);
  EXPECT_DOUBLE_EQ(sweep.angle_step_rad, 0.5);
  EXPECT_DOUBLE_EQ(sweep.range_max_m, 8.0);
  EXPECT_DOUBLE_EQ(sweep.robot_from_scan.x_m, 0.3);
  EXPECT_TRUE(opened->images()[0].sweep);
  EXPECT_FALSE(opened->images()[1].sweep);
}

TEST(TourFolder, LeavesSweepsWhoseRaysPointNobodyKnowsWhere) {
  const Tour tour;
  tour.folder.put("tour/scans.csv", "filename,r0\na.PNG,1\n");
  const auto opened = tour.open();
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_FALSE(opened->images()[0].sweep);
}

TEST(TourFolder, NamesLineAndColumnOfAWrongSweep) {
  const auto error_of = [](const std::string& text, const char* about = kScans) {
    const Tour tour;
    tour.folder.put("tour/scans.json", about);
    tour.folder.put("tour/scans.csv", text);
    const auto opened = tour.open();
    EXPECT_FALSE(opened) << text;
    return opened ? Error{} : opened.error();
  };
  for (const char* text : {"", "filename\n", "filename,r1\n", "name,r0\na.PNG,1\n"}) {
    EXPECT_TRUE(error_of(text).where.ends_with("scans.csv:1")) << text;
  }
  EXPECT_TRUE(error_of("filename,r0,r1\na.PNG,1,1\nb.png,1\n").where.ends_with("scans.csv:3"));
  EXPECT_TRUE(error_of("filename,r0\n,1\n").where.ends_with("scans.csv:2"));
  for (const char* cell : {"-1", "nan", "inf", "far", "1 ", "1e99"}) {
    const Error error = error_of("filename,r0,r1\na.PNG,1," + std::string(cell) + "\n");
    EXPECT_EQ(error.code, ErrorCode::kInvalidInput) << cell;
    EXPECT_TRUE(error.where.ends_with("scans.csv:2")) << cell;
    EXPECT_NE(error.message.find("Column r1"), std::string::npos) << error.message;
  }
  EXPECT_NE(error_of("filename,r0\na.PNG,1\na.PNG,2\n").message.find("already"), std::string::npos);
  EXPECT_NE(error_of("filename,r0\na.PNG,1\n", "{}").where.find("scans.json"), std::string::npos);
  std::string header = "filename";
  for (int i = 0; i <= 10'000; ++i) header += ",r" + std::to_string(i);
  EXPECT_EQ(error_of(header + "\n").code, ErrorCode::kTooLarge);
}

TEST(TourFolder, SaysWhenThereIsNothing) {
  const ScratchFolder folder;
  EXPECT_EQ(TourFolder::open(folder.path() / "none").error().code, ErrorCode::kNotFound);
  folder.put("readme.txt", "x");
  const auto empty = TourFolder::open(folder.path());
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::kEmptyInput);
  EXPECT_EQ(empty.error().where, folder.path().string());
}

}  // namespace
}  // namespace homeward::files::tour_folder_test
