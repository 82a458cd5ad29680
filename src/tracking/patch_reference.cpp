// SPDX-License-Identifier: Apache-2.0
#include "tracking/patch_reference.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

namespace homeward::tracking {
namespace {

// Of an ideal corner nothing tells how large it is: its scale then stays as it was. The share of the energy that a
// gradient of any direction at the rim would have.
constexpr double kScaleDamping = 0.01;
constexpr double kLeastGain = 0.1;  // steps are not divided by less
constexpr double kLargestZoom = 0.2;
constexpr int kMargin_px = 1;  // the gradient's neighbours

using Matrix5 = Eigen::Matrix<double, 5, 5>;

/// The inverse of the unknowns from `first` to below `end`, zero elsewhere.
Matrix5 inverse_of(const Matrix5& normal, int first, int end) {
  const int count = end - first;
  const Eigen::MatrixXd used = normal.block(first, first, count, count);
  Matrix5 inverse = Matrix5::Zero();
  inverse.block(first, first, count, count) = used.ldlt().solve(Eigen::MatrixXd::Identity(count, count));
  return inverse;
}

/// Where a pixel is in a plane of a patch.
std::size_t at_pixel(int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(kPatchStride) + static_cast<std::size_t>(x);
}

}  // namespace

std::optional<PatchReference> PatchReference::make(const GreyLevel& level, const Eigen::Vector2d& centre_px, int side,
                                                   const PatchChanges& changes, double least_texture) {
  constexpr int kStride = kLargestPatchSide_px + 2 * kMargin_px;
  std::array<float, static_cast<std::size_t>(kStride * kStride)> around{};
  const int reach = side / 2 + kMargin_px;
  const PatchPlace place{centre_px.x() - reach, centre_px.y() - reach, 1.0};
  const int wide = side + 2 * kMargin_px;
  if (!inside(level, wide, place, kMostOutside_px)) return std::nullopt;
  sample_patch(level, wide, place, around.data(), kStride);

  PatchReference reference;
  reference.side_ = side;
  reference.changes_ = changes;
  const auto plane = static_cast<std::size_t>(side) * kPatchStride;
  reference.planes_.resize(3 * plane);
  double sum = 0.0;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const float* at = around.data() + static_cast<std::ptrdiff_t>(y + kMargin_px) * kStride + x + kMargin_px;
      const std::size_t to = at_pixel(x, y);
      reference.planes_[to] = at[0];
      reference.planes_[plane + to] = 0.5F * (at[1] - at[-1]);
      reference.planes_[2 * plane + to] = 0.5F * (at[kStride] - at[-kStride]);
      sum += static_cast<double>(at[0]);
    }
  }
  reference.mean_ = static_cast<float>(sum / (side * side));
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) reference.planes_[at_pixel(x, y)] -= reference.mean_;
  }
  if (!reference.prepare(least_texture)) return std::nullopt;
  return reference;
}

bool PatchReference::prepare(double least_texture) {
  const PatchView patch = view();
  const int half = side_ / 2;
  for (int y = 0; y < side_; ++y) {
    for (int x = 0; x < side_; ++x) {
      const int at = y * kPatchStride + x;
      const double du = static_cast<double>(patch.du[at]);
      const double dv = static_cast<double>(patch.dv[at]);
      Eigen::Matrix<double, 5, 1> row;
      row << static_cast<double>(patch.grey[at]), 1.0, du, dv, (x - half) * du + (y - half) * dv;
      normal_ += row * row.transpose();
    }
  }
  if (!(normal_(0, 0) > 0.0)) return false;
  const Eigen::Matrix2d moved =
      normal_.block<2, 2>(2, 2) -
      normal_.block<2, 2>(2, 0) * normal_.block<2, 2>(0, 0).ldlt().solve(normal_.block<2, 2>(0, 2));
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(moved, Eigen::EigenvaluesOnly);
  texture_ = solver.eigenvalues()(0) / (side_ * side_);
  if (!(texture_ >= least_texture)) return false;

  Matrix5 damped = normal_;
  damped(4, 4) += kScaleDamping * half * half * (normal_(2, 2) + normal_(3, 3));
  const int first = changes_.contrast ? 0 : 2;
  inverse_of_place_ = inverse_of(damped, first, 4);
  inverse_ = changes_.scale ? inverse_of(damped, first, 5) : inverse_of_place_;
  return inverse_.allFinite();
}

PatchView PatchReference::view() const {
  const auto plane = static_cast<std::size_t>(side_) * kPatchStride;
  return {side_, mean_, planes_.data(), planes_.data() + plane, planes_.data() + 2 * plane};
}

PatchStep PatchReference::step(const PatchSums& sums, StepOf of) const {
  Eigen::Matrix<double, 5, 1> seen;
  seen << sums.grey, sums.one, sums.du, sums.dv, sums.zoom;
  if (!changes_.contrast) seen -= normal_.col(0);  // gain 1, offset 0: what is left of I after T
  const Eigen::Matrix<double, 5, 1> solved = (of == StepOf::kPlace ? inverse_of_place_ : inverse_) * seen;

  PatchStep step;
  const double pixels = side_ * side_;
  double squares = 0.0;
  if (changes_.contrast) {
    // T has no mean, so that gain and offset do not depend on each other.
    step.gain = sums.grey / normal_(0, 0);
    const double mean = sums.one / pixels;
    step.offset = mean + static_cast<double>(mean_) * (1.0 - step.gain);
    squares = sums.square - sums.one * mean - sums.grey * step.gain;
  } else {
    squares = sums.square - 2.0 * sums.grey + normal_(0, 0);
  }
  step.residual = std::sqrt(std::max(0.0, squares) / pixels) / std::max(step.gain, kLeastGain);

  const double scaled = 1.0 / std::max(changes_.contrast ? solved(0) : 1.0, kLeastGain);
  const double largest_px = side_ / 4.0;
  const double length_px = scaled * std::hypot(solved(2), solved(3));
  const double shortened = length_px > largest_px ? largest_px / length_px : 1.0;
  step.du_px = shortened * scaled * solved(2);
  step.dv_px = shortened * scaled * solved(3);
  step.zoom = std::clamp(shortened * scaled * solved(4), -kLargestZoom, kLargestZoom);
  return step;
}

}  // namespace homeward::tracking
