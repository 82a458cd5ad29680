// SPDX-License-Identifier: Apache-2.0
#include "pipeline/eye.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/angles.hpp"
#include "core/median.hpp"
#include "features/descriptor_code.hpp"
#include "features/extract.hpp"

namespace homeward::pipeline {

struct Eye::Parts {
  std::shared_ptr<const camera::Camera> camera;
  features::FeatureConfig feature_config;
  camera::PanoramaUnwrapper unwrapper;
};

Eye::Eye() = default;
Eye::~Eye() = default;
Eye::Eye(Eye&&) noexcept = default;
Eye& Eye::operator=(Eye&&) noexcept = default;

Result<Eye> Eye::create(const camera::CameraConfig& camera, const features::FeatureConfig& features) {
  auto made = camera::Camera::create(camera);
  if (!made) return pass_on(made);
  const camera::PanoramaGeometry geometry{features.panorama_width_px, features.elevation_max_rad,
                                          features.elevation_min_rad};
  constexpr int kLeastHeight_px = 16;
  constexpr int kMaxWidth_px = 8192;
  if (geometry.width_px < kLeastHeight_px || geometry.width_px > kMaxWidth_px ||
      geometry.height_px() < kLeastHeight_px || geometry.height_px() > geometry.width_px) {
    return fail(ErrorCode::kInvalidInput, "The feature configuration gives a panorama of no useful size.",
                "feature_config");
  }
  constexpr int kMostFeatures = 20'000;
  constexpr int kMostWindows = 4;
  const bool sensible = features.max_sift >= 0 && features.max_sift <= kMostFeatures && features.max_columns >= 0 &&
                        features.max_columns <= kMostFeatures && features.sift_code_length >= 1 &&
                        features.sift_code_length <= features::kMaxSiftCodeLength && features.sift_windows >= 1 &&
                        features.sift_windows <= kMostWindows;
  if (!sensible) {
    return fail(ErrorCode::kInvalidInput,
                "The feature configuration asks for a number of features or a length of descriptors that cannot be.",
                "feature_config");
  }
  Eye eye;
  eye.parts_ = std::make_unique<Parts>(Parts{*made, features, camera::PanoramaUnwrapper(**made, geometry)});
  return eye;
}

Result<features::Appearance> Eye::look(const Image& picture) const {
  const auto panorama = parts_->unwrapper.unwrap(picture);
  if (!panorama) return pass_on(panorama);
  return features::extract(*panorama, parts_->feature_config);
}

features::Appearance Eye::look(const camera::Panorama& panorama) const {
  return features::extract(panorama, parts_->feature_config);
}

Result<camera::Panorama> Eye::unwrap(const Image& picture) const { return parts_->unwrapper.unwrap(picture); }

const camera::Camera& Eye::camera() const { return *parts_->camera; }

const features::FeatureConfig& Eye::feature_config() const { return parts_->feature_config; }

namespace {

/// A camera that sees less than half of the horizon keeps its own resolution, for little of the panorama has to be
/// searched; one that sees more has the usual width.
int suited_width_px(const camera::Camera& camera, int usual_px) {
  constexpr int kAzimuths = 1440;
  constexpr double kStep_rad = 2.0 * kPi / kAzimuths;
  std::vector<double> per_rad;
  std::optional<Eigen::Vector2d> before;
  for (int i = 0; i < kAzimuths; ++i) {
    const auto here = camera.pixel({std::cos(i * kStep_rad), std::sin(i * kStep_rad), 0.0});
    if (here && before) per_rad.push_back((*here - *before).norm() / kStep_rad);
    before = here;
  }
  if (per_rad.empty() || per_rad.size() > kAzimuths / 2) return usual_px;
  constexpr double kNarrowest_px = 1024.0;  // finer than a coarse picture's own: small blobs are found as well
  constexpr double kWidest_px = 4096.0;
  const double width_px = 2.0 * kPi * median(std::move(per_rad));
  constexpr double kMultiple = 64.0;
  return static_cast<int>(std::round(std::clamp(width_px, kNarrowest_px, kWidest_px) / kMultiple) * kMultiple);
}

}  // namespace

features::FeatureConfig suited_feature_config(const camera::Camera& camera) {
  // The rows that the camera sees at some azimuth, between the sky straight above and the robot's own feet.
  constexpr double kHighest_deg = 60.0;
  constexpr double kLowest_deg = -55.0;
  constexpr double kStep_deg = 0.5;
  constexpr int kAzimuths = 72;
  double highest_deg = -90.0;
  double lowest_deg = 90.0;
  for (double elevation_deg = kLowest_deg; elevation_deg <= kHighest_deg; elevation_deg += kStep_deg) {
    bool seen = false;
    for (int i = 0; i < kAzimuths && !seen; ++i) {
      const double azimuth_rad = 2.0 * kPi * i / kAzimuths;
      const double elevation_rad = radians(elevation_deg);
      seen = camera
                 .pixel({std::cos(elevation_rad) * std::cos(azimuth_rad),
                         std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad)})
                 .has_value();
    }
    if (!seen) continue;
    highest_deg = std::max(highest_deg, elevation_deg);
    lowest_deg = std::min(lowest_deg, elevation_deg);
  }
  features::FeatureConfig config;
  config.panorama_width_px = suited_width_px(camera, config.panorama_width_px);
  if (highest_deg > lowest_deg) {
    config.elevation_max_rad = radians(highest_deg);
    config.elevation_min_rad = radians(lowest_deg);
  }
  return config;
}

}  // namespace homeward::pipeline
