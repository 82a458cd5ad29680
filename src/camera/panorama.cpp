// SPDX-License-Identifier: Apache-2.0
#include "camera/panorama.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/angles.hpp"

namespace homeward::camera {

int PanoramaGeometry::height_px() const {
  return static_cast<int>(std::lround((elevation_max_rad - elevation_min_rad) * width_px / (2.0 * kPi)));
}

Eigen::Vector3d PanoramaGeometry::bearing(const Eigen::Vector2d& pixel_px) const {
  const double azimuth_rad = -2.0 * kPi * ((pixel_px.x() + 0.5) / width_px - 0.5);
  const double elevation_rad =
      elevation_max_rad - (pixel_px.y() + 0.5) / height_px() * (elevation_max_rad - elevation_min_rad);
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

Eigen::Vector2d PanoramaGeometry::pixel(const Eigen::Vector3d& bearing_in_robot) const {
  const double azimuth_rad = std::atan2(bearing_in_robot.y(), bearing_in_robot.x());
  const double elevation_rad = std::atan2(bearing_in_robot.z(), std::hypot(bearing_in_robot.x(), bearing_in_robot.y()));
  double u_px = (0.5 - azimuth_rad / (2.0 * kPi)) * width_px - 0.5;
  if (u_px >= width_px - 0.5) u_px -= width_px;
  const double v_px = (elevation_max_rad - elevation_rad) / (elevation_max_rad - elevation_min_rad) * height_px() - 0.5;
  return {u_px, v_px};
}

struct PanoramaUnwrapper::Tables {
  PanoramaGeometry geometry;
  int camera_width_px = 0;
  int camera_height_px = 0;
  bool wraps = false;  // the picture's own columns wrap
  cv::Mat map_fixed;   // where each panorama pixel lies in the picture, in cv::remap's fixed-point form
  cv::Mat map_weights;
  std::vector<std::uint8_t> valid;
};

PanoramaUnwrapper::PanoramaUnwrapper(const Camera& camera, const PanoramaGeometry& geometry) {
  auto tables = std::make_unique<Tables>();
  const CameraConfig& config = camera.config();
  tables->geometry = geometry;
  tables->camera_width_px = config.width_px;
  tables->camera_height_px = config.height_px;
  tables->wraps = std::holds_alternative<Equirectangular>(config.model);
  const int height_px = geometry.height_px();
  cv::Mat where(height_px, geometry.width_px, CV_32FC2);
  tables->valid.assign(static_cast<std::size_t>(height_px) * static_cast<std::size_t>(geometry.width_px), 0);
  for (int v = 0; v < height_px; ++v) {
    for (int u = 0; u < geometry.width_px; ++u) {
      const auto pixel_px = camera.pixel(geometry.bearing({u, v}));
      // Outside every picture: cv::remap then paints black.
      where.at<cv::Vec2f>(v, u) = cv::Vec2f(-10.0F, -10.0F);
      if (!pixel_px) continue;
      where.at<cv::Vec2f>(v, u) = cv::Vec2f(static_cast<float>(pixel_px->x()), static_cast<float>(pixel_px->y()));
      tables->valid[static_cast<std::size_t>(v) * static_cast<std::size_t>(geometry.width_px) +
                    static_cast<std::size_t>(u)] = 1;
    }
  }
  if (tables->wraps) {
    // One column of either side is repeated on the other before remapping, so that the seam interpolates.
    for (auto& pixel : cv::Mat_<cv::Vec2f>(where)) pixel[0] += 1.0F;
  }
  cv::convertMaps(where, cv::Mat(), tables->map_fixed, tables->map_weights, CV_16SC2);
  tables_ = std::move(tables);
}

PanoramaUnwrapper::~PanoramaUnwrapper() = default;
PanoramaUnwrapper::PanoramaUnwrapper(PanoramaUnwrapper&&) noexcept = default;
PanoramaUnwrapper& PanoramaUnwrapper::operator=(PanoramaUnwrapper&&) noexcept = default;

Result<Panorama> PanoramaUnwrapper::unwrap(const Image& picture) const {
  if (picture.empty()) return fail(ErrorCode::kEmptyInput, "The picture has no pixels.");
  if (picture.width_px != tables_->camera_width_px || picture.height_px != tables_->camera_height_px) {
    return fail(ErrorCode::kWrongImageSize, "The picture has " + std::to_string(picture.width_px) + " x " +
                                                std::to_string(picture.height_px) + " pixels; its camera gives " +
                                                std::to_string(tables_->camera_width_px) + " x " +
                                                std::to_string(tables_->camera_height_px) + ".");
  }
  const auto pixels = static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
  if ((picture.channels != 1 && picture.channels != 3) ||
      picture.data.size() != pixels * static_cast<std::size_t>(picture.channels)) {
    return fail(ErrorCode::kInvalidInput, "The picture's pixels do not fit its size.");
  }
  Panorama panorama;
  panorama.geometry = tables_->geometry;
  panorama.rgb = Image(tables_->geometry.width_px, tables_->geometry.height_px(), 3);
  panorama.valid = tables_->valid;
  cv::Mat source(picture.height_px, picture.width_px, CV_8UC(picture.channels),
                 const_cast<std::uint8_t*>(picture.data.data()));  // cv::Mat has no read-only view
  if (picture.channels == 1) cv::cvtColor(source, source, cv::COLOR_GRAY2RGB);
  cv::Mat target(panorama.rgb.height_px, panorama.rgb.width_px, CV_8UC3, panorama.rgb.data.data());
  cv::Mat padded;
  if (tables_->wraps) cv::copyMakeBorder(source, padded, 0, 0, 1, 1, cv::BORDER_WRAP);
  cv::remap(tables_->wraps ? padded : source, target, tables_->map_fixed, tables_->map_weights, cv::INTER_LINEAR,
            cv::BORDER_CONSTANT);
  return panorama;
}

}  // namespace homeward::camera
