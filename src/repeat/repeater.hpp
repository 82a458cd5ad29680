// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "camera/camera.hpp"
#include "core/result.hpp"
#include "repeat/arc_pose.hpp"
#include "repeat/arc_surroundings.hpp"
#include "repeat/key_gallery.hpp"
#include "repeat/key_pictures.hpp"
#include "repeat/key_references.hpp"
#include "repeat/key_view.hpp"
#include "repeat/landmark_follower.hpp"
#include "repeat/repeat_config.hpp"
#include "repeat/taught_path.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::repeat {

/// Why it is not known where on the path a picture was taken.
enum class LostReason {
  kNone,            // it is known
  kNotBegun,        // no arc was named yet
  kTooFewFeatures,  // too few of the arc's features are seen
  kNoGeometry,      // no one place explains what was tracked
  kErrorTooLarge,   // what was found is too far from any one place
};

/// What a picture says. Angles are counter-clockwise, left positive. All but the counts mean nothing while lost.
struct Repeated {
  LostReason lost = LostReason::kNotBegun;
  int arc = 0;       // index in the path; while lost, the last one
  int from_key = 0;  // indices of its key images
  int to_key = 0;
  int tracked = 0;            // features of the arc and those beside it that are seen where they belong
  int expected = 0;           // how many should be in the picture
  int predicted = 0;          // of those tracked, found now where they were predicted
  int recovered = 0;          // of those tracked, by matching without prediction
  double progress = 0.0;      // along the arc, 0 at its first key image, 1 at the second
  double lateral = 0.0;       // beside the line from key image to key image, over its length; 0 without a baseline
  double steering_rad = 0.0;  // by which to turn so that features move to where the next key image has them
  std::optional<double> bearing_to_next_rad;  // of the next key image; none without a baseline
  double error_px = 0.0;                      // reprojection error
  double confidence = 0.0;                    // 0 to 1: share of what was tracked that agrees, less where it is little
  bool structure_agrees = true;  // false: what is seen does not fit the arc's geometry well; beside the path, what
                                 // is said of the way may be far off
  int transitions = 0;           // arcs gone on by (forwards positive) with this picture
  bool at_end = false;           // past the last key image of the path or of its piece; never where it is closed
  [[nodiscard]] bool is_lost() const { return lost != LostReason::kNone; }
};

/// Follows a path that was shown once, with the same camera: features of the actual arc and those beside it are tracked
/// against how they look in its key images; the place that they are seen from predicts those that are not tracked,
/// and says when the next key image is passed (Segvic et al. 2007, §2.2). A closed path goes on round and round. The
/// cost of a picture does not depend on the length of the path. A value; copies are independent and share the path.
/// Deterministic by the configuration's seed.
class Repeater {
 public:
  /// Describes all key images where the configuration has recognition, some 20 ms each.
  /// Errors: kInvalidInput (a problem of the configuration; no path, camera or pictures; a path without arcs),
  /// kNotFound (a key image has no picture).
  static Result<Repeater> create(const RepeatConfig& config, std::shared_ptr<const TaughtPath> path,
                                 KeyPictures pictures, std::shared_ptr<const camera::Camera> camera);

  /// Takes the camera to be near the first key image of an arc. Without, the first pictures are recognised anywhere on
  /// the path, where the configuration has recognition. Errors: kNotFound (no such arc, or a key image around
  /// it has no picture).
  Status begin(int arc);

  /// What the next picture says. Errors: kWrongImageSize, and nothing is changed; kNotFound (a key image that comes
  /// near has no picture), and the arc stays the same.
  Result<Repeated> step(std::shared_ptr<const tracking::ImagePyramid> picture);

  /// The actual arc with those before and after it; null before the first one.
  [[nodiscard]] const ArcSurroundings* surroundings() const { return around_ ? &*around_ : nullptr; }
  /// Where the latest picture that was not lost was taken, in the frame of the surroundings.
  [[nodiscard]] const ArcPose& pose() const { return pose_; }
  /// The features around the actual arc as the latest picture shows them; empty before the first one.
  [[nodiscard]] const std::vector<FollowedLandmark>& landmarks() const { return follower_.landmarks(); }

 private:
  /// Where a picture was taken, as far as the tracked features say.
  struct Located {
    LostReason lost = LostReason::kTooFewFeatures;
    ArcPose pose;
    std::vector<std::size_t> landmarks;  // that were asked
    std::vector<bool> agrees;            // as many
    int agreeing = 0;
    double error_px = 0.0;
    double error_rad = 0.0;
    bool structure_agrees = true;
    [[nodiscard]] bool is_lost() const { return lost != LostReason::kNone; }
  };

  Repeater(const RepeatConfig& config, std::shared_ptr<const TaughtPath> path, KeyPictures pictures,
           std::shared_ptr<const camera::Camera> camera);
  [[nodiscard]] const Arc& arc_of(int arc) const { return path_->arcs[static_cast<std::size_t>(arc)]; }
  [[nodiscard]] int to_key(int arc) const { return path_->to_key(arc_of(arc)); }
  Result<LandmarkFollower::References> references_for(const ArcSurroundings& around) const;
  Status go_to(int arc, const ArcPose& pose);
  [[nodiscard]] ArcPose pose_in(const ArcSurroundings& other) const;
  Located locate_from_before(const tracking::ImagePyramid& picture);
  void follow(const tracking::ImagePyramid& picture);
  [[nodiscard]] ArcPose turned_by_shift(ArcPose pose, const tracking::ImagePyramid& there,
                                        const tracking::ImagePyramid& picture) const;
  Located look_around(const tracking::ImagePyramid& picture);
  Located locate_from(const ArcPose& start, int key, int others_agreeing, const tracking::ImagePyramid& picture);
  [[nodiscard]] Located locate(int key) const;
  [[nodiscard]] Located locate_by_keys(int from, std::span<const SeenLandmark> seen, Located best) const;
  bool recognise(const tracking::ImagePyramid& picture, Located& located);
  [[nodiscard]] std::vector<int> keys_to_compare() const;
  bool try_at(const RecognisedKey& found, int others_agreeing, const tracking::ImagePyramid& picture, Located& located);
  [[nodiscard]] int arc_at(int key) const;
  int predict(const tracking::ImagePyramid& picture, Located& located);
  void drop_what_disagrees(const Located& located);
  Result<int> pass_key_images(const tracking::ImagePyramid& picture, Located& located, int& predicted);
  [[nodiscard]] bool has_passed(int arc, double turned_most) const;
  [[nodiscard]] bool is_before(int arc) const;
  [[nodiscard]] Repeated answer(const Located& located) const;

  RepeatConfig config_;
  std::shared_ptr<const TaughtPath> path_;
  KeyPictures pictures_;
  std::shared_ptr<const camera::Camera> camera_;
  std::shared_ptr<const KeyGallery> gallery_;  // null without recognition
  std::optional<ArcSurroundings> around_;
  LandmarkFollower::References references_;
  LandmarkFollower follower_;
  ArcPose pose_;                                          // the last that was found
  std::shared_ptr<const tracking::ImagePyramid> latest_;  // the picture that it was found in; null before the first
  double turned_most_ = 0.0;                              // of the actual arc's turn, since it is the actual one
  int behind_ = 0;    // pictures in a row that were behind the arc's first key image
  int lost_for_ = 0;  // pictures in a row
  int pictures_seen_ = 0;
};

}  // namespace homeward::repeat
