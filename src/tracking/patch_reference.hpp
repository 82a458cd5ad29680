// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tracking/patch_sums.hpp"

namespace homeward::tracking {

/// What of a patch may change besides where it is.
struct PatchChanges {
  bool scale = true;     // it may look larger or smaller
  bool contrast = true;  // its grey levels may be another affine function of the reference's
};

/// How a patch must be moved to look more like its reference, and how alike the two are where it is now.
struct PatchStep {
  double du_px = 0.0;     // in pixels of the reference
  double dv_px = 0.0;     // in pixels of the reference
  double zoom = 0.0;      // of the scale: 0.1 for a tenth larger
  double gain = 1.0;      // seen = gain * reference + offset, without moving it
  double offset = 0.0;    // grey levels
  double residual = 0.0;  // grey levels of the reference, root of the mean square of what gain and offset leave
};

/// What a step may be of.
enum class StepOf {
  kPlace,          // the scale stays as it is
  kPlaceAndScale,  // where PatchChanges has the scale change; else the same
};

/// The look of one patch on one level, with what of the Gauss-Newton steps towards it never changes.
///
/// With I what is seen where the patch is now, T the reference and q = gain * (du, dv, zoom),
///   I(x) = gain T(x) + offset + Tu(x) q1 + Tv(x) q2 + (x Tu(x) + y Tv(x)) q3
/// to first order: linear in all five unknowns, with a matrix of normal equations that depends on the reference alone
/// and is inverted once. The scale and affine contrast are those of Jin, Favaro and Soatto 2001; that the reference
/// moves towards the picture and not the picture towards the reference is the inverse composition of Baker and
/// Matthews 2004.
class PatchReference {
 public:
  /// A patch of `side` around a point of a level; nothing where it and a pixel around it are not all in the level, or
  /// where it shows too little. `least_texture`: least eigenvalue, for each pixel, of the normal equations of du and dv
  /// with gain and offset eliminated, in squared grey levels a pixel.
  static std::optional<PatchReference> make(const GreyLevel& level, const Eigen::Vector2d& centre_px, int side,
                                            const PatchChanges& changes, double least_texture);

  [[nodiscard]] PatchView view() const;
  /// What `least_texture` is about, of this one.
  [[nodiscard]] double texture() const { return texture_; }
  /// The step from the sums (patch_sums.hpp) at a place. Moves nothing where what is seen there is plain.
  [[nodiscard]] PatchStep step(const PatchSums& sums, StepOf of) const;

 private:
  using Matrix5 = Eigen::Matrix<double, 5, 5>;

  [[nodiscard]] bool prepare(double least_texture);

  int side_ = 0;
  PatchChanges changes_;
  float mean_ = 0.0F;
  double texture_ = 0.0;
  std::vector<float> planes_;  // grey, du, dv: side x kPatchStride each
  Matrix5 normal_ = Matrix5::Zero();
  Matrix5 inverse_ = Matrix5::Zero();           // of the unknowns that there are; zero elsewhere
  Matrix5 inverse_of_place_ = Matrix5::Zero();  // the same without scale
};

}  // namespace homeward::tracking
