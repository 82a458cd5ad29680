// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "camera/camera.hpp"
#include "core/result.hpp"
#include "geometry/two_view.hpp"
#include "repeat/known_structure.hpp"
#include "repeat/taught_path.hpp"
#include "repeat/teach_config.hpp"
#include "repeat/wide_match.hpp"
#include "tracking/feature_tracker.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::repeat {

/// A picture as it was made ready, with its number among those that were shown.
struct NumberedPicture {
  int number = 0;
  tracking::ImagePyramid pyramid;
};

/// What of a key image was found in a later picture.
struct SubrangeView {
  std::vector<tracking::TrackedFeature> features;  // of the key image's, in their order; the lost ones stay lost
  int tracked = 0;
  std::vector<int> paired;                            // features that the geometry was asked about, rising
  std::optional<geometry::TwoViewEstimate> geometry;  // its inliers are indices into `paired`
  int common = 0;                                     // inliers that are in the arc before, too
  [[nodiscard]] int agreeing() const { return geometry ? static_cast<int>(geometry->inliers.size()) : 0; }
};

/// A feature in both key images of an arc.
struct SeenTwice {
  int feature = 0;
  Eigen::Vector2d from_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_px = Eigen::Vector2d::Zero();
};

/// The motion from one view to another, both seen from one key image; nothing where their features do not tell how long
/// one way is over the other.
std::optional<geometry::ViewMotion> motion_between(const SubrangeView& one, const SubrangeView& other);

/// An arc of a two-view geometry, without its matches, and one of those: of an inlier, its rays and how it is seen in
/// the first key image. `spread_px`: of the geometry.
Arc arc_of(const geometry::TwoViewEstimate& geometry, int from, ArcEnd ended_by);
ArcMatch match_of(const SeenTwice& where, const geometry::SeenPoint& from, const geometry::MeetingRays& rays,
                  double spread_px);

/// A key image and the pictures that follow it: its features are tracked against how they look in it (Segvic et al.
/// 2007, §2.1). A value; copies are independent.
class Subrange {
 public:
  /// A key image with `carried` (features of the arc that ends in it, where they are in it) and new corners beside
  /// them, numbered on from `next_feature`. Errors: those of harris_corners and of the tracker's configuration.
  static Result<Subrange> begin(NumberedPicture key, std::span<const KeyFeature> carried, int next_feature,
                                std::shared_ptr<const camera::Camera> camera, const TeachConfig& config);

  [[nodiscard]] const NumberedPicture& key() const { return key_; }
  [[nodiscard]] const std::vector<KeyFeature>& features() const { return features_; }
  [[nodiscard]] int next_feature() const { return next_feature_; }
  [[nodiscard]] int carried() const { return carried_; }

  /// A picture as it is seen from the key image, features looked for where the latest kept view has them, turned by
  /// what shifts the middle of the picture by `shift_px`.
  [[nodiscard]] SubrangeView look(const NumberedPicture& picture, const TeachConfig& config,
                                  const Eigen::Vector2d& shift_px = Eigen::Vector2d::Zero()) const;
  /// The same with features looked for where `guess` says of where the latest kept view has them.
  [[nodiscard]] SubrangeView look_where(const NumberedPicture& picture, const TeachConfig& config,
                                        const GuessPlace& guess) const;
  /// Takes more features of the key image, numbered on, where none is within the corners' spacing.
  void add(std::span<const Eigen::Vector2d> pixels_px, const TeachConfig& config);
  /// Takes what the arc that ends in the key image knows of its points: it helps to tell the motion to later views.
  void know(const Arc& before) { known_ = KnownStructure::of(before); }
  /// Takes a motion that the first look may begin at.
  void expect(const std::optional<geometry::ViewMotion>& motion) { expected_ = motion; }
  /// Goes on from a view; what is lost in it is not looked for again.
  void keep(SubrangeView view) { latest_ = std::move(view); }
  /// None before the second picture of the subrange was kept.
  [[nodiscard]] const std::optional<SubrangeView>& latest() const { return latest_; }

  /// The arc to the latest view, from key image `from`. Precondition: there is one, with a geometry.
  [[nodiscard]] Arc arc(int from, ArcEnd ended_by) const;
  /// The arc's features where they are in the latest view. Precondition: the same.
  [[nodiscard]] std::vector<KeyFeature> agreeing_in_latest() const;

 private:
  Subrange(NumberedPicture key, tracking::FeatureTracker tracker, std::shared_ptr<const camera::Camera> camera)
      : key_(std::move(key)), tracker_(std::move(tracker)), camera_(std::move(camera)) {}
  void take(std::span<const KeyFeature> features);
  [[nodiscard]] geometry::MotionExpectation expectation(std::span<const geometry::PointPair> pairs,
                                                        std::span<const int> paired, const TeachConfig& config) const;

  NumberedPicture key_;
  tracking::FeatureTracker tracker_;
  std::shared_ptr<const camera::Camera> camera_;
  std::vector<KeyFeature> features_;       // as many as the tracker has references, in their order
  std::vector<geometry::SeenPoint> seen_;  // the same in the key image
  int carried_ = 0;                        // the first so many are in the arc before, too
  int next_feature_ = 0;
  KnownStructure known_;
  std::optional<geometry::ViewMotion> expected_;
  std::optional<SubrangeView> latest_;
};

}  // namespace homeward::repeat
