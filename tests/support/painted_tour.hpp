// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/tour.hpp"
#include "support/painted_room.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::testing {

/// A tour whose pictures are in memory.
class MemoryTour final : public TourSource {
 public:
  explicit MemoryTour(std::string name) : name_(std::move(name)) {}

  void add(Image picture) {
    images_.push_back({ImageId(name_ + "/" + std::to_string(1000 + pictures_.size()) + ".png"), std::nullopt, {}});
    pictures_.emplace_back(std::move(picture));
  }
  void add_broken(ErrorCode code) {
    add({});
    pictures_.back() = fail(code, "The picture is broken.", images_.back().id.str());
  }
  void mark(std::string image, std::string label) { marks_.push_back({std::move(image), std::move(label)}); }

  [[nodiscard]] const std::vector<TourImage>& images() const override { return images_; }
  [[nodiscard]] const std::vector<TourMark>& marks() const override { return marks_; }
  [[nodiscard]] Result<Image> read(std::size_t index) const override { return pictures_[index]; }

 private:
  std::string name_;
  std::vector<TourImage> images_;
  std::vector<TourMark> marks_;
  std::vector<Result<Image>> pictures_;
};

/// A long painted corridor, and the pictures of a drive through it, `step_m` apart, forth or (`back`) the other way.
inline PaintedRoom painted_corridor() { return {8.0, 1.6, 1.4, -1.2, 3}; }

inline void drive(MemoryTour& tour, const camera::Camera& camera, int count, double step_m, bool back = false) {
  for (int i = 0; i < count; ++i) {
    const double x_m = -0.5 * step_m * (count - 1) + step_m * (back ? count - 1 - i : i);
    tour.add(painted_picture(painted_corridor(), {x_m, back ? 0.1 : 0.0, back ? kPi : 0.0}, camera));
  }
}

/// A small camera that sees all around.
inline const camera::CameraConfig& camera_config() {
  static const camera::CameraConfig config = sphere_camera(512);
  return config;
}

/// The camera itself.
inline const camera::Camera& the_camera() {
  static const auto camera = camera::Camera::create(camera_config()).value();
  return *camera;
}

}  // namespace homeward::testing
