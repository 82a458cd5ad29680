// SPDX-License-Identifier: Apache-2.0
#include "linemodel/plan_builder.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

namespace homeward::linemodel {
namespace {

/// Also false of what is not a number.
bool is_near(const Eigen::Vector3d& point_m) { return (point_m.array().abs() <= kFarthest_m).all(); }

Status refuse_far(const std::string& where) {
  return fail(ErrorCode::kInvalidInput,
              "A point lies more than 10 km from the origin. Plans are in metres; a scale may be missing.", where);
}

bool is_before(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

}  // namespace

Eigen::Vector3d upright_m(const Eigen::Vector3d& point_m, PlanUp up) {
  return up == PlanUp::kZ ? point_m : Eigen::Vector3d(point_m.x(), -point_m.z(), point_m.y());
}

Status PlanBuilder::add_line(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, const std::string& where) {
  if (!is_near(from_m) || !is_near(to_m)) return refuse_far(where);
  const PlanLine line{from_m.cast<float>(), to_m.cast<float>()};
  if (line.from_m == line.to_m) return {};
  if (lines_.size() >= kMostPlanLines)
    return fail(ErrorCode::kTooLarge, "The plan has more than 2,000,000 lines.", where);
  lines_.push_back(line);
  return {};
}

Status PlanBuilder::add_triangle(const std::array<Eigen::Vector3d, 3>& corners_m, const std::string& where) {
  for (const Eigen::Vector3d& corner_m : corners_m) {
    if (!is_near(corner_m)) return refuse_far(where);
  }
  const Eigen::Vector3f a = corners_m[0].cast<float>();
  const Eigen::Vector3f b = corners_m[1].cast<float>();
  const Eigen::Vector3f c = corners_m[2].cast<float>();
  const Eigen::Vector3d normal = (b.cast<double>() - a.cast<double>()).cross(c.cast<double>() - a.cast<double>());
  if (!(normal.norm() > 0.0)) return {};
  if (triangles() >= kMostPlanTriangles)
    return fail(ErrorCode::kTooLarge, "The plan has more than 2,000,000 triangles.", where);
  corners_m_.insert(corners_m_.end(), {a, b, c});
  return {};
}

Result<Plan> PlanBuilder::take(const std::string& where) {
  if (lines_.empty() && corners_m_.empty())
    return fail(ErrorCode::kEmptyInput, "The plan has neither a line nor a face.", where);
  Plan plan;
  plan.lines = std::exchange(lines_, {});
  const std::vector<Eigen::Vector3f> corners_m = std::exchange(corners_m_, {});
  std::vector<std::int32_t> order(corners_m.size());
  std::iota(order.begin(), order.end(), 0);
  const auto corner = [&](std::int32_t i) -> const Eigen::Vector3f& { return corners_m[static_cast<std::size_t>(i)]; };
  std::ranges::stable_sort(order, [&](std::int32_t a, std::int32_t b) { return is_before(corner(a), corner(b)); });
  // Each corner is known by the first of those that are the same; vertices keep the order in which they came.
  std::vector<std::int32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && corner(order[i]) == corner(order[i - 1]);
    first[static_cast<std::size_t>(order[i])] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
  }
  std::vector<std::int32_t> row(order.size());
  plan.vertices_m.resize(static_cast<Eigen::Index>(order.size()), 3);
  plan.triangles.resize(static_cast<Eigen::Index>(order.size() / 3), 3);
  std::int32_t rows = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const auto known = static_cast<std::size_t>(first[i]);
    if (known == i) {
      row[i] = rows;
      plan.vertices_m.row(rows++) = corners_m[i].transpose();
    }
    plan.triangles(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) = row[known];
  }
  plan.vertices_m.conservativeResize(rows, 3);
  return plan;
}

}  // namespace homeward::linemodel
