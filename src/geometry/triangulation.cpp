// SPDX-License-Identifier: Apache-2.0
#include "geometry/triangulation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace homeward::geometry {
namespace {

Eigen::Vector3d onto_plane(const Eigen::Vector3d& ray, const Eigen::Vector3d& normal) {
  return (ray - normal * normal.dot(ray)).normalized();
}

}  // namespace

MeetingRays triangulate(const ViewMotion& motion, const Eigen::Vector3d& current, const Eigen::Vector3d& target) {
  const Eigen::Vector3d& along = motion.target_in_current;
  const Eigen::Vector3d turned = motion.current_from_target * target;
  // Of all planes that hold both viewpoints, the one nearest to both rays.
  Eigen::Matrix<double, 3, 2> across;
  across.col(0) = along.unitOrthogonal();
  across.col(1) = along.cross(across.col(0));
  const Eigen::Vector2d a = across.transpose() * current;
  const Eigen::Vector2d b = across.transpose() * turned;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> planes;
  planes.computeDirect(a * a.transpose() + b * b.transpose());
  const Eigen::Vector3d normal = across * planes.eigenvectors().col(0);
  MeetingRays rays;
  rays.current = onto_plane(current, normal);
  const Eigen::Vector3d met = onto_plane(turned, normal);
  rays.target = motion.current_from_target.transpose() * met;
  // distance * current = along + other distance * met, all in one plane.
  const double crossed = normal.dot(rays.current.cross(met));
  const double from_current = normal.dot(along.cross(met));
  const double from_target = normal.dot(along.cross(rays.current));
  const auto nearness = [crossed](double by) { return std::abs(by) > 1e-12 ? crossed / by : 0.0; };
  rays.nearness = nearness(from_current);
  rays.from_target = nearness(from_target);
  rays.parallax_rad = std::atan2(std::abs(crossed), rays.current.dot(met));
  return rays;
}

double reprojection_px2(const PointPair& pair, const MeetingRays& rays) {
  return offset_px(pair.current, rays.current).squaredNorm() + offset_px(pair.target, rays.target).squaredNorm();
}

}  // namespace homeward::geometry
