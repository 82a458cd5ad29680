// SPDX-License-Identifier: Apache-2.0
#include "linemodel/visible_lines.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

namespace homeward::linemodel {
namespace {

constexpr float kShort_m = 0.03F;  // of a ray's end: an edge lies in the surfaces that meet in it

float angle_between(const Eigen::Vector3f& a, const Eigen::Vector3f& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

std::int64_t key_of(std::int32_t column, std::int32_t row) {
  return static_cast<std::int64_t>(column) * (std::int64_t{1} << 32) + row;
}

}  // namespace

VisibleLines::VisibleLines(const Plan& plan, double height_m, const VisibilityConfig& config)
    : height_m_(height_m), config_(config), rays_(plan.vertices_m, plan.triangles) {
  for (std::size_t i = 0; i < plan.lines.size(); ++i) {
    const PlanLine& line = plan.lines[i];
    const Eigen::Vector3f way_m = line.to_m - line.from_m;
    const int count = std::max(1, static_cast<int>(std::ceil(way_m.norm() / config.piece_m)));
    for (int k = 0; k < count; ++k) {
      const float from = static_cast<float>(k) / static_cast<float>(count);
      const float to = static_cast<float>(k + 1) / static_cast<float>(count);
      pieces_.push_back({line.from_m + from * way_m, line.from_m + to * way_m, static_cast<std::uint32_t>(i)});
    }
  }
}

VisibleLines::~VisibleLines() = default;
VisibleLines::VisibleLines(VisibleLines&&) noexcept = default;
VisibleLines& VisibleLines::operator=(VisibleLines&&) noexcept = default;

VisibleLines::Indices VisibleLines::look_from(const Eigen::Vector3f& eye_m) const {
  Indices visible;
  const auto most_m = static_cast<float>(config_.most_m);
  const auto least_rad = static_cast<float>(config_.least_angle_rad);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    const Eigen::Vector3f middle_m = 0.5F * (piece.from_m + piece.to_m);
    const Eigen::Vector3f way_m = middle_m - eye_m;
    const float distance_m = way_m.norm();
    if (distance_m > most_m || distance_m < 2.0F * kShort_m) continue;
    if ((piece.to_m - piece.from_m).norm() < least_rad * distance_m * 0.5F) continue;
    if (angle_between(piece.from_m - eye_m, piece.to_m - eye_m) < 0.5F * least_rad) continue;
    if (!rays_.blocked(eye_m, eye_m + (1.0F - kShort_m / distance_m) * way_m)) {
      visible.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return visible;
}

const VisibleLines::Indices& VisibleLines::from_corner(std::int32_t column, std::int32_t row) {
  const std::int64_t key = key_of(column, row);
  if (const auto known = corners_.find(key); known != corners_.end()) return known->second;
  const Eigen::Vector3d eye_m(column * config_.cell_m, row * config_.cell_m, height_m_);
  const Indices& seen = corners_.emplace(key, look_from(eye_m.cast<float>())).first->second;
  kept_bytes_ += seen.capacity() * sizeof(Indices::value_type);
  return seen;
}

std::vector<PlanLine> VisibleLines::joined(const Indices& pieces, const Eigen::Vector3f& eye_m) const {
  std::vector<PlanLine> lines;
  const auto keep = [&](const Eigen::Vector3f& from_m, const Eigen::Vector3f& to_m) {
    if (angle_between(from_m - eye_m, to_m - eye_m) >= static_cast<float>(config_.least_angle_rad)) {
      lines.push_back({from_m, to_m});
    }
  };
  for (std::size_t first = 0; first < pieces.size();) {
    std::size_t last = first;
    while (last + 1 < pieces.size() && pieces[last + 1] == pieces[last] + 1 &&
           pieces_[pieces[last + 1]].line == pieces_[pieces[first]].line) {
      ++last;
    }
    keep(pieces_[pieces[first]].from_m, pieces_[pieces[last]].to_m);
    first = last + 1;
  }
  return lines;
}

std::span<const PlanLine> VisibleLines::around(const Eigen::Vector2d& point_m) {
  const auto column = static_cast<std::int32_t>(std::floor(point_m.x() / config_.cell_m));
  const auto row = static_cast<std::int32_t>(std::floor(point_m.y() / config_.cell_m));
  const std::int64_t key = key_of(column, row);
  if (const auto known = cells_.find(key); known != cells_.end()) return known->second;
  if (kept_bytes_ > config_.most_kept_bytes) {
    corners_.clear();
    cells_.clear();
    kept_bytes_ = 0;
  }
  const Eigen::Vector3d middle_m((column + 0.5) * config_.cell_m, (row + 0.5) * config_.cell_m, height_m_);
  const Eigen::Vector3f eye_m = middle_m.cast<float>();
  std::optional<Indices> common;
  for (const auto& [dx, dy] : std::array<std::array<std::int32_t, 2>, 4>{{{0, 0}, {1, 0}, {0, 1}, {1, 1}}}) {
    const Eigen::Vector3d at_m((column + dx) * config_.cell_m, (row + dy) * config_.cell_m, height_m_);
    if (rays_.blocked(eye_m, at_m.cast<float>())) continue;  // that corner is another room's, or inside something
    const Indices& seen = from_corner(column + dx, row + dy);
    if (!common) {
      common = seen;
      continue;
    }
    Indices both;
    std::set_intersection(common->begin(), common->end(), seen.begin(), seen.end(), std::back_inserter(both));
    common = std::move(both);
  }
  const std::vector<PlanLine>& lines = cells_.emplace(key, joined(common.value_or(Indices()), eye_m)).first->second;
  kept_bytes_ += lines.capacity() * sizeof(PlanLine);
  return lines;
}

}  // namespace homeward::linemodel
