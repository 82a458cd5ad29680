// SPDX-License-Identifier: Apache-2.0
#include "cli/repeat_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/imgproc.hpp>
#include <string>

#include "repeat/arc_pose.hpp"

namespace homeward::cli {
namespace {

const cv::Scalar kTracked(40, 190, 90);
const cv::Scalar kOfOtherArcs(60, 140, 230);
const cv::Scalar kSteer(250, 190, 40);
const cv::Scalar kInk(40, 44, 52);
const cv::Scalar kSoft(160, 166, 176);

void draw_features(cv::Mat& canvas, const repeat::Repeater& repeater) {
  for (const repeat::FollowedLandmark& one : repeater.landmarks()) {
    if (!one.is_tracked) continue;
    const cv::Point at(static_cast<int>(std::lround(one.pixel_px.x())),
                       static_cast<int>(std::lround(one.pixel_px.y())));
    cv::circle(canvas, at, 3, one.landmark.in_arc ? kTracked : kOfOtherArcs, 1, cv::LINE_AA);
  }
}

/// By how much it would turn: a line from the lower middle.
void draw_steering(cv::Mat& canvas, double steering_rad) {
  const cv::Point from(canvas.cols / 2, canvas.rows - 1);
  const double length_px = 0.3 * canvas.rows;
  const cv::Point to(from.x - static_cast<int>(std::lround(length_px * std::sin(steering_rad))),
                     from.y - static_cast<int>(std::lround(length_px * std::cos(steering_rad))));
  cv::arrowedLine(canvas, from, to, kSteer, 2, cv::LINE_AA);
}

/// From above, the robot in the middle of the lower third.
class FromAbove {
 public:
  FromAbove(cv::Mat canvas, const repeat::Repeater& repeater) : canvas_(std::move(canvas)), pose_(repeater.pose()) {
    double farthest = 1e-3;
    for (const repeat::KeyPose& key : repeater.surroundings()->keys) {
      if (key.is_placed) farthest = std::max(farthest, seen(key.position).norm());
    }
    px_per_unit_ = 0.6 * canvas_.rows / farthest;
  }

  void draw(const repeat::ArcSurroundings& around) {
    for (const repeat::Landmark& landmark : around.landmarks) {
      if (!landmark.has_distance || !(landmark.nearness > 0.0)) continue;
      const cv::Point at = pixel(landmark.bearing / landmark.nearness);
      if (at.inside({0, 0, canvas_.cols, canvas_.rows}))
        cv::circle(canvas_, at, 1, landmark.in_arc ? kTracked : kSoft, cv::FILLED);
    }
    for (std::size_t i = 0; i + 1 < around.keys.size(); ++i) {
      if (!around.keys[i].is_placed || !around.keys[i + 1].is_placed) continue;
      const bool here = around.arcs[i] == around.arc;
      cv::line(canvas_, pixel(around.keys[i].position), pixel(around.keys[i + 1].position), here ? kSteer : kSoft,
               here ? 2 : 1, cv::LINE_AA);
    }
    for (const repeat::KeyPose& key : around.keys) {
      if (!key.is_placed) continue;
      cv::circle(canvas_, pixel(key.position), 4, kInk, 1, cv::LINE_AA);
      cv::putText(canvas_, std::to_string(key.key), pixel(key.position) + cv::Point(6, 4), cv::FONT_HERSHEY_SIMPLEX,
                  0.35, kInk, 1, cv::LINE_AA);
    }
    const cv::Point robot = pixel(pose_.position);
    const std::array<cv::Point, 3> shape{robot + cv::Point(0, -9), robot + cv::Point(-6, 7), robot + cv::Point(6, 7)};
    cv::fillConvexPoly(canvas_, shape.data(), 3, kOfOtherArcs, cv::LINE_AA);
  }

 private:
  [[nodiscard]] Eigen::Vector2d seen(const Eigen::Vector3d& point) const {
    return (pose_.local_from_current.transpose() * (point - pose_.position)).head<2>();
  }
  [[nodiscard]] cv::Point pixel(const Eigen::Vector3d& point) const {
    constexpr double kFar_px = 1e4;
    const Eigen::Vector2d at = (px_per_unit_ * seen(point)).cwiseMax(-kFar_px).cwiseMin(kFar_px);
    return {canvas_.cols / 2 - static_cast<int>(std::lround(at.y())),
            2 * canvas_.rows / 3 - static_cast<int>(std::lround(at.x()))};
  }

  cv::Mat canvas_;
  repeat::ArcPose pose_;
  double px_per_unit_ = 1.0;
};

/// Two lines: they have to fit beside a small picture.
std::array<std::string, 2> words_of(const repeat::Repeated& said) {
  if (said.is_lost()) return {"lost", ""};
  std::array<char, 80> where{};
  std::array<char, 80> what{};
  std::snprintf(where.data(), where.size(), "arc %d, %d %%, confidence %.2f", said.arc,
                static_cast<int>(std::lround(100.0 * said.progress)), said.confidence);
  std::snprintf(what.data(), what.size(), "%d of %d features", said.tracked, said.expected);
  return {where.data(), what.data()};
}

}  // namespace

Image repeat_picture(const Image& picture, const repeat::Repeater& repeater, const repeat::Repeated& said) {
  Image drawn(2 * picture.width_px, picture.height_px, 3);
  cv::Mat canvas(drawn.height_px, drawn.width_px, CV_8UC3, drawn.data.data());
  canvas.setTo(cv::Scalar(250, 250, 248));
  // OpenCV has no matrix of what may not be written.
  Image copy = picture;
  cv::Mat shown(copy.height_px, copy.width_px, CV_8UC(copy.channels), copy.data.data());
  cv::Mat left = canvas(cv::Rect(0, 0, picture.width_px, picture.height_px));
  if (copy.channels == 1) {
    cv::cvtColor(shown, left, cv::COLOR_GRAY2RGB);
  } else {
    shown.copyTo(left);
  }
  cv::Mat right = canvas(cv::Rect(picture.width_px, 0, picture.width_px, picture.height_px));
  if (!said.is_lost()) {
    draw_features(left, repeater);
    draw_steering(left, said.steering_rad);
    FromAbove(right, repeater).draw(*repeater.surroundings());
  }
  int line_px = 16;
  for (const std::string& words : words_of(said)) {
    cv::putText(right, words, {8, line_px}, cv::FONT_HERSHEY_SIMPLEX, 0.38, kInk, 1, cv::LINE_AA);
    line_px += 14;
  }
  return drawn;
}

}  // namespace homeward::cli
