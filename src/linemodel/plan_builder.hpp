// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "linemodel/plan.hpp"

namespace homeward::linemodel {

/// What a file of a plan may have at most.
inline constexpr std::size_t kMostPlanBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMostPlanLines = 2'000'000;
inline constexpr std::size_t kMostPlanTriangles = 2'000'000;
inline constexpr double kFarthest_m = 10'000.0;  // of a coordinate from the origin

/// Which axis of a file points up. kY: a plan's (x, y, z) is the file's (x, -z, y).
enum class PlanUp { kY, kZ };

/// The plan's point of a file's.
Eigen::Vector3d upright_m(const Eigen::Vector3d& point_m, PlanUp up);

/// Puts a plan together from what a file says, and refuses what no plan has.
class PlanBuilder {
 public:
  /// Adds a line, metres, z up; one without length is left out. `where` names its place in errors. Errors:
  /// kInvalidInput (an end is not a number or over 10 km off), kTooLarge (over 2,000,000 lines).
  Status add_line(const Eigen::Vector3d& from_m, const Eigen::Vector3d& to_m, const std::string& where);
  /// Adds a surface that hides lines; one without area is left out. Errors as above.
  Status add_triangle(const std::array<Eigen::Vector3d, 3>& corners_m, const std::string& where);
  [[nodiscard]] std::size_t lines() const { return lines_.size(); }
  [[nodiscard]] std::size_t triangles() const { return corners_m_.size() / 3; }
  /// The plan, its triangles with the same corner kept once; the builder is empty afterwards. Errors: kEmptyInput, when
  /// there is neither line nor triangle.
  Result<Plan> take(const std::string& where);

 private:
  std::vector<PlanLine> lines_;
  std::vector<Eigen::Vector3f> corners_m_;  // three for each triangle
};

}  // namespace homeward::linemodel
