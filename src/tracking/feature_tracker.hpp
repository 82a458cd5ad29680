// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "tracking/image_pyramid.hpp"
#include "tracking/patch_reference.hpp"

namespace homeward::tracking {

/// With less contrast against a reference than that, a picture is dark.
constexpr double kDarkGain = 0.6;

struct FeatureTrackerConfig {
  int window_px = 15;            // side of the patch on every level: odd, 7 to 15
  int iterations = 20;           // at most, on each level
  double converged_px = 0.01;    // a step shorter than this ends the finest level; five times as much the others
  double most_residual = 6.0;    // R of Segvic et al. 2007, §2.1: grey levels of the reference, root mean square,
  bool darker_residual = false;  // or of the picture, where it has much less contrast (a gain below 0.6): what noise
                                 // leaves of it by night looks larger in the reference by as much
  double least_texture = 0.5;    // of a reference, (grey levels a pixel)^2: PatchReference::make
  double least_gain = 0.4;       // contrast against the reference's: what is less or more is something else
  double most_gain = 2.5;
  double least_scale = 0.4;  // size against the reference's
  double most_scale = 2.5;
  double most_from_guess_px = 48.0;  // a feature found farther from where it was looked for is another one
  PatchChanges changes{};
};
/// Empty when valid; lists all problems.
std::vector<std::string> problems(const FeatureTrackerConfig& config);

/// What became of a point of which a reference was to be kept.
enum class ReferenceState {
  kTaken,
  kNoTexture,   // too little in it to tell where it is
  kOffPicture,  // its patch is not all in the picture, or the point is not a number
};

enum class FeatureState {
  kTracked,
  kLostOffPicture,  // its patch is not all in the picture
  kLostDiverged,    // no rest found near the guess, or out of the bounds of scale
  kLostContrast,    // found with a gain out of its bounds
  kLostResidual,    // found, but it does not look like its reference: hidden, or something else
  kBadGuess,        // a guess that is not a number, of no size, or of no reference
};

/// Where a reference is looked for.
struct FeatureGuess {
  std::size_t reference = 0;
  Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();
  double scale = 1.0;  // size against the reference's
};

/// A feature in a picture. All but the state is the guess where the guess is bad, and the last that was tried where the
/// feature is lost.
struct TrackedFeature {
  Eigen::Vector2d pixel_px = Eigen::Vector2d::Zero();
  double scale = 1.0;     // size against the reference's
  double gain = 1.0;      // grey level = gain * reference + offset
  double offset = 0.0;    // grey levels
  double residual = 0.0;  // grey levels of the reference, root mean square
  FeatureState state = FeatureState::kBadGuess;
};

/// Points followed through the pictures of a perspective camera, each against how it looked in the picture in which it
/// was first seen, so that nothing drifts: coarse to fine, by Gauss-Newton steps for place, scale and contrast
/// (PatchReference); then accepted or named as lost. Where a feature looks twice as large, its reference is compared
/// with the next coarser level, so that both are equally smooth; half as large, the other way round.
/// Method: Segvic, Remazeilles and Chaumette 2006; Segvic et al. 2007, §2; Shi and Tomasi 1994; Jin, Favaro and Soatto
/// 2001. Every feature is tracked for itself: its result does not depend on what else is asked for.
class FeatureTracker {
 public:
  /// Errors: kInvalidInput with the first of `problems`.
  static Result<FeatureTracker> create(const FeatureTrackerConfig& config);

  /// Keeps references of points of a picture, numbered on from size() in the order of those taken. As many states as
  /// points.
  std::vector<ReferenceState> add(const ImagePyramid& picture, std::span<const Eigen::Vector2d> pixels_px);
  /// Lets go of all references.
  void clear() { references_.clear(); }
  [[nodiscard]] std::size_t size() const { return references_.size(); }
  /// How much a reference shows to be found by, (grey levels a pixel)^2: PatchReference::texture.
  [[nodiscard]] double texture(std::size_t reference) const { return references_[reference].front()->texture(); }

  /// Where references are in a picture. As many results as guesses, in their order; a reference may be asked for twice.
  [[nodiscard]] std::vector<TrackedFeature> track(const ImagePyramid& picture,
                                                  std::span<const FeatureGuess> guesses) const;

 private:
  using Reference = std::vector<std::optional<PatchReference>>;  // finest first; none where a level shows too little

  explicit FeatureTracker(const FeatureTrackerConfig& config) : config_(config) {}
  [[nodiscard]] TrackedFeature track_one(const ImagePyramid& picture, const FeatureGuess& guess) const;

  FeatureTrackerConfig config_;
  std::vector<Reference> references_;
};

}  // namespace homeward::tracking
