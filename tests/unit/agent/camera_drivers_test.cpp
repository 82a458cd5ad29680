// SPDX-License-Identifier: Apache-2.0
// Drivers of robots that are only a camera: a folder, a video, a V4L2 device.
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <opencv2/videoio.hpp>

#include "agent/drivers/folder_driver.hpp"
#include "agent/drivers/v4l2_driver.hpp"
#include "agent/drivers/video_driver.hpp"
#include "imageio/decode.hpp"
#include "support/sample_cameras.hpp"
#include "support/scratch_folder.hpp"
#include "wire/camera_json.hpp"

namespace homeward::agent::camera_drivers_test {
namespace {

using homeward::testing::ScratchFolder;
using homeward::testing::sphere_camera;

constexpr int kWidth_px = 64;
constexpr int kHeight_px = 32;

void put_camera(const ScratchFolder& folder, int width_px = kWidth_px) {
  folder.put("camera.json", wire::camera_to_json(sphere_camera(width_px)).dump());
}

/// Each picture is of one grey, 20 brighter than the one before.
std::string put_video(const ScratchFolder& folder, int pictures, double rate) {
  const std::string file = (folder.path() / "walk.avi").string();
  cv::VideoWriter writer(file, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), rate, cv::Size(kWidth_px, kHeight_px));
  EXPECT_TRUE(writer.isOpened());
  for (int i = 0; i < pictures; ++i)
    writer.write(cv::Mat(kHeight_px, kWidth_px, CV_8UC3, cv::Scalar::all(20 + 20 * i)));
  return file;
}

int grey_of(const driving::TakenPicture& taken) {
  return (*taken.picture.at(kWidth_px / 2, kHeight_px / 2) - 20 + 10) / 20;
}

TEST(Videos, ArePlayedAtTheirOwnTimes) {
  const ScratchFolder folder;
  put_camera(folder);
  const auto driver = make_video_driver({put_video(folder, 6, 10.0), "", false});
  ASSERT_TRUE(driver) << driver.error().message;
  std::vector<driving::TakenPicture> all;
  while (true) {
    auto taken = (*driver)->next_picture({});
    ASSERT_TRUE(taken) << taken.error().message;
    if (!*taken) break;
    all.push_back(std::move(**taken));
  }
  ASSERT_GE(all.size(), 3U);  // a busy machine may leave some out, but neither the first nor the order
  EXPECT_EQ(grey_of(all.front()), 0);
  for (const driving::TakenPicture& taken : all) {
    EXPECT_NEAR(static_cast<double>(taken.t_ms - all.front().t_ms), 100.0 * grey_of(taken), 2.0);
    EXPECT_TRUE(taken.jpeg.empty());
  }
  EXPECT_FALSE((*driver)->read().scan) << "it must not be driven";
}

TEST(Videos, LeaveOutWhatThereWasNoTimeFor) {
  const ScratchFolder folder;
  put_camera(folder);
  const auto driver = make_video_driver({put_video(folder, 10, 10.0), "", false});
  ASSERT_TRUE(driver);
  ASSERT_TRUE((*driver)->next_picture({}));
  std::this_thread::sleep_for(std::chrono::milliseconds(450));
  const auto later = (*driver)->next_picture({});
  ASSERT_TRUE(later && *later);
  EXPECT_GE(grey_of(**later), 4);
}

TEST(Videos, BeginAgainWhenAsked) {
  const ScratchFolder folder;
  put_camera(folder);
  const auto driver = make_video_driver({put_video(folder, 2, 20.0), "", true});
  ASSERT_TRUE(driver);
  int firsts = 0;
  for (int i = 0; i < 6; ++i) {
    const auto taken = (*driver)->next_picture({});
    ASSERT_TRUE(taken && *taken);
    firsts += grey_of(**taken) == 0 ? 1 : 0;
  }
  EXPECT_GE(firsts, 3);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_FALSE(*(*driver)->next_picture(stop.get_token()));
}

TEST(Videos, AreRefusedWithWhatIsWrong) {
  const ScratchFolder folder;
  put_camera(folder, 128);
  EXPECT_EQ(make_video_driver({"/nowhere/a.avi", "", false}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(make_video_driver({put_video(folder, 2, 10.0), "", false}).error().code, ErrorCode::kWrongImageSize);
  const std::string text = folder.put("text.avi", "this is no video").string();
  EXPECT_EQ(make_video_driver({text, "", false}).error().code, ErrorCode::kUnsupportedFormat);
  EXPECT_EQ(make_video_driver({text, "/nowhere/camera.json", false}).error().code, ErrorCode::kNotFound);
}

TEST(Folders, GiveTheBytesOfJpegs) {
  const ScratchFolder folder;
  put_camera(folder);
  const auto jpeg = imageio::encode_jpeg(Image(kWidth_px, kHeight_px, 3), 90);
  const auto png = imageio::encode_png(Image(kWidth_px, kHeight_px, 3));
  folder.put("a.jpg", std::string(jpeg.begin(), jpeg.end()));
  folder.put("b.png", std::string(png.begin(), png.end()));
  const auto driver = make_folder_driver({folder.path().string(), "", 50.0, false});
  ASSERT_TRUE(driver);
  EXPECT_EQ((*(*driver)->next_picture({}))->jpeg, jpeg);
  EXPECT_TRUE((*(*driver)->next_picture({}))->jpeg.empty());
  EXPECT_FALSE(*(*driver)->next_picture({}));
}

TEST(V4l2Pictures, OfMjpegKeepTheirBytes) {
  const auto jpeg = imageio::encode_jpeg(Image(kWidth_px, kHeight_px, 3), 90);
  const auto taken = v4l2_picture(V4l2Format::kMjpeg, jpeg, kWidth_px, kHeight_px, 0, "cam");
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->jpeg, jpeg);
  EXPECT_EQ(taken->picture.width_px, kWidth_px);
  const std::span<const std::uint8_t> half(jpeg.data(), jpeg.size() / 2);
  EXPECT_EQ(v4l2_picture(V4l2Format::kMjpeg, half, kWidth_px, kHeight_px, 0, "cam").error().code,
            ErrorCode::kTruncatedImage);
  EXPECT_EQ(v4l2_picture(V4l2Format::kMjpeg, jpeg, 128, 64, 0, "cam").error().code, ErrorCode::kWrongImageSize);
}

TEST(V4l2Pictures, OfYuyvAreConvertedRowByRow) {
  // BT.601, 16..235: black, white, and pure red (Y 81, U 90, V 240); a row of four pixels and four bytes of padding.
  const std::vector<std::uint8_t> bytes = {16, 128, 16, 128, 235, 128, 235, 128, 1, 2, 3, 4,  //
                                           81, 90,  81, 240, 81,  90,  81,  240};
  const auto taken = v4l2_picture(V4l2Format::kYuyv, bytes, 4, 2, 12, "cam");
  ASSERT_TRUE(taken);
  const Image& picture = taken->picture;
  EXPECT_TRUE(taken->jpeg.empty());
  const auto near = [&](int u, int v, int r, int g, int b) {
    EXPECT_NEAR(picture.at(u, v)[0], r, 3);
    EXPECT_NEAR(picture.at(u, v)[1], g, 3);
    EXPECT_NEAR(picture.at(u, v)[2], b, 3);
  };
  near(0, 0, 0, 0, 0);
  near(3, 0, 255, 255, 255);
  near(0, 1, 255, 0, 0);
  near(3, 1, 255, 0, 0);
  const std::span<const std::uint8_t> cut(bytes.data(), bytes.size() - 1);
  EXPECT_EQ(v4l2_picture(V4l2Format::kYuyv, cut, 4, 2, 12, "cam").error().code, ErrorCode::kTruncatedImage);
  EXPECT_EQ(v4l2_picture(V4l2Format::kYuyv, {}, 4, 2, 12, "cam").error().code, ErrorCode::kTruncatedImage);
}

TEST(V4l2Devices, ThatAreNoneAreRefused) {
  const ScratchFolder folder;
  put_camera(folder);
  const std::string camera = (folder.path() / "camera.json").string();
  const auto missing = make_v4l2_driver({"/dev/video-that-is-not-there", camera, 10.0});
  EXPECT_EQ(missing.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(missing.error().where, "/dev/video-that-is-not-there");
  EXPECT_EQ(make_v4l2_driver({"/dev/null", camera, 10.0}).error().code, ErrorCode::kIo);
  EXPECT_EQ(make_v4l2_driver({"/dev/null", "/nowhere/camera.json", 10.0}).error().code, ErrorCode::kNotFound);
  EXPECT_EQ(make_v4l2_driver({"/dev/null", camera, 0.0}).error().code, ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::agent::camera_drivers_test
