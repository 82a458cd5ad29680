// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/video_driver.hpp"

#include <chrono>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "files/read_file.hpp"

namespace homeward::agent {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

driving::Milliseconds ms_of(Clock::time_point time) {
  return std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
}

Image image_of(const cv::Mat& bgr) {
  Image image(bgr.cols, bgr.rows, 3);
  cv::Mat rgb(bgr.rows, bgr.cols, CV_8UC3, image.data.data());
  cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
  return image;
}

class VideoDriver final : public driving::Driver {
 public:
  VideoDriver(const cv::VideoCapture& video, camera::CameraConfig camera, VideoDriverConfig config)
      : video_(video), camera_(std::move(camera)), config_(std::move(config)) {
    const double rate = video_.get(cv::CAP_PROP_FPS);
    if (rate > 0.1 && rate <= 1000.0) usual_gap_s_ = 1.0 / rate;
  }

  [[nodiscard]] const camera::CameraConfig& camera() const override { return camera_; }
  [[nodiscard]] driving::Body body() const override { return {}; }
  driving::Reading read() override { return {ms_of(Clock::now()), {}, 0.0, std::nullopt, std::nullopt}; }
  void command(const driving::Motion&) override {}

  Result<std::optional<driving::TakenPicture>> next_picture(std::stop_token stop) override {
    if (!begun_) begin();
    const double now_s = Seconds(Clock::now() - *begun_).count();
    if (!advance()) return after_the_last(stop);
    // What should have been shown before is left out, down to the newest; the first one never is.
    while (shown_ > 0 && time_s_ + usual_gap_s_ < now_s) {
      if (!advance()) return after_the_last(stop);
    }
    std::unique_lock lock(mutex_);
    const auto due = *begun_ + std::chrono::duration_cast<Clock::duration>(Seconds(time_s_));
    pause_.wait_until(lock, stop, due, [] { return false; });
    if (stop.stop_requested()) return std::optional<driving::TakenPicture>();
    cv::Mat picture;
    if (!video_.retrieve(picture) || picture.type() != CV_8UC3 || picture.cols != camera_.width_px ||
        picture.rows != camera_.height_px) {
      return fail(ErrorCode::kIo, "A picture of the video cannot be read.", config_.file);
    }
    ++shown_;
    return std::optional(driving::TakenPicture{ms_of(due), image_of(picture), {}, {}});
  }

 private:
  void begin() {
    begun_ = Clock::now();
    time_s_ = -usual_gap_s_;
    first_s_.reset();
    shown_ = 0;
  }

  /// Goes on by one picture; false after the last.
  bool advance() {
    if (!video_.grab()) return false;
    const double told_s = 0.001 * video_.get(cv::CAP_PROP_POS_MSEC);
    if (!first_s_) first_s_ = told_s;
    // A container that tells no times, or whose times do not rise: evenly.
    const double since_first_s = told_s - *first_s_;
    time_s_ =
        since_first_s > time_s_ && since_first_s < time_s_ + kLongestGap_s ? since_first_s : time_s_ + usual_gap_s_;
    return true;
  }

  Result<std::optional<driving::TakenPicture>> after_the_last(const std::stop_token& stop) {
    if (!config_.repeat || shown_ == 0) return std::optional<driving::TakenPicture>();
    if (!video_.open(config_.file, cv::CAP_FFMPEG))
      return fail(ErrorCode::kIo, "The video cannot be read again.", config_.file);
    {
      // The last picture is shown as long as the others.
      std::unique_lock lock(mutex_);
      const auto due = *begun_ + std::chrono::duration_cast<Clock::duration>(Seconds(time_s_ + usual_gap_s_));
      pause_.wait_until(lock, stop, due, [] { return false; });
    }
    begun_.reset();
    return next_picture(stop);
  }

  static constexpr double kLongestGap_s = 60.0;

  cv::VideoCapture video_;
  camera::CameraConfig camera_;
  VideoDriverConfig config_;
  double usual_gap_s_ = 0.1;
  std::optional<Clock::time_point> begun_;
  std::optional<double> first_s_;
  double time_s_ = 0.0;  // of the picture gone on to, since the first
  std::size_t shown_ = 0;
  std::mutex mutex_;
  std::condition_variable_any pause_;
};

}  // namespace

Result<std::unique_ptr<driving::Driver>> make_video_driver(const VideoDriverConfig& config) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(config.file, ignored)) {
    return fail(ErrorCode::kNotFound, "There is no such file.", config.file);
  }
  const std::filesystem::path beside = std::filesystem::path(config.file).parent_path() / "camera.json";
  auto camera = files::read_camera(config.camera.empty() ? beside : std::filesystem::path(config.camera));
  if (!camera) return pass_on(camera);
  cv::VideoCapture video;
  try {
    if (!video.open(config.file, cv::CAP_FFMPEG)) {
      return fail(ErrorCode::kUnsupportedFormat, "This is no video that can be read.", config.file);
    }
  } catch (const cv::Exception& broken) {
    return fail(ErrorCode::kUnsupportedFormat, "This is no video that can be read: " + broken.msg, config.file);
  }
  const int width_px = static_cast<int>(video.get(cv::CAP_PROP_FRAME_WIDTH));
  const int height_px = static_cast<int>(video.get(cv::CAP_PROP_FRAME_HEIGHT));
  if (width_px != camera->width_px || height_px != camera->height_px) {
    return fail(ErrorCode::kWrongImageSize,
                "The video has " + std::to_string(width_px) + " x " + std::to_string(height_px) +
                    " pixels, its camera.json says " + std::to_string(camera->width_px) + " x " +
                    std::to_string(camera->height_px) + ".",
                config.file);
  }
  return std::make_unique<VideoDriver>(video, std::move(*camera), config);
}

}  // namespace homeward::agent
