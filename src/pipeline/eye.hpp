// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "camera/camera.hpp"
#include "camera/panorama.hpp"
#include "core/image.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"

namespace homeward::pipeline {

/// One camera with its panorama and feature settings: picture in, appearance out. Thread-safe once made.
class Eye {
 public:
  static Result<Eye> create(const camera::CameraConfig& camera, const features::FeatureConfig& features);
  ~Eye();
  Eye(Eye&&) noexcept;
  Eye& operator=(Eye&&) noexcept;

  /// Errors: those of PanoramaUnwrapper::unwrap. A picture without texture gives an appearance with few or no features.
  [[nodiscard]] Result<features::Appearance> look(const Image& picture) const;
  /// The same of a picture that is unwrapped already. Precondition: by this eye.
  [[nodiscard]] features::Appearance look(const camera::Panorama& panorama) const;
  [[nodiscard]] Result<camera::Panorama> unwrap(const Image& picture) const;
  [[nodiscard]] const camera::Camera& camera() const;
  [[nodiscard]] const features::FeatureConfig& feature_config() const;

 private:
  struct Parts;
  Eye();
  std::unique_ptr<Parts> parts_;
};

/// The settings of features suited to a camera: panorama rows that the camera can see.
features::FeatureConfig suited_feature_config(const camera::Camera& camera);

}  // namespace homeward::pipeline
