// SPDX-License-Identifier: Apache-2.0
#include "feature_followers.hpp"

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <utility>
#include <variant>

#include "tracking/tracking_frame.hpp"

namespace homeward::bench {
namespace {

using tracking::FeatureState;

class ByReference final : public Follower {
 public:
  ByReference(const tracking::FeatureTrackerConfig& config, const tracking::PyramidConfig& pyramid, bool renews)
      : tracker_(tracking::FeatureTracker::create(config).value()), pyramid_(pyramid), renews_(renews) {}

  void start(const Image& grey, const std::vector<Eigen::Vector2d>& points_px) override {
    at_px = points_px;
    is_alive.assign(points_px.size(), true);
    states.assign(points_px.size(), FeatureState::kTracked);
    scales_.assign(points_px.size(), 1.0);
    refer(tracking::ImagePyramid::build(grey, pyramid_).value());
  }

  void follow(const Image& grey) override {
    const auto picture = tracking::ImagePyramid::build(grey, pyramid_).value();
    std::vector<tracking::FeatureGuess> guesses;
    for (std::size_t r = 0; r < of_reference_.size(); ++r) {
      const std::size_t i = of_reference_[r];
      if (is_alive[i]) guesses.push_back({r, at_px[i], scales_[i]});
    }
    const auto found = tracker_.track(picture, guesses);
    for (std::size_t g = 0; g < found.size(); ++g) {
      const std::size_t i = of_reference_[guesses[g].reference];
      states[i] = found[g].state;
      is_alive[i] = found[g].state == FeatureState::kTracked;
      at_px[i] = found[g].pixel_px;
      scales_[i] = found[g].scale;
    }
    if (renews_) refer(picture);
  }

 private:
  void refer(const tracking::ImagePyramid& picture) {
    tracker_.clear();
    of_reference_.clear();
    for (std::size_t i = 0; i < at_px.size(); ++i) {
      if (!is_alive[i]) continue;
      const auto state = tracker_.add(picture, {&at_px[i], 1}).front();
      is_alive[i] = state == tracking::ReferenceState::kTaken;
      if (!is_alive[i]) states[i] = FeatureState::kBadGuess;
      if (is_alive[i]) of_reference_.push_back(i);
      scales_[i] = 1.0;
    }
  }

  tracking::FeatureTracker tracker_;
  tracking::PyramidConfig pyramid_;
  bool renews_;
  std::vector<double> scales_;
  std::vector<std::size_t> of_reference_;
};

constexpr int kWindow_px = 15;
constexpr int kCoarserLevels = 2;
constexpr double kMostReturn_px = 0.6;  // as TrackConfig has it

/// OpenCV's pyramidal Lucas-Kanade, checked by tracking back: from the picture before, or from the first one.
class ByOpenCv final : public Follower {
 public:
  explicit ByOpenCv(bool from_first) : from_first_(from_first) {}

  void start(const Image& grey, const std::vector<Eigen::Vector2d>& points_px) override {
    at_px = points_px;
    is_alive.assign(points_px.size(), true);
    from_ = pyramid(grey);
    from_px_ = points_px;
  }

  void follow(const Image& grey) override {
    std::vector<cv::Mat> now = pyramid(grey);
    std::vector<std::size_t> which;
    std::vector<cv::Point2f> from;
    std::vector<cv::Point2f> to;
    for (std::size_t i = 0; i < at_px.size(); ++i) {
      if (!is_alive[i]) continue;
      which.push_back(i);
      from.emplace_back(static_cast<float>(from_px_[i].x()), static_cast<float>(from_px_[i].y()));
      to.emplace_back(static_cast<float>(at_px[i].x()), static_cast<float>(at_px[i].y()));
    }
    if (which.empty()) return;
    const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 20, 0.01);
    const cv::Size window(kWindow_px, kWindow_px);
    std::vector<std::uint8_t> found;
    std::vector<std::uint8_t> returned;
    std::vector<float> error;
    cv::calcOpticalFlowPyrLK(from_, now, from, to, found, error, window, kCoarserLevels, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW, 1e-3);
    std::vector<cv::Point2f> back = from;
    cv::calcOpticalFlowPyrLK(now, from_, to, back, returned, error, window, kCoarserLevels, until,
                             cv::OPTFLOW_USE_INITIAL_FLOW, 1e-3);
    for (std::size_t k = 0; k < which.size(); ++k) {
      const std::size_t i = which[k];
      const cv::Point2f off = back[k] - from[k];
      at_px[i] = {static_cast<double>(to[k].x), static_cast<double>(to[k].y)};
      const bool in = to[k].x >= 0 && to[k].y >= 0 && to[k].x < static_cast<float>(grey.width_px) &&
                      to[k].y < static_cast<float>(grey.height_px);
      is_alive[i] = found[k] != 0 && returned[k] != 0 && in && std::hypot(off.x, off.y) <= kMostReturn_px;
    }
    if (from_first_) return;
    from_ = std::move(now);
    from_px_ = at_px;
  }

 private:
  static std::vector<cv::Mat> pyramid(const Image& grey) {
    const cv::Mat pixels(grey.height_px, grey.width_px, CV_8UC1, const_cast<std::uint8_t*>(grey.data.data()));
    std::vector<cv::Mat> levels;
    cv::buildOpticalFlowPyramid(pixels, levels, {kWindow_px, kWindow_px}, kCoarserLevels, true, cv::BORDER_REFLECT_101,
                                cv::BORDER_CONSTANT, false);
    return levels;
  }

  bool from_first_;
  std::vector<cv::Mat> from_;
  std::vector<Eigen::Vector2d> from_px_;
};

/// What homing tracks with: the picture taken for a panorama, whose left and right edges it joins.
class ByHoming final : public Follower {
 public:
  void start(const Image& grey, const std::vector<Eigen::Vector2d>& points_px) override {
    at_px = points_px;
    is_alive.assign(points_px.size(), true);
    before_ = frame(grey);
  }

  void follow(const Image& grey) override {
    tracking::TrackingFrame now = frame(grey);
    std::vector<std::size_t> which;
    std::vector<Eigen::Vector2d> points_px;
    for (std::size_t i = 0; i < at_px.size(); ++i) {
      if (!is_alive[i]) continue;
      which.push_back(i);
      points_px.push_back(at_px[i]);
    }
    const auto found = before_.track_into(now, points_px, points_px, {});
    for (std::size_t k = 0; k < which.size(); ++k) {
      is_alive[which[k]] = found[k].found;
      at_px[which[k]] = found[k].pixel_px;
    }
    before_ = std::move(now);
  }

 private:
  static tracking::TrackingFrame frame(const Image& grey) {
    camera::Panorama panorama;
    panorama.geometry.width_px = grey.width_px;
    panorama.rgb = Image(grey.width_px, grey.height_px, 3);
    for (std::size_t i = 0; i < grey.data.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) panorama.rgb.data[3 * i + c] = grey.data[i];
    }
    panorama.valid.assign(grey.data.size(), 1);
    return tracking::TrackingFrame(panorama);
  }

  tracking::TrackingFrame before_;
};

/// Another way on the strip of a panorama that the lens sees: azimuth and elevation instead of the pinhole's pixels, as
/// many of them an angle as in the middle of the picture.
class OnStrip final : public Follower {
 public:
  OnStrip(const camera::CameraConfig& camera, std::unique_ptr<Follower> way)
      : lens_(std::get<camera::Pinhole>(camera.model).intrinsics), way_(std::move(way)) {
    const double left_rad = std::atan(lens_.cx_px / lens_.fx_px);
    const double right_rad = std::atan((camera.width_px - 1.0 - lens_.cx_px) / lens_.fx_px);
    const double top_rad = std::atan(lens_.cy_px / lens_.fy_px);
    const double bottom_rad = std::atan((camera.height_px - 1.0 - lens_.cy_px) / lens_.fy_px);
    middle_px_ = {left_rad * lens_.fx_px, top_rad * lens_.fx_px};
    width_px_ = static_cast<int>((left_rad + right_rad) * lens_.fx_px) + 1;
    height_px_ = static_cast<int>((top_rad + bottom_rad) * lens_.fx_px) + 1;
    columns_ = cv::Mat(height_px_, width_px_, CV_32FC1);
    rows_ = cv::Mat(height_px_, width_px_, CV_32FC1);
    for (int v = 0; v < height_px_; ++v) {
      for (int u = 0; u < width_px_; ++u) {
        const Eigen::Vector2d raw_px = in_picture({u, v});
        columns_.at<float>(v, u) = static_cast<float>(raw_px.x());
        rows_.at<float>(v, u) = static_cast<float>(raw_px.y());
      }
    }
  }

  void start(const Image& grey, const std::vector<Eigen::Vector2d>& points_px) override {
    std::vector<Eigen::Vector2d> on_strip_px;
    for (const Eigen::Vector2d& point_px : points_px) on_strip_px.push_back(on_strip(point_px));
    way_->start(strip(grey), on_strip_px);
    at_px = points_px;
    is_alive = way_->is_alive;
  }

  void follow(const Image& grey) override {
    way_->follow(strip(grey));
    is_alive = way_->is_alive;
    for (std::size_t i = 0; i < at_px.size(); ++i) {
      at_px[i] = in_picture(way_->at_px[i]);
      const bool in = at_px[i].x() >= 0.0 && at_px[i].y() >= 0.0 && at_px[i].x() <= grey.width_px - 1.0 &&
                      at_px[i].y() <= grey.height_px - 1.0;
      is_alive[i] = is_alive[i] && in;
    }
  }

 private:
  [[nodiscard]] Eigen::Vector2d in_picture(const Eigen::Vector2d& strip_px) const {
    const double azimuth_rad = (strip_px.x() - middle_px_.x()) / lens_.fx_px;  // to the right
    const double elevation_rad = (middle_px_.y() - strip_px.y()) / lens_.fx_px;
    return {lens_.cx_px + lens_.fx_px * std::tan(azimuth_rad),
            lens_.cy_px - lens_.fy_px * std::tan(elevation_rad) / std::cos(azimuth_rad)};
  }
  [[nodiscard]] Eigen::Vector2d on_strip(const Eigen::Vector2d& raw_px) const {
    const double right = (raw_px.x() - lens_.cx_px) / lens_.fx_px;
    const double down = (raw_px.y() - lens_.cy_px) / lens_.fy_px;
    return {middle_px_.x() + lens_.fx_px * std::atan(right),
            middle_px_.y() + lens_.fx_px * std::atan(down / std::hypot(1.0, right))};
  }
  [[nodiscard]] Image strip(const Image& grey) const {
    const cv::Mat raw(grey.height_px, grey.width_px, CV_8UC1, const_cast<std::uint8_t*>(grey.data.data()));
    Image made(width_px_, height_px_, 1);
    cv::Mat there(height_px_, width_px_, CV_8UC1, made.data.data());
    cv::remap(raw, there, columns_, rows_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return made;
  }

  camera::Intrinsics lens_;
  std::unique_ptr<Follower> way_;
  Eigen::Vector2d middle_px_ = Eigen::Vector2d::Zero();
  int width_px_ = 0;
  int height_px_ = 0;
  cv::Mat columns_, rows_;
};

}  // namespace

std::vector<NamedFollower> all_followers(const camera::CameraConfig& camera) {
  std::vector<NamedFollower> all;
  const auto add = [&](const std::string& name, auto change, bool renews = false) {
    all.push_back({name, [change, renews]() -> std::unique_ptr<Follower> {
                     tracking::FeatureTrackerConfig config;
                     tracking::PyramidConfig pyramid;
                     change(config, pyramid);
                     return std::make_unique<ByReference>(config, pyramid, renews);
                   }});
  };
  using Config = tracking::FeatureTrackerConfig;
  using Pyramid = tracking::PyramidConfig;
  add("feature tracker", [](Config&, Pyramid&) {});
  add("without scale", [](Config& config, Pyramid&) { config.changes.scale = false; });
  add("without contrast", [](Config& config, Pyramid&) { config.changes.contrast = false; });
  add("without residual check",
      [](Config& config, Pyramid&) { config.most_residual = std::numeric_limits<double>::max(); });
  add(
      "reference renewed each picture", [](Config&, Pyramid&) {}, true);
  add("one level", [](Config&, Pyramid& pyramid) { pyramid.levels = 1; });
  add("window of 11", [](Config& config, Pyramid&) { config.window_px = 11; });
  add("R = 4", [](Config& config, Pyramid&) { config.most_residual = 4.0; });
  add("R = 10", [](Config& config, Pyramid&) { config.most_residual = 10.0; });
  add("smoothing 0.5", [](Config&, Pyramid& pyramid) { pyramid.smoothing_px = 0.5; });
  add("smoothing 1.2", [](Config&, Pyramid& pyramid) { pyramid.smoothing_px = 1.2; });
  all.push_back({"OpenCV LK, picture to picture", [] { return std::make_unique<ByOpenCv>(false); }});
  all.push_back({"OpenCV LK, from the first", [] { return std::make_unique<ByOpenCv>(true); }});
  all.push_back({"homing's (TrackingFrame)", [] { return std::make_unique<ByHoming>(); }});
  const auto on_strip = [&](const std::string& name, auto make) {
    all.push_back({name + ", on the panorama's strip", [camera, make]() -> std::unique_ptr<Follower> {
                     return std::make_unique<OnStrip>(camera, make());
                   }});
  };
  on_strip("feature tracker", all.front().make);
  on_strip("homing's (TrackingFrame)", [] { return std::make_unique<ByHoming>(); });
  return all;
}

}  // namespace homeward::bench
