// SPDX-License-Identifier: Apache-2.0
#include "linemodel/expected_view.hpp"

#include <cmath>

namespace homeward::linemodel {
namespace {

constexpr float kLeastSeen_rad = 0.10F;    // shorter parts are not expected, as they are not looked for in pictures
constexpr float kSampleEvery_rad = 0.07F;  // along a line

void add_cells(const SightMap& sights, const Eigen::Vector3f& from, const Eigen::Vector3f& to, int samples,
               std::vector<std::int32_t>& cells) {
  for (int k = 0; k < samples; ++k) {
    const float share = (static_cast<float>(k) + 0.5F) / static_cast<float>(samples);
    const std::int32_t cell = sights.cell((1.0F - share) * from + share * to);
    if (cell != SightMap::kNowhere) cells.push_back(cell);
  }
}

}  // namespace

Expectation::Expectation(const camera::Camera& camera)
    : robot_from_eye_m_(camera.config().robot_from_camera_translation_m), space_(camera.config()), sights_(camera) {}

Eigen::Vector3d Expectation::eye_m(const Pose2& robot) const {
  const Pose2 eye = robot * Pose2{robot_from_eye_m_.x(), robot_from_eye_m_.y(), 0.0};
  return {eye.x_m, eye.y_m, robot_from_eye_m_.z()};
}

void Expectation::expect(const Pose2& robot, std::span<const PlanLine> around, ExpectedView& view,
                         bool with_cells) const {
  view.lines.clear();
  view.cells.clear();
  const Eigen::Vector3f eye = eye_m(robot).cast<float>();
  const auto c = static_cast<float>(std::cos(robot.theta_rad));
  const auto s = static_cast<float>(std::sin(robot.theta_rad));
  const auto in_robot = [&](const Eigen::Vector3f& point_m) {
    const Eigen::Vector3f d = point_m - eye;
    return Eigen::Vector3f(c * d.x() + s * d.y(), c * d.y() - s * d.x(), d.z());
  };
  for (std::size_t i = 0; i < around.size(); ++i) {
    const Eigen::Vector3f from = in_robot(around[i].from_m).normalized();
    const Eigen::Vector3f to = in_robot(around[i].to_m).normalized();
    const Eigen::Vector3f normal = from.cross(to);
    const float whole_rad = rough_atan2(normal.norm(), from.dot(to));
    const int samples = std::clamp(static_cast<int>(whole_rad / kSampleEvery_rad) + 1, 2, SightMap::kMostSamples);
    ExpectedLine line{{}, 0.0F, static_cast<std::int32_t>(view.cells.size()), 0, static_cast<std::int32_t>(i)};
    if (with_cells) {
      add_cells(sights_, from, to, samples, view.cells);
      line.count = static_cast<std::int32_t>(view.cells.size()) - line.first;
    } else {
      line.count = sights_.count_seen(from, to, samples);
    }
    line.length_rad = whole_rad * static_cast<float>(line.count) / static_cast<float>(samples);
    const auto point = line.length_rad < kLeastSeen_rad ? std::nullopt : space_.point(normal);
    if (!point) {
      if (with_cells) view.cells.resize(static_cast<std::size_t>(line.first));
      continue;
    }
    line.point = *point;
    view.lines.push_back(line);
  }
}

}  // namespace homeward::linemodel
