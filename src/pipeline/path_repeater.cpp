// SPDX-License-Identifier: Apache-2.0
#include "pipeline/path_repeater.hpp"

#include <utility>

#include "camera/camera.hpp"
#include "core/index.hpp"
#include "imageio/decode.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::pipeline {
namespace {

Result<std::shared_ptr<const tracking::ImagePyramid>> key_picture(const map::MapPath& path, int key) {
  const auto picture = imageio::decode(path.pictures[at(key)], path.images[at(key)].str());
  if (!picture) return pass_on(picture);
  auto pyramid = tracking::ImagePyramid::build(*picture);
  if (!pyramid) return fail(pyramid.error().code, pyramid.error().message, path.images[at(key)].str());
  return std::make_shared<const tracking::ImagePyramid>(*std::move(pyramid));
}

/// That all of its key images can be seen, before anybody drives by them.
Status check_pictures(const map::MapPath& path, const camera::CameraConfig& camera) {
  for (int key = 0; at(key) < path.pictures.size(); ++key) {
    const auto picture = key_picture(path, key);
    if (!picture) return pass_on(picture);
    if ((*picture)->width_px() != camera.width_px || (*picture)->height_px() != camera.height_px) {
      return fail(ErrorCode::kWrongImageSize, "A key image of the path does not have the size of the camera's.",
                  path.images[at(key)].str());
    }
  }
  return {};
}

/// Whether pixels mean the same to two cameras: directions of the robot, over the whole picture.
bool see_alike(const camera::Camera& a, const camera::Camera& b) {
  constexpr int kSteps = 8;
  constexpr double kOff = 0.003;  // chord of an angle: a pixel of 320 for 70 degrees
  const camera::CameraConfig& config = a.config();
  if (config.width_px != b.config().width_px || config.height_px != b.config().height_px) return false;
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      const Eigen::Vector2d pixel_px(column * (config.width_px - 1.0) / kSteps,
                                     row * (config.height_px - 1.0) / kSteps);
      const auto by_a = a.bearing(pixel_px);
      const auto by_b = b.bearing(pixel_px);
      if (by_a.has_value() != by_b.has_value()) return false;
      if (by_a && (*by_a - *by_b).norm() > kOff) return false;
    }
  }
  return true;
}

}  // namespace

Result<PathRepeater> PathRepeater::create(std::shared_ptr<const map::TopologicalMap> map,
                                          const camera::CameraConfig& camera, const repeat::RepeatConfig& config) {
  if (!map || !map->path) {
    return fail(ErrorCode::kInvalidInput, "This map was not taught as a path (homeward teach): it has no key images.");
  }
  auto model = camera::Camera::create(camera);
  if (!model) return pass_on(model);
  const auto taught_with = camera::Camera::create(map->camera);
  if (!taught_with) return pass_on(taught_with);
  if (!see_alike(**model, **taught_with)) {
    return fail(
        ErrorCode::kInvalidInput,
        "The path was taught with another camera, or with one that was fixed otherwise: it is repeated with the "
        "same one.",
        "camera");
  }
  const std::shared_ptr<const map::MapPath> path = map->path;
  if (const Status seen = check_pictures(*path, camera); !seen) return pass_on(seen);
  const auto pictures = [path](int key) -> std::shared_ptr<const tracking::ImagePyramid> {
    if (key < 0 || at(key) >= path->pictures.size()) return nullptr;
    const auto picture = key_picture(*path, key);
    return picture ? *picture : nullptr;
  };
  auto repeater = repeat::Repeater::create(config, std::shared_ptr<const map::TaughtPath>(path, &path->taught),
                                           pictures, *std::move(model));
  if (!repeater) return pass_on(repeater);
  return PathRepeater(std::move(map), *std::move(repeater));
}

Result<repeat::Repeated> PathRepeater::step(const Image& picture) {
  auto pyramid = tracking::ImagePyramid::build(picture);
  if (!pyramid) return pass_on(pyramid);
  return repeater_.step(std::make_shared<const tracking::ImagePyramid>(*std::move(pyramid)));
}

}  // namespace homeward::pipeline
