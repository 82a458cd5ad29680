// SPDX-License-Identifier: Apache-2.0
#include "linemodel/line_view.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/angles.hpp"
#include "core/index.hpp"

namespace homeward::linemodel {
namespace {

constexpr double kOverlap = 1.1;         // of neighbouring views: an edge at the seam is whole in one of them
constexpr double kMostFocal_px = 150.0;  // an edge in more pixels is told apart into more pieces, and costs more

/// What a camera sees of the world, upwards and downwards.
struct Elevations {
  double least_rad = 0.0;
  double most_rad = 0.0;
  double px_per_rad = 0.0;  // around the horizon
};

Elevations elevations_of(const camera::Camera& camera) {
  constexpr int kAround = 72;
  constexpr int kUp = 170;  // steps of one degree
  Elevations found{radians(90.0), radians(-90.0), 0.0};
  double most_px = 0.0;
  for (int i = 0; i < kAround; ++i) {
    const double azimuth = 2.0 * kPi * i / kAround;
    std::optional<Eigen::Vector2d> last;
    for (int j = 0; j <= kUp; ++j) {
      const double elevation = radians(j - 85.0);
      const Eigen::Vector3d bearing(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                    std::sin(elevation));
      const auto pixel = camera.pixel(bearing);
      if (pixel) {
        found.least_rad = std::min(found.least_rad, elevation);
        found.most_rad = std::max(found.most_rad, elevation);
        if (last) most_px = std::max(most_px, (*pixel - *last).norm() / radians(1.0));
      }
      last = pixel;
    }
  }
  found.px_per_rad = most_px;
  return found;
}

/// One that looks at an azimuth and an elevation.
LineView view_towards(double azimuth_rad, double elevation_rad, double focal_px, int width_px, int height_px) {
  LineView view;
  const Eigen::Vector3d ahead(std::cos(elevation_rad) * std::cos(azimuth_rad),
                              std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad));
  const Eigen::Vector3d right(std::sin(azimuth_rad), -std::cos(azimuth_rad), 0.0);
  view.robot_from_view.col(0) = right;
  view.robot_from_view.col(1) = ahead.cross(right);
  view.robot_from_view.col(2) = ahead;
  view.focal_px = focal_px;
  view.width_px = width_px;
  view.height_px = height_px;
  view.cx_px = 0.5 * (width_px - 1);
  view.cy_px = 0.5 * (height_px - 1);
  return view;
}

LineView view_of_pinhole(const camera::CameraConfig& config, const camera::Pinhole& pinhole) {
  LineView view;
  const double focal_px = 0.5 * (pinhole.intrinsics.fx_px + pinhole.intrinsics.fy_px);
  view.robot_from_view = config.robot_from_camera_rotation.toRotationMatrix();
  view.focal_px = focal_px;
  view.width_px = config.width_px;
  view.height_px = config.height_px;
  view.cx_px = pinhole.intrinsics.cx_px;
  view.cy_px = pinhole.intrinsics.cy_px;
  return view;
}

std::vector<LineView> views_of(const camera::Camera& camera, int count) {
  if (const auto* pinhole = std::get_if<camera::Pinhole>(&camera.config().model)) {
    return {view_of_pinhole(camera.config(), *pinhole)};
  }
  const Elevations seen = elevations_of(camera);
  const double least = std::max(seen.least_rad, radians(-60.0));
  const double most = std::min(seen.most_rad, radians(60.0));
  const double middle = 0.5 * (least + most);
  const double half_up = 0.5 * (most - least);
  const double half_around = kOverlap * kPi / count;
  const double focal_px = std::min(seen.px_per_rad, kMostFocal_px);
  const int width_px = static_cast<int>(std::ceil(2.0 * focal_px * std::tan(half_around) / std::cos(half_around)));
  const int height_px = static_cast<int>(std::ceil(2.0 * focal_px * std::tan(half_up)));
  std::vector<LineView> views;
  views.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    views.push_back(view_towards(2.0 * kPi * i / count, middle, focal_px, width_px, height_px));
  }
  return views;
}

bool shows_itself(const camera::CameraConfig& config) {
  const auto* pinhole = std::get_if<camera::Pinhole>(&config.model);
  if (pinhole == nullptr || pinhole->intrinsics.fx_px != pinhole->intrinsics.fy_px) return false;
  return std::all_of(pinhole->distortion.begin(), pinhole->distortion.end(), [](double k) { return k == 0.0; });
}

}  // namespace

struct LineViews::Tables {
  struct Table {
    cv::Mat x;  // of the picture's pixel that each pixel of the view shows; -1 where it shows none
    cv::Mat y;
    std::vector<std::uint8_t> seen;

    Table(const camera::Camera& camera, const LineView& view);
  };
  int width_px = 0;
  int height_px = 0;
  std::vector<LineView> views;
  std::vector<Table> tables;  // none where the view is the picture itself
};

LineViews::Tables::Table::Table(const camera::Camera& camera, const LineView& view)
    : x(view.height_px, view.width_px, CV_32F, cv::Scalar(-1.0)),
      y(view.height_px, view.width_px, CV_32F, cv::Scalar(-1.0)),
      seen(at(view.width_px) * at(view.height_px)) {
  for (int v = 0; v < view.height_px; ++v) {
    for (int u = 0; u < view.width_px; ++u) {
      const auto pixel = camera.pixel(view.direction(Eigen::Vector2d(u, v)).normalized());
      if (!pixel) continue;
      x.at<float>(v, u) = static_cast<float>(pixel->x());
      y.at<float>(v, u) = static_cast<float>(pixel->y());
      seen[at(v) * at(view.width_px) + at(u)] = 1;
    }
  }
}

LineViews::LineViews(const camera::Camera& camera, int views) {
  auto tables = std::make_unique<Tables>();
  tables->width_px = camera.config().width_px;
  tables->height_px = camera.config().height_px;
  tables->views = views_of(camera, views);
  if (!shows_itself(camera.config())) {
    for (const LineView& view : tables->views) tables->tables.emplace_back(camera, view);
  }
  tables_ = std::move(tables);
}

LineViews::~LineViews() = default;
LineViews::LineViews(LineViews&&) noexcept = default;
LineViews& LineViews::operator=(LineViews&&) noexcept = default;

const std::vector<LineView>& LineViews::views() const { return tables_->views; }

Result<std::vector<SeenView>> LineViews::look(const Image& picture) const {
  if (picture.empty()) return fail(ErrorCode::kEmptyInput, "The picture has no pixels.");
  if (picture.width_px != tables_->width_px || picture.height_px != tables_->height_px) {
    return fail(ErrorCode::kWrongImageSize, "The picture has " + std::to_string(picture.width_px) + " x " +
                                                std::to_string(picture.height_px) + " pixels, its camera " +
                                                std::to_string(tables_->width_px) + " x " +
                                                std::to_string(tables_->height_px) + ".");
  }
  const cv::Mat shown(picture.height_px, picture.width_px, picture.channels == 1 ? CV_8UC1 : CV_8UC3,
                      const_cast<std::uint8_t*>(picture.data.data()));
  cv::Mat grey = shown;
  if (picture.channels != 1) cv::cvtColor(shown, grey, cv::COLOR_RGB2GRAY);
  std::vector<SeenView> seen;
  for (std::size_t i = 0; i < tables_->views.size(); ++i) {
    const LineView& view = tables_->views[i];
    SeenView one{&view, Image(view.width_px, view.height_px, 1), {}};
    cv::Mat cut(view.height_px, view.width_px, CV_8UC1, one.grey.data.data());
    if (tables_->tables.empty()) {
      grey.copyTo(cut);
      one.seen.assign(one.grey.data.size(), 1);
    } else {
      cv::remap(grey, cut, tables_->tables[i].x, tables_->tables[i].y, cv::INTER_LINEAR, cv::BORDER_CONSTANT);
      one.seen = tables_->tables[i].seen;
    }
    seen.push_back(std::move(one));
  }
  return seen;
}

}  // namespace homeward::linemodel
