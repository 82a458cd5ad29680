// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "camera/camera.hpp"
#include "geometry/two_view.hpp"
#include "repeat/key_gallery.hpp"

namespace homeward::repeat {

/// What two pictures have in common, found without any expectation (wide baseline), and the motion that explains it.
struct WideMatch {
  geometry::TwoViewEstimate estimate;      // `current` is the first picture, `target` the second
  std::vector<Eigen::Vector2d> first_px;   // of its inliers
  std::vector<Eigen::Vector2d> second_px;  // as many
  int compared = 0;                        // pairs that looked alike
  [[nodiscard]] int agreeing() const { return static_cast<int>(first_px.size()); }
};

/// Mutual nearest features of two pictures, where enough of them agree with one motion. Nothing where they do not.
std::optional<WideMatch> wide_match(const DescribedPicture& first, const DescribedPicture& second,
                                    const camera::Camera& camera, const RecognitionConfig& config,
                                    const geometry::TwoViewConfig& geometry, std::uint64_t seed);

/// The same seen from the second picture.
WideMatch reversed(const WideMatch& match);

/// Where a feature is looked for, and at which size; not a number: nowhere in the picture.
struct PlaceGuess {
  Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();
  double scale = 1.0;
};
using GuessPlace = std::function<PlaceGuess(const Eigen::Vector2d& pixel_px, double scale)>;

/// Where other pixels of the first picture lie in the second: turned as the match says, and shifted as those matched
/// pixels are that are nearest to them in the first. Keeps references to both.
GuessPlace guess_by(const WideMatch& match, const camera::Camera& camera);

/// By how much two motions differ in their turns.
double turn_between_rad(const geometry::ViewMotion& one, const geometry::ViewMotion& other);

}  // namespace homeward::repeat
