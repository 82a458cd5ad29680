// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "camera/camera.hpp"
#include "core/result.hpp"
#include "repeat/subrange.hpp"
#include "repeat/taught_path.hpp"
#include "repeat/teach_config.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::repeat {

/// What became of a picture.
enum class PictureFate {
  kFollowed,     // seen from the latest key image
  kBridged,      // the same, after a gap that nothing was tracked across
  kAfterKey,     // the same; the picture before it has become a key image
  kBegins,       // the first of a piece of the path
  kWaits,        // nothing could be followed into it; whether the next ones can be is to be seen
  kAfterCut,     // the path was cut, and goes on in a new piece
  kNothingToSee  // too few corners to begin with
};

struct TaughtPicture {
  PictureFate fate = PictureFate::kNothingToSee;
  int key_picture = 0;  // number of the key image that it is seen from
  int tracked = 0;      // features
  int agreeing = 0;     // of those, on the geometry
  int common = 0;       // of those, also in the arc before
  double error_px = 0.0;
  double parallax_px = 0.0;
  bool has_baseline = false;
};

/// Makes a path of pictures that are shown one after another: corners of a key image are followed until the two-view
/// geometry is no longer exact, or too few are left; the last picture before that is the next key image (Segvic et al.
/// 2007, §2.1). Features are looked for where they were, and where that fails, as in a quick turn, by the shift of the
/// whole picture. Where nothing can be followed into the picture right after a key image, it and the next pictures are
/// matched with that without any expectation (bridge.hpp); where that fails, too, the path is cut, and says so. Whether
/// it is closed is found out afterwards (closing.hpp). A value; copies are independent. Deterministic
/// by the configuration's seed.
class Teacher {
 public:
  /// Errors: kInvalidInput (a problem of the configuration; a nominal camera, or one whose pictures are no views of a
  /// lens: mirrors and panoramas).
  static Result<Teacher> create(const TeachConfig& config, std::shared_ptr<const camera::Camera> camera);

  /// The next picture of the path. Errors: kWrongImageSize, and nothing is changed.
  Result<TaughtPicture> add(tracking::ImagePyramid picture);

  /// The path so far, ending at the last picture that could be followed.
  /// Errors: kTooFewImages (fewer than two pictures), kTooLittleSupport (no two of them are seen to belong together).
  [[nodiscard]] Result<TaughtPath> path() const;

 private:
  Teacher(const TeachConfig& config, std::shared_ptr<const camera::Camera> camera)
      : config_(config), camera_(std::move(camera)) {}
  [[nodiscard]] SubrangeView look(const NumberedPicture& picture) const;
  TaughtPicture take(NumberedPicture picture);
  TaughtPicture begin_piece(NumberedPicture picture);
  TaughtPicture keep(NumberedPicture picture, SubrangeView view, PictureFate fate);
  TaughtPicture bridge_wait_or_cut(NumberedPicture picture, ArcEnd why);
  [[nodiscard]] int least_features() const;
  void close_arc(ArcEnd why);
  TaughtPicture cut();

  TeachConfig config_;
  std::shared_ptr<const camera::Camera> camera_;
  int shown_ = 0;
  int next_feature_ = 0;
  TaughtPath path_;                        // of all arcs that are closed
  std::optional<Subrange> subrange_;       // none before a piece begins
  bool is_key_in_path_ = false;            // the subrange's key image is the last one of path_
  int first_agreeing_ = 0;                 // features in the subrange's second picture
  std::optional<NumberedPicture> latest_;  // the picture of the subrange's latest view
  std::vector<NumberedPicture> waiting_;   // after the key image, which has no arc yet: nothing could be followed there
  ArcEnd why_waiting_ = ArcEnd::kTooFewFeatures;
};

}  // namespace homeward::repeat
