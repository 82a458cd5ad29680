// SPDX-License-Identifier: Apache-2.0
#include "tracking/tracking_frame.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

namespace homeward::tracking {
namespace {

constexpr int kSeam_px = 48;  // columns repeated on either side: more than a patch on the coarsest level reaches
constexpr int kMostLevels = 3;
constexpr int kLargestWindow_px = 21;
constexpr int kMostWithin_px = 20;  // with half a window it stays within the repeated seam

}  // namespace

struct TrackingFrame::Parts {
  camera::PanoramaGeometry geometry;
  cv::Mat grey;   // with the seam repeated
  cv::Mat valid;  // 255 where the camera sees, with the seam repeated
  std::vector<cv::Mat> pyramid;

  /// A column of the panorama, turned whole turns, in the padded picture.
  [[nodiscard]] float column(double u_px) const {
    const double width = geometry.width_px;
    const double wrapped = u_px - width * std::floor((u_px + 0.5) / width);
    return static_cast<float>(wrapped + kSeam_px);
  }
  [[nodiscard]] Eigen::Vector2d pixel(const cv::Point2f& point) const {
    const double width = geometry.width_px;
    const double u_px = static_cast<double>(point.x) - kSeam_px;
    return {u_px - width * std::floor((u_px + 0.5) / width), static_cast<double>(point.y)};
  }
  [[nodiscard]] bool sees(const cv::Point2f& point) const {
    const int u = cvRound(point.x);
    const int v = cvRound(point.y);
    return u >= 0 && v >= 0 && u < valid.cols && v < valid.rows && valid.at<std::uint8_t>(v, u) != 0;
  }
};

TrackingFrame::TrackingFrame(const camera::Panorama& panorama) {
  auto parts = std::make_shared<Parts>();
  parts->geometry = panorama.geometry;
  const cv::Mat rgb(panorama.rgb.height_px, panorama.rgb.width_px, CV_8UC3,
                    const_cast<std::uint8_t*>(panorama.rgb.data.data()));  // cv::Mat has no read-only view
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  cv::copyMakeBorder(grey, parts->grey, 0, 0, kSeam_px, kSeam_px, cv::BORDER_WRAP);
  const cv::Mat valid(panorama.rgb.height_px, panorama.rgb.width_px, CV_8UC1,
                      const_cast<std::uint8_t*>(panorama.valid.data()));
  cv::copyMakeBorder(valid, parts->valid, 0, 0, kSeam_px, kSeam_px, cv::BORDER_WRAP);
  cv::buildOpticalFlowPyramid(parts->grey, parts->pyramid, {kLargestWindow_px, kLargestWindow_px}, kMostLevels, true);
  parts_ = std::move(parts);
}

const camera::PanoramaGeometry& TrackingFrame::geometry() const { return parts_->geometry; }

std::vector<std::uint8_t> TrackingFrame::patch(const Eigen::Vector2d& pixel_px, int side_px) const {
  const cv::Point2f centre(parts_->column(pixel_px.x()), static_cast<float>(pixel_px.y()));
  const int half = side_px / 2;
  const int u = cvRound(centre.x) - half;
  const int v = cvRound(centre.y) - half;
  if (u < 0 || v < 0 || u + side_px > parts_->grey.cols || v + side_px > parts_->grey.rows || !parts_->sees(centre)) {
    return {};
  }
  cv::Mat cut;
  cv::getRectSubPix(parts_->grey, {side_px, side_px}, centre, cut);
  return {cut.datastart, cut.dataend};
}

Eigen::Vector2d TrackingFrame::strongest_corner(const Eigen::Vector2d& pixel_px, int within_px, int window_px) const {
  const cv::Point2f centre(parts_->column(pixel_px.x()), static_cast<float>(pixel_px.y()));
  const cv::Point middle(cvRound(centre.x), cvRound(centre.y));
  if (within_px <= 0 || !parts_->sees(centre)) return pixel_px;
  const int within = std::min(within_px, kMostWithin_px);
  const int reach = within + window_px / 2 + 1;  // and the derivative's neighbours
  const cv::Rect around = cv::Rect(middle.x - reach, middle.y - reach, 2 * reach + 1, 2 * reach + 1) &
                          cv::Rect(0, 0, parts_->grey.cols, parts_->grey.rows);
  cv::Mat strength;
  cv::cornerMinEigenVal(parts_->grey(around), strength, window_px, 3);
  const auto strength_at = [&](const cv::Point& at) { return strength.at<float>(at.y - around.y, at.x - around.x); };
  cv::Point best = middle;
  const int half = window_px / 2;  // the patch must be in the picture
  for (int v = std::max(half, middle.y - within); v < std::min(parts_->grey.rows - half, middle.y + within + 1); ++v) {
    for (int u = middle.x - within; u <= middle.x + within; ++u) {
      const cv::Point at(u, v);
      const cv::Point off = at - middle;
      if (off.dot(off) > within * within || !parts_->sees(cv::Point2f(at))) continue;
      if (strength_at(at) > strength_at(best)) best = at;
    }
  }
  return best == middle ? pixel_px : parts_->pixel(cv::Point2f(best));
}

std::vector<TrackedPoint> TrackingFrame::track_into(const TrackingFrame& next,
                                                    std::span<const Eigen::Vector2d> points_px,
                                                    std::span<const Eigen::Vector2d> guesses_px,
                                                    const TrackConfig& config) const {
  std::vector<TrackedPoint> result(points_px.size());
  if (points_px.empty()) return result;
  std::vector<cv::Point2f> from;
  std::vector<cv::Point2f> to;
  for (std::size_t i = 0; i < points_px.size(); ++i) {
    from.emplace_back(parts_->column(points_px[i].x()), static_cast<float>(points_px[i].y()));
    to.emplace_back(parts_->column(guesses_px[i].x()), static_cast<float>(guesses_px[i].y()));
  }
  const cv::Size window(config.window_px, config.window_px);
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, config.iterations, 0.01);
  std::vector<std::uint8_t> found;
  std::vector<std::uint8_t> returned;
  std::vector<float> error;
  cv::calcOpticalFlowPyrLK(parts_->pyramid, next.parts_->pyramid, from, to, found, error, window, config.levels, until,
                           cv::OPTFLOW_USE_INITIAL_FLOW, config.least_contrast);
  std::vector<cv::Point2f> back = from;
  cv::calcOpticalFlowPyrLK(next.parts_->pyramid, parts_->pyramid, to, back, returned, error, window, config.levels,
                           until, cv::OPTFLOW_USE_INITIAL_FLOW, config.least_contrast);
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (found[i] == 0 || returned[i] == 0 || !next.parts_->sees(to[i])) continue;
    if (std::hypot(back[i].x - from[i].x, back[i].y - from[i].y) > static_cast<float>(config.most_return_px)) continue;
    result[i] = {next.parts_->pixel(to[i]), true};
  }
  return result;
}

TrackedPoint TrackingFrame::find(std::span<const std::uint8_t> patch, int side_px, const Eigen::Vector2d& guess_px,
                                 int search_px, double least_correlation) const {
  const cv::Point2f centre(parts_->column(guess_px.x()), static_cast<float>(guess_px.y()));
  const int reach = side_px / 2 + search_px;
  const cv::Rect around(cvRound(centre.x) - reach, cvRound(centre.y) - reach, 2 * reach + 1, 2 * reach + 1);
  const bool inside =
      around.x >= 0 && around.y >= 0 && around.br().x <= parts_->grey.cols && around.br().y <= parts_->grey.rows;
  if (!inside || patch.size() != static_cast<std::size_t>(side_px) * static_cast<std::size_t>(side_px)) return {};
  const cv::Mat wanted(side_px, side_px, CV_8UC1, const_cast<std::uint8_t*>(patch.data()));
  cv::Mat score;
  cv::matchTemplate(parts_->grey(around), wanted, score, cv::TM_CCOEFF_NORMED);
  double best = 0.0;
  cv::Point where;
  cv::minMaxLoc(score, nullptr, &best, nullptr, &where);
  if (!(best >= least_correlation) || where.x == 0 || where.y == 0 || where.x == score.cols - 1 ||
      where.y == score.rows - 1) {
    return {};
  }
  // The peak between the cells, by a parabola each way.
  const auto peak = [&](int du, int dv) {
    const float before = score.at<float>(where.y - dv, where.x - du);
    const float middle = score.at<float>(where.y, where.x);
    const float after = score.at<float>(where.y + dv, where.x + du);
    const float bend = before - 2.0F * middle + after;
    return bend < 0.0F ? 0.5F * (before - after) / bend : 0.0F;
  };
  const int half = side_px / 2;
  const cv::Point2f at(static_cast<float>(around.x + where.x + half) + peak(1, 0),
                       static_cast<float>(around.y + where.y + half) + peak(0, 1));
  if (!parts_->sees(at)) return {};
  return {parts_->pixel(at), true};
}

}  // namespace homeward::tracking
