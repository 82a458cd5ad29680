// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/ids.hpp"
#include "geometry/five_point.hpp"

namespace homeward::map {

/// A path that was shown once: key images joined by arcs, each with its own geometry and its own unit of length, the
/// distance between its two key images. No frame is common to all (Segvic et al. 2007, §2.1). Plain data. Frames are
/// robot frames at the camera's viewpoint: x forward, y left, z up.

/// A feature in a key image. The same landmark has the same number in all key images of the path.
struct KeyFeature {
  int feature = 0;
  Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();  // with the picture, all that a tracker's reference is made of
};

/// How the unit of the arc that begins at a key image compares to that of the arc that ends there.
struct NodeScale {
  double ratio = 1.0;   // length of the arc that begins here over that of the one that ends here (s_i)
  int common = 0;       // points in both arcs that it was found from
  double spread = 0.0;  // of its natural logarithm over those points: 1.4826 times the median deviation
};

struct KeyImage {
  int picture = 0;                   // number, from 0, among the pictures that were shown
  std::vector<KeyFeature> features;  // X_i: what was followed from here or up to here
  int common = 0;                    // features of the arc that ends here that are in the one that begins here, too
  std::optional<NodeScale> scale;    // none where a piece of the path begins or ends, where one of the arcs has no
                                     // baseline, or where too few common points have a distance in both
};

/// A landmark that both key images of an arc show.
struct ArcMatch {
  int feature = 0;
  Eigen::Vector2d from_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_px = Eigen::Vector2d::Zero();
  Eigen::Vector3d from_bearing = Eigen::Vector3d::UnitX();  // unit, to the triangulated point, in the first's frame
  Eigen::Vector3d to_bearing = Eigen::Vector3d::UnitX();    // unit, to the triangulated point, in the second's frame
  double from_nearness = 0.0;  // 1 / distance, in arcs: the point is at from_bearing / from_nearness; 0: as far as the
                               // sky for all that is known
  double to_nearness = 0.0;    // the same from the second key image
  double distance_spread = 0.0;  // standard deviation of the logarithm of the distance, about; meaningless at 0
};

enum class ArcEnd {
  kTooFewFeatures,  // one picture further fewer than n agreed
  kErrorTooLarge,   // one picture further the reprojection error was above sigma
  kTooFewCommon,    // one picture further too few of the arc's before were left
  kNoGeometry,      // one picture further no motion explained what was tracked
  kPathEnd,         // the last picture that could be followed
};

/// From one key image to the next.
struct PathArc {
  int from = 0;               // index of the key image; TaughtPath::to_key says where it leads
  bool has_baseline = false;  // without: the camera turned on the spot; the direction means nothing and no point has a
                              // distance
  geometry::ViewMotion motion;  // R and t: `current` is the first key image, `target` the second
  double error_px = 0.0;        // sigma(W): root mean square reprojection error, in each picture, of the points below
  double parallax_px = 0.0;     // by which a turn alone misses a quarter of the points
  double direction_spread_rad = 0.0;  // standard deviation of the direction where it is known worst
  double lead = 0.0;                  // over the best motion in another direction (geometry::TwoViewEstimate)
  ArcEnd ended_by = ArcEnd::kPathEnd;
  std::vector<ArcMatch> matches;  // M_i
};

enum class CutReason {
  kTooFewFeatures,  // too few features could be followed
  kNoGeometry,      // no motion explains what was tracked
  kErrorTooLarge,   // what was found is too far from any one motion
};

/// Where the path falls into pieces: what was tracked up to one picture is not seen in those after it.
struct PathCut {
  int last_picture = 0;             // of the piece before
  std::optional<int> next_picture;  // of the piece after; nothing where none came
  CutReason why = CutReason::kTooFewFeatures;
};

/// A gap inside a piece: nothing could be followed across it, but the key image before and the picture after it were
/// matched without any expectation (Segvic et al. 2007, §2.1), and what both show was followed on from there.
struct PathBridge {
  int last_picture = 0;  // the key image before
  int next_picture = 0;  // seen from it
  int matched = 0;       // features that were matched and agree with one motion
};

/// Where a closed path goes on: its last arc leads from the last key image back to an earlier one. Nothing of the path
/// is corrected by that; all round the way the units of arcs may disagree.
struct PathClosing {
  int key_image = 0;               // of the same piece
  int common = 0;                  // features of the closing arc that are in the one that begins there, too
  std::optional<NodeScale> scale;  // of the latter over the closing one; as in KeyImage, whose own is of the arc from
                                   // the key image before
};

struct TaughtPath {
  std::vector<KeyImage> key_images;
  std::vector<PathArc> arcs;  // in the order of `from`; none from where the path is cut, nor from the end if it is open
  std::vector<PathCut> cuts;  // empty: in one piece
  std::vector<int> skipped_pictures;   // inside pieces: nothing could be followed into them, but past them
  std::vector<PathBridge> bridges;     // rising
  std::optional<PathClosing> closing;  // the last arc leads there; none: the path has an end

  [[nodiscard]] int last_key() const { return static_cast<int>(key_images.size()) - 1; }
  [[nodiscard]] bool is_closing(const PathArc& arc) const { return closing && arc.from == last_key(); }
  /// The key image that an arc leads to.
  [[nodiscard]] int to_key(const PathArc& arc) const { return is_closing(arc) ? closing->key_image : arc.from + 1; }
  /// The arc that goes on where one ends; nothing at the end of the path or of a piece.
  [[nodiscard]] std::optional<int> arc_after(int arc) const;
  /// The arc that ends where one begins. Where a closed path goes round, that is the closing arc, even if a way leads
  /// there from before. Nothing at the beginning of an open path or of a piece.
  [[nodiscard]] std::optional<int> arc_before(int arc) const;
  /// The arc that begins at a key image.
  [[nodiscard]] std::optional<int> arc_from(int key) const;
};

/// A path as a map keeps it: with what it is repeated by.
struct MapPath {
  TaughtPath taught;
  std::vector<ImageId> images;                      // of the map, one for each key image
  std::vector<std::vector<std::uint8_t>> pictures;  // of each key image, as it was taken: JPEG or PNG
};

}  // namespace homeward::map
