// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "camera/camera.hpp"
#include "geometry/seen_point.hpp"
#include "repeat/arc_pose.hpp"
#include "repeat/arc_surroundings.hpp"
#include "repeat/key_references.hpp"
#include "repeat/repeat_config.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::repeat {

/// A landmark around an arc, and where it is in the latest picture.
struct FollowedLandmark {
  struct Reference {
    std::size_t slot = 0;       // which of the key images' references
    std::size_t reference = 0;  // in its tracker
    double distance = 1.0;      // of the landmark from that key image, over that from the surroundings' first one
  };
  Landmark landmark;
  std::vector<Reference> references;  // at least one
  bool is_tracked = false;
  std::size_t by = 0;  // the reference that it is, or is to be, tracked by
  double scale = 1.0;  // against that one
  double gain = 1.0;   // contrast against that one, where it is tracked
  Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();
  geometry::SeenPoint seen;  // at pixel_px
};

/// Where a pixel of the picture before is looked for in the next one.
using PixelGuess = std::function<Eigen::Vector2d(const Eigen::Vector2d&)>;

/// The landmarks around an arc as they are found in one picture after another, each against how it looks in the key
/// image in which it is most nearly of the same size. A value; copies are independent and share references.
class LandmarkFollower {
 public:
  using References = std::vector<std::shared_ptr<const KeyReferences>>;

  explicit LandmarkFollower(std::shared_ptr<const camera::Camera> camera) : camera_(std::move(camera)) {}

  /// Goes over to other surroundings, seen from `pose`: landmarks that are in both, by their numbers, stay where they
  /// are tracked. `references`: of the surroundings' key images.
  void renew(const ArcSurroundings& around, const ArcPose& pose, References references);

  /// Looks for what is tracked where `guess` says, at the size that it has from `pose`. What is not found is lost.
  void follow(const tracking::ImagePyramid& picture, const ArcPose& pose, const PixelGuess& guess,
              const RepeatConfig& config);
  /// Looks for what is not tracked where it should be from `pose`, and takes what is found within `most_off_rad` of
  /// that. How many were found.
  int search(const tracking::ImagePyramid& picture, const ArcPose& pose, double most_off_rad,
             const RepeatConfig& config);
  void lose(std::size_t landmark) { landmarks_[landmark].is_tracked = false; }
  void lose_all();

  [[nodiscard]] const std::vector<FollowedLandmark>& landmarks() const { return landmarks_; }
  [[nodiscard]] int tracked() const;
  /// Indices of those that are tracked, rising.
  [[nodiscard]] std::vector<std::size_t> tracked_ones() const;
  /// How many should be seen in the picture from `pose`: where what is tracked has little contrast by little light,
  /// those alone that still show as much as this, (grey levels a pixel)^2.
  [[nodiscard]] int expected(const ArcPose& pose, double least_visible) const;
  /// Where a landmark is in a key image; null where that does not show it.
  [[nodiscard]] const geometry::SeenPoint* in_key(std::size_t landmark, int key) const;

 private:
  void choose_reference(FollowedLandmark& one, const ArcPose& pose, double turn_from) const;
  [[nodiscard]] double contrast() const;
  bool track(FollowedLandmark& one, const tracking::ImagePyramid& picture, const Eigen::Vector2d& at_px);

  std::shared_ptr<const camera::Camera> camera_;
  References references_;
  std::vector<FollowedLandmark> landmarks_;  // rising by feature
  std::size_t search_from_ = 0;              // where the next search begins, so that all have their turn
};

}  // namespace homeward::repeat
