// SPDX-License-Identifier: Apache-2.0
#include "linemodel/plan_floor.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/index.hpp"

namespace homeward::linemodel {
namespace {

constexpr double kMost_m = 250.0;
constexpr double kWallLeast_m = 1.6;  // what stands there reaches above furniture and below the lintels of doors
constexpr double kWallMost_m = 1.9;
constexpr double kRoom_m = 0.2;  // between the middle of a robot and a wall
constexpr float kFar_m = 1e3F;
constexpr double kLeastFloor_m2 = 4.0;
constexpr double kLeastPart_m2 = 0.5;  // smaller free parts are the insides of cupboards

/// The rectangle of the floor that a plan covers.
Eigen::AlignedBox2d extent_of(const Plan& plan) {
  Eigen::AlignedBox2d box;
  for (Eigen::Index i = 0; i < plan.vertices_m.rows(); ++i) {
    box.extend(Eigen::Vector2d(plan.vertices_m(i, 0), plan.vertices_m(i, 1)));
  }
  for (const PlanLine& line : plan.lines) {
    box.extend(line.from_m.head<2>().cast<double>());
    box.extend(line.to_m.head<2>().cast<double>());
  }
  return box;
}

using Corners = std::vector<Eigen::Vector3d>;

/// The part of a polygon on one side of a height (Sutherland & Hodgman 1974).
Corners clipped(const Corners& corners, double height_m, bool above) {
  Corners kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector3d& a = corners[i];
    const Eigen::Vector3d& b = corners[(i + 1) % corners.size()];
    const bool a_in = above ? a.z() >= height_m : a.z() <= height_m;
    const bool b_in = above ? b.z() >= height_m : b.z() <= height_m;
    if (a_in) kept.push_back(a);
    if (a_in != b_in) kept.push_back(a + (height_m - a.z()) / (b.z() - a.z()) * (b - a));
  }
  return kept;
}

/// Calls `mark(x_m, y_m)` at points of a triangle no farther apart than `step_m`.
template <typename Mark>
void cover(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, double step_m,
           const Mark& mark) {
  const double longest_m = std::max({(b - a).head<2>().norm(), (c - a).head<2>().norm(), (c - b).head<2>().norm()});
  const int steps = std::max(1, static_cast<int>(std::ceil(longest_m / step_m)));
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const Eigen::Vector3d p = a + (b - a) * i / steps + (c - a) * j / steps;
      mark(p.x(), p.y());
    }
  }
}

template <typename Mark>
void cover_between(const Plan& plan, double least_m, double most_m, double step_m, const Mark& mark) {
  for (Eigen::Index t = 0; t < plan.triangles.rows(); ++t) {
    Corners corners;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const Eigen::Vector3f corner = plan.vertices_m.row(plan.triangles(t, k));
      corners.push_back(corner.cast<double>());
    }
    corners = clipped(clipped(corners, least_m, true), most_m, false);
    for (std::size_t k = 2; k < corners.size(); ++k) cover(corners[0], corners[k - 1], corners[k], step_m, mark);
  }
}

}  // namespace

PlanSlice::PlanSlice(const Plan& plan, double least_m, double most_m) {
  if (plan.vertices_m.rows() == 0 && plan.lines.empty()) return;
  const Eigen::AlignedBox2d box = extent_of(plan);
  least_m_ = box.min() - Eigen::Vector2d::Constant(2.0 * kCell_m);  // free cells all around
  width_ = static_cast<int>(std::ceil(box.sizes().x() / kCell_m)) + 5;
  height_ = static_cast<int>(std::ceil(box.sizes().y() / kCell_m)) + 5;
  occupied_.assign(at(width_) * at(height_), 0);
  cover_between(plan, least_m, most_m, 0.5 * kCell_m,
                [&](double x_m, double y_m) { occupied_[at(row(y_m)) * at(width_) + at(column(x_m))] = 1; });
  cv::Mat empty(height_, width_, CV_8UC1);
  bool any = false;
  for (std::size_t i = 0; i < occupied_.size(); ++i) {
    empty.data[i] = occupied_[i] == 0 ? 255 : 0;
    any = any || occupied_[i] != 0;
  }
  clearance_m_.assign(occupied_.size(), kFar_m);
  if (!any) return;
  cv::Mat distances;
  cv::distanceTransform(empty, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  for (std::size_t i = 0; i < clearance_m_.size(); ++i) {
    clearance_m_[i] = static_cast<float>(kCell_m) * distances.ptr<float>()[i];
  }
}

bool PlanSlice::covers(const Eigen::Vector2d& point_m) const {
  const int u = column(point_m.x());
  const int v = row(point_m.y());
  return u >= 0 && v >= 0 && u < width_ && v < height_;
}

float PlanSlice::clearance_m(const Eigen::Vector2d& point_m) const {
  if (!covers(point_m)) return 0.0F;
  return clearance_m_[at(row(point_m.y())) * at(width_) + at(column(point_m.x()))];
}

Result<PlanFloor> PlanFloor::of(const Plan& plan) {
  const Eigen::Vector2d size_m = extent_of(plan).sizes();
  if (size_m.maxCoeff() > kMost_m) {
    return fail(ErrorCode::kInvalidInput, "The plan is more than 250 m across. Is it drawn in metres?");
  }
  PlanFloor floor;
  floor.walls_ = PlanSlice(plan, kWallLeast_m, kWallMost_m);
  const PlanSlice& walls = floor.walls_;
  constexpr double kFloor_m = 0.05;  // over and under 0
  std::vector<std::uint8_t> drawn(walls.occupied_.size(), 0);
  cover_between(plan, -kFloor_m, kFloor_m, 0.5 * PlanSlice::kCell_m, [&](double x_m, double y_m) {
    drawn[at(walls.row(y_m)) * at(walls.width_) + at(walls.column(x_m))] = 1;
  });
  // The feet of walls are drawn at that height too.
  std::int64_t floor_cells = 0;
  for (std::size_t i = 0; i < drawn.size(); ++i)
    floor_cells += drawn[i] != 0 && walls.clearance_m_[i] >= kRoom_m ? 1 : 0;
  if (static_cast<double>(floor_cells) * PlanSlice::kCell_m * PlanSlice::kCell_m >= kLeastFloor_m2) {
    floor.indoors_ = std::move(drawn);
  } else {
    cv::Mat reached(walls.height_, walls.width_, CV_8UC1);
    for (std::size_t i = 0; i < walls.occupied_.size(); ++i) reached.data[i] = walls.occupied_[i] == 0 ? 0 : 1;
    cv::floodFill(reached, cv::Point(0, 0), cv::Scalar(2));
    floor.indoors_.resize(walls.occupied_.size());
    for (std::size_t i = 0; i < floor.indoors_.size(); ++i) floor.indoors_[i] = reached.data[i] == 0 ? 1 : 0;
    const auto inside = std::count(floor.indoors_.begin(), floor.indoors_.end(), 1);
    if (static_cast<double>(inside) * PlanSlice::kCell_m * PlanSlice::kCell_m < kLeastFloor_m2) {
      floor.indoors_.assign(walls.occupied_.size(), 1);
    }
  }
  floor.leave_out_small_parts();
  for (double y = walls.least_m_.y(); y < walls.least_m_.y() + walls.height_ * PlanSlice::kCell_m; y += kSpacing_m) {
    for (double x = walls.least_m_.x(); x < walls.least_m_.x() + walls.width_ * PlanSlice::kCell_m; x += kSpacing_m) {
      if (floor.free({x, y})) floor.free_points_m_.emplace_back(x, y);
    }
  }
  return floor;
}

void PlanFloor::leave_out_small_parts() {
  cv::Mat room(walls_.height_, walls_.width_, CV_8UC1);
  for (std::size_t i = 0; i < indoors_.size(); ++i) {
    room.data[i] = indoors_[i] != 0 && walls_.clearance_m_[i] >= kRoom_m ? 1 : 0;
  }
  cv::Mat parts;
  cv::Mat about;
  cv::Mat middles;
  cv::connectedComponentsWithStats(room, parts, about, middles, 4, CV_32S);
  const double least_cells = kLeastPart_m2 / (PlanSlice::kCell_m * PlanSlice::kCell_m);
  for (std::size_t i = 0; i < indoors_.size(); ++i) {
    const int part = parts.ptr<int>()[i];
    if (part == 0 || about.at<int>(part, cv::CC_STAT_AREA) < least_cells) indoors_[i] = 0;
  }
}

bool PlanFloor::free(const Eigen::Vector2d& point_m) const {
  if (!walls_.covers(point_m) || walls_.clearance_m(point_m) < kRoom_m) return false;
  return indoors_[at(walls_.row(point_m.y())) * at(walls_.width_) + at(walls_.column(point_m.x()))] != 0;
}

}  // namespace homeward::linemodel
