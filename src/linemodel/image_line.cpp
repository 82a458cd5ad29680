// SPDX-License-Identifier: Apache-2.0
#include "linemodel/image_line.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/index.hpp"

namespace homeward::linemodel {
namespace {

constexpr int kBorder_px = 3;

/// Whether the camera sees the world all around a pixel of a view.
bool well_inside(const SeenView& seen, const Eigen::Vector2d& pixel_px) {
  const int u = static_cast<int>(std::lround(pixel_px.x()));
  const int v = static_cast<int>(std::lround(pixel_px.y()));
  for (const int dv : {-kBorder_px, 0, kBorder_px}) {
    for (const int du : {-kBorder_px, 0, kBorder_px}) {
      const int x = std::clamp(u + du, 0, seen.view->width_px - 1);
      const int y = std::clamp(v + dv, 0, seen.view->height_px - 1);
      if (seen.seen[at(y) * at(seen.view->width_px) + at(x)] == 0) return false;
    }
  }
  return true;
}

void add_lines(const SeenView& seen, const LineDetection& config, std::vector<ImageLine>& lines) {
  const cv::Mat grey(seen.view->height_px, seen.view->width_px, CV_8UC1,
                     const_cast<std::uint8_t*>(seen.grey.data.data()));
  std::vector<cv::Vec4f> segments;
  cv::createLineSegmentDetector(cv::LSD_REFINE_STD)->detect(grey, segments);
  for (const cv::Vec4f& segment : segments) {
    const Eigen::Vector2d from_px(segment[0], segment[1]);
    const Eigen::Vector2d to_px(segment[2], segment[3]);
    if (!well_inside(seen, from_px) || !well_inside(seen, 0.5 * (from_px + to_px)) || !well_inside(seen, to_px)) {
      continue;
    }
    ImageLine line;
    line.from = seen.view->direction(from_px).normalized();
    line.to = seen.view->direction(to_px).normalized();
    const Eigen::Vector3d normal = line.from.cross(line.to);
    line.length_rad = std::atan2(normal.norm(), line.from.dot(line.to));
    if (line.length_rad < config.least_length_rad) continue;
    line.normal = normal.normalized();
    lines.push_back(line);
  }
}

}  // namespace

Result<std::vector<ImageLine>> detect_lines(const Image& picture, const LineViews& views, const LineDetection& config) {
  const auto seen = views.look(picture);
  if (!seen) return pass_on(seen);
  std::vector<ImageLine> lines;
  for (const SeenView& one : *seen) add_lines(one, config, lines);
  return lines;
}

}  // namespace homeward::linemodel
