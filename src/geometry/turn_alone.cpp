// SPDX-License-Identifier: Apache-2.0
#include "geometry/turn_alone.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <random>

namespace homeward::geometry {
namespace {

constexpr int kSamples = 40;  // half of the pairs right: one in four samples is
constexpr int kRefits = 5;

/// The axes of a frame that two bearings span.
Eigen::Matrix3d frame_of(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix3d frame;
  frame.col(0) = (a + b).normalized();
  frame.col(1) = a.cross(b).normalized();
  frame.col(2) = frame.col(0).cross(frame.col(1));
  return frame;
}

double off_px(const PointPair& pair, const Eigen::Matrix3d& turn) {
  return offset_px(pair.current, turn * pair.target.bearing).norm();
}

double cost(std::span<const PointPair> pairs, const Eigen::Matrix3d& turn, double most_off_px) {
  double sum = 0.0;
  for (const PointPair& pair : pairs) {
    const double off = std::min(off_px(pair, turn), most_off_px);
    sum += off * off;
  }
  return sum;
}

Eigen::Matrix3d refitted(std::span<const PointPair> pairs, const Eigen::Matrix3d& turn, double most_off_px) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const PointPair& pair : pairs) {
    if (off_px(pair, turn) < most_off_px) sum += pair.current.bearing * pair.target.bearing.transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(sum, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1.0, 1.0, 1.0);
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0.0) signs.z() = -1.0;
  return svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose();
}

}  // namespace

TurnAlone fit_turn(std::span<const PointPair> pairs, double most_off_px, std::uint64_t seed) {
  TurnAlone best;
  const std::size_t count = pairs.size();
  if (count >= 2) {
    std::mt19937_64 random(seed);
    double least = cost(pairs, best.current_from_target, most_off_px);
    const auto consider = [&](const Eigen::Matrix3d& turn) {
      if (!turn.allFinite()) return;
      const double now = cost(pairs, turn, most_off_px);
      if (now >= least) return;
      least = now;
      best.current_from_target = turn;
    };
    for (int i = 0; i < kSamples; ++i) {
      const PointPair& a = pairs[random() % count];
      const PointPair& b = pairs[random() % count];
      consider(frame_of(a.current.bearing, b.current.bearing) *
               frame_of(a.target.bearing, b.target.bearing).transpose());
    }
    for (int i = 0; i < kRefits; ++i) consider(refitted(pairs, best.current_from_target, most_off_px));
  }
  for (const PointPair& pair : pairs) best.off_px.push_back(off_px(pair, best.current_from_target));
  return best;
}

}  // namespace homeward::geometry
