// SPDX-License-Identifier: Apache-2.0
#include "agent/drivers/folder_driver.hpp"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <mutex>

#include "files/read_file.hpp"
#include "files/tour_folder.hpp"
#include "imageio/decode.hpp"

namespace homeward::agent {
namespace {

class FolderDriver final : public driving::Driver {
 public:
  FolderDriver(std::vector<std::filesystem::path> files, camera::CameraConfig camera, const FolderDriverConfig& config)
      : files_(std::move(files)),
        camera_(std::move(camera)),
        period_(
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / config.pictures_per_s))),
        repeat_(config.repeat) {}

  [[nodiscard]] const camera::CameraConfig& camera() const override { return camera_; }
  [[nodiscard]] driving::Body body() const override { return {}; }
  driving::Reading read() override { return {now_ms(), {}, 0.0, std::nullopt, std::nullopt}; }
  void command(const driving::Motion&) override {}

  Result<std::optional<driving::TakenPicture>> next_picture(std::stop_token stop) override {
    std::unique_lock lock(mutex_);
    pause_.wait_until(lock, stop, taken_ + period_, [] { return false; });
    if (next_ == files_.size() && repeat_) next_ = 0;
    if (stop.stop_requested() || next_ == files_.size()) return std::optional<driving::TakenPicture>();
    taken_ = Clock::now();
    const std::string name = files_[next_].string();
    const auto text = files::read_text(files_[next_++]);
    if (!text) return pass_on(text);
    std::vector<std::uint8_t> bytes(text->begin(), text->end());
    auto picture = imageio::decode(bytes, name);
    if (!picture) return pass_on(picture);
    const auto header = imageio::read_header(bytes);
    if (!header || header->format != imageio::ImageFormat::kJpeg) bytes.clear();
    return std::optional(driving::TakenPicture{now_ms(), std::move(*picture), {}, std::move(bytes)});
  }

 private:
  using Clock = std::chrono::steady_clock;
  static driving::Milliseconds now_ms() {
    return std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now().time_since_epoch()).count();
  }

  std::vector<std::filesystem::path> files_;
  camera::CameraConfig camera_;
  Clock::duration period_;
  bool repeat_;
  std::size_t next_ = 0;
  std::mutex mutex_;
  std::condition_variable_any pause_;
  Clock::time_point taken_ = Clock::now() - std::chrono::hours(1);
};

}  // namespace

Result<std::unique_ptr<driving::Driver>> make_folder_driver(const FolderDriverConfig& config) {
  if (!(config.pictures_per_s > 0.0 && config.pictures_per_s <= 60.0)) {
    return fail(ErrorCode::kInvalidInput, "The rate must lie between 0 and 60 pictures a second.", "--rate");
  }
  auto files = files::pictures_in(config.folder);
  if (!files) return pass_on(files);
  const std::filesystem::path beside = std::filesystem::path(config.folder) / "camera.json";
  auto camera = files::read_camera(config.camera.empty() ? beside : std::filesystem::path(config.camera));
  if (!camera) return pass_on(camera);
  return std::make_unique<FolderDriver>(std::move(*files), std::move(*camera), config);
}

}  // namespace homeward::agent
