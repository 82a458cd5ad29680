// SPDX-License-Identifier: Apache-2.0
#include "cli/plan_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace homeward::cli {
namespace {

const cv::Scalar kSeen(70, 120, 220);
const cv::Scalar kConfirmed(30, 180, 80);
const cv::Scalar kNotConfirmed(225, 70, 60);
const cv::Scalar kPlanInk(70, 76, 86);
const cv::Scalar kCloud(235, 140, 30);
constexpr int kMargin_px = 12;

/// A straight edge as a camera shows it, which may be a curve: from one direction (robot frame) to another.
void draw_edge(cv::Mat& canvas, const camera::Camera& camera, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
               const cv::Scalar& colour, int thickness) {
  constexpr int kSteps = 16;
  std::optional<cv::Point> last;
  for (int k = 0; k <= kSteps; ++k) {
    const double share = static_cast<double>(k) / kSteps;
    const auto pixel = camera.pixel(((1.0 - share) * from + share * to).normalized());
    if (!pixel) {
      last.reset();
      continue;
    }
    const cv::Point here(static_cast<int>(std::lround(pixel->x())), static_cast<int>(std::lround(pixel->y())));
    // Across the seam of a panorama an edge goes on at the other side.
    if (last && std::abs(here.x - last->x) < canvas.cols / 4)
      cv::line(canvas, *last, here, colour, thickness, cv::LINE_AA);
    last = here;
  }
}

/// The plan from above, as large as fits.
class PlanFromAbove {
 public:
  PlanFromAbove(cv::Mat canvas, const linemodel::Plan& plan) : canvas_(std::move(canvas)) {
    Eigen::AlignedBox2f box;
    for (const linemodel::PlanLine& line : plan.lines) {
      box.extend(line.from_m.head<2>());
      box.extend(line.to_m.head<2>());
    }
    const Eigen::Vector2f size_m = box.sizes().cwiseMax(0.1F);
    px_per_m_ = std::min((canvas_.cols - 2 * kMargin_px) / size_m.x(), (canvas_.rows - 2 * kMargin_px) / size_m.y());
    middle_m_ = box.center().cast<double>();
    for (const linemodel::PlanLine& line : plan.lines) {
      cv::line(canvas_, pixel(line.from_m.head<2>().cast<double>()), pixel(line.to_m.head<2>().cast<double>()),
               kPlanInk, 1, cv::LINE_AA);
    }
  }

  void draw(const linemodel::PlanTracker& tracker, const linemodel::PlanEstimate& said) {
    for (const linemodel::Particle& particle : tracker.particles()) {
      cv::circle(canvas_, pixel(position_m(particle.pose)), 1, kCloud, cv::FILLED);
    }
    const bool known = said.lost == linemodel::PlanLost::kNo;
    const Pose2 ahead = said.pose * Pose2{0.8, 0.0, 0.0};
    cv::circle(canvas_, pixel(position_m(said.pose)), 5, known ? kConfirmed : kNotConfirmed, 2, cv::LINE_AA);
    cv::arrowedLine(canvas_, pixel(position_m(said.pose)), pixel(position_m(ahead)), known ? kConfirmed : kNotConfirmed,
                    2, cv::LINE_AA, 0, 0.3);
  }

 private:
  [[nodiscard]] cv::Point pixel(const Eigen::Vector2d& point_m) const {
    const Eigen::Vector2d off = px_per_m_ * (point_m - middle_m_);
    return {canvas_.cols / 2 + static_cast<int>(std::lround(off.x())),
            canvas_.rows / 2 - static_cast<int>(std::lround(off.y()))};
  }

  cv::Mat canvas_;
  double px_per_m_ = 1.0;
  Eigen::Vector2d middle_m_ = Eigen::Vector2d::Zero();
};

}  // namespace

Image plan_picture(const Image& picture, const camera::Camera& camera, const linemodel::Plan& plan,
                   linemodel::PlanTracker& tracker, const linemodel::PlanEstimate& said) {
  Image drawn(2 * picture.width_px, picture.height_px, 3);
  cv::Mat canvas(drawn.height_px, drawn.width_px, CV_8UC3, drawn.data.data());
  canvas.setTo(cv::Scalar::all(255));
  cv::Mat seen = canvas.colRange(0, picture.width_px);
  cv::Mat(picture.height_px, picture.width_px, CV_8UC3, const_cast<std::uint8_t*>(picture.data.data())).copyTo(seen);
  for (const linemodel::ImageLine& line : tracker.picture_lines())
    draw_edge(seen, camera, line.from, line.to, kSeen, 1);
  const Eigen::Vector3d eye_m = tracker.expectation().eye_m(said.pose);
  const Eigen::Matrix3d robot_from_plan = Eigen::AngleAxisd(-said.pose.theta_rad, Eigen::Vector3d::UnitZ()).matrix();
  for (const linemodel::JudgedLine& one : tracker.judged(said.pose)) {
    draw_edge(seen, camera, robot_from_plan * (one.line.from_m.cast<double>() - eye_m),
              robot_from_plan * (one.line.to_m.cast<double>() - eye_m), one.confirmed ? kConfirmed : kNotConfirmed, 2);
  }
  PlanFromAbove(canvas.colRange(picture.width_px, 2 * picture.width_px), plan).draw(tracker, said);
  return drawn;
}

}  // namespace homeward::cli
