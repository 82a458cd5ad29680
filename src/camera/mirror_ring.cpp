// SPDX-License-Identifier: Apache-2.0
#include "camera/mirror_ring.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "core/median.hpp"

namespace homeward::camera {
namespace {

constexpr int kSideMin_px = 64;
constexpr int kDirections = 720;
constexpr double kSmoothing_px = 1.2;
constexpr int kCell_px = 4;      // of the votes for the centre
constexpr double kRimMin = 0.2;  // of the shorter side
constexpr double kRimMax = 0.75;
constexpr double kMiddleMin = 0.04;  // of the rim's radius
constexpr double kMiddleMax = 0.6;
constexpr double kEdgeShare = 0.1;  // of the pixels, the steepest, may vote
constexpr float kEdgeMin = 6.0F;    // grey levels over 3 pixels: what counts as an edge
constexpr float kEdgeFull = 30.0F;  // a steeper edge says no more
constexpr double kShareMin = 0.4;
constexpr double kSpreadMax_px = 1.5;  // edges that lie anywhere in the window by chance spread over 2 px and more
constexpr int kCentresTried = 5;

/// +1: bright inside, as at the rim; -1: dark inside, as at the middle.
enum class Bright { kInside = 1, kOutside = -1 };

cv::Mat brightest(const std::vector<Image>& pictures) {
  cv::Mat most;
  for (const Image& picture : pictures) {
    const cv::Mat view(picture.height_px, picture.width_px, picture.channels == 1 ? CV_8UC1 : CV_8UC3,
                       const_cast<std::uint8_t*>(picture.data.data()));
    cv::Mat grey;
    if (picture.channels == 1) {
      grey = view;
    } else {
      cv::cvtColor(view, grey, cv::COLOR_RGB2GRAY);
    }
    cv::Mat smooth;
    grey.convertTo(smooth, CV_32F);
    cv::GaussianBlur(smooth, smooth, {}, kSmoothing_px);
    if (most.empty()) {
      most = smooth;
    } else {
      cv::max(most, smooth, most);
    }
  }
  return most;
}

/// Where most gradients meet, best first.
std::vector<Eigen::Vector2d> centres(const cv::Mat& grey) {
  cv::Mat by_x;
  cv::Mat by_y;
  cv::Scharr(grey, by_x, CV_32F, 1, 0, 1.0 / 32.0);
  cv::Scharr(grey, by_y, CV_32F, 0, 1, 1.0 / 32.0);
  cv::Mat steepness;
  cv::magnitude(by_x, by_y, steepness);
  std::vector<float> sorted(steepness.begin<float>(), steepness.end<float>());
  const auto limit = sorted.end() - static_cast<std::ptrdiff_t>(kEdgeShare * static_cast<double>(sorted.size())) - 1;
  std::nth_element(sorted.begin(), limit, sorted.end());
  const float steep = std::max(*limit, kEdgeMin / 6.0F);
  const double side_px = std::min(grey.rows, grey.cols);
  cv::Mat votes = cv::Mat::zeros(grey.rows / kCell_px + 1, grey.cols / kCell_px + 1, CV_32F);
  for (int v = 0; v < grey.rows; ++v) {
    for (int u = 0; u < grey.cols; ++u) {
      const float length = steepness.at<float>(v, u);
      if (length < steep) continue;
      const double along_x = static_cast<double>(by_x.at<float>(v, u) / length);
      const double along_y = static_cast<double>(by_y.at<float>(v, u) / length);
      for (double radius_px = kRimMin * side_px; radius_px < kRimMax * side_px; radius_px += kCell_px) {
        const int col = static_cast<int>(std::floor((u + radius_px * along_x) / kCell_px));
        const int row = static_cast<int>(std::floor((v + radius_px * along_y) / kCell_px));
        if (col >= 0 && row >= 0 && col < votes.cols && row < votes.rows) votes.at<float>(row, col) += 1.0F;
      }
    }
  }
  cv::GaussianBlur(votes, votes, {}, 1.0);
  std::vector<Eigen::Vector2d> best;
  for (int i = 0; i < kCentresTried; ++i) {
    cv::Point peak;
    cv::minMaxLoc(votes, nullptr, nullptr, nullptr, &peak);
    best.emplace_back((peak.x + 0.5) * kCell_px, (peak.y + 0.5) * kCell_px);
    constexpr int kApart = 4;
    cv::circle(votes, peak, kApart, cv::Scalar(0.0), cv::FILLED);
  }
  return best;
}

/// Bilinear; negative outside.
float sample(const cv::Mat& grey, double u, double v) {
  const int col = static_cast<int>(std::floor(u));
  const int row = static_cast<int>(std::floor(v));
  if (col < 0 || row < 0 || col + 1 >= grey.cols || row + 1 >= grey.rows) return -1.0F;
  const auto right = static_cast<float>(u - col);
  const auto down = static_cast<float>(v - row);
  return (1.0F - down) * ((1.0F - right) * grey.at<float>(row, col) + right * grey.at<float>(row, col + 1)) +
         down * ((1.0F - right) * grey.at<float>(row + 1, col) + right * grey.at<float>(row + 1, col + 1));
}

Eigen::Vector2d towards(int direction) {
  const double angle_rad = 2.0 * M_PI * direction / kDirections;
  return {std::cos(angle_rad), std::sin(angle_rad)};
}

/// How steeply the brightness falls (kInside) or rises (kOutside) outwards; nothing outside the picture.
std::optional<float> edge(const cv::Mat& grey, const Eigen::Vector2d& centre_px, int direction, double radius_px,
                          Bright bright) {
  constexpr double kHalf_px = 1.5;
  const Eigen::Vector2d along = towards(direction);
  const Eigen::Vector2d in = centre_px + (radius_px - kHalf_px) * along;
  const Eigen::Vector2d out = centre_px + (radius_px + kHalf_px) * along;
  const float inner = sample(grey, in.x(), in.y());
  const float outer = sample(grey, out.x(), out.y());
  if (inner < 0.0F || outer < 0.0F) return std::nullopt;
  return static_cast<float>(bright) * (inner - outer);
}

struct RimPoint {
  int direction = 0;
  double radius_px = 0.0;
  float steepness = 0.0F;
};

struct Rim {
  std::vector<RimPoint> points;
  int visible = 0;  // directions in which the whole window lies in the picture
};

/// The steepest point in each direction, at most `window_px` from the circle.
Rim rim_near(const cv::Mat& grey, const Eigen::Vector2d& centre_px, double radius_px, int window_px, Bright bright) {
  Rim rim;
  const int window = 2 * window_px + 1;
  std::vector<float> steep(static_cast<std::size_t>(window));
  for (int direction = 0; direction < kDirections; ++direction) {
    bool whole = true;
    for (int k = -window_px; k <= window_px && whole; ++k) {
      const auto here = edge(grey, centre_px, direction, radius_px + k, bright);
      whole = here.has_value();
      const int at = k + window_px;
      if (whole) steep[static_cast<std::size_t>(at)] = *here;
    }
    if (!whole) continue;
    ++rim.visible;
    const auto top = std::ranges::max_element(steep);
    if (*top < kEdgeMin || top == steep.begin() || top == steep.end() - 1) continue;
    // The top of the parabola through the steepest point and its neighbours.
    const float before = *(top - 1);
    const float after = *(top + 1);
    const float bend = before - 2.0F * *top + after;
    const double shift = bend < 0.0F ? static_cast<double>(0.5F * (before - after) / bend) : 0.0;
    rim.points.push_back({direction, radius_px + static_cast<double>(top - steep.begin()) - window_px + shift, *top});
  }
  return rim;
}

/// The radius at which edges go round best.
double best_radius_px(const cv::Mat& grey, const Eigen::Vector2d& centre_px, double from_px, double to_px,
                      Bright bright) {
  constexpr int kEvery = 4;
  const int count = std::max(1, static_cast<int>(to_px - from_px));
  std::vector<double> sums(static_cast<std::size_t>(count), 0.0);
  std::vector<int> seen(static_cast<std::size_t>(count), 0);
  for (int direction = 0; direction < kDirections; direction += kEvery) {
    for (int k = 0; k < count; ++k) {
      const auto here = edge(grey, centre_px, direction, from_px + k, bright);
      if (!here) break;
      ++seen[static_cast<std::size_t>(k)];
      sums[static_cast<std::size_t>(k)] += static_cast<double>(std::clamp(*here, 0.0F, kEdgeFull));
    }
  }
  double best_px = from_px;
  double best = -1.0;
  for (int k = 0; k < count; ++k) {
    // A few pixels together, as the centre is not exact yet; at least half of the circle must be in the picture.
    constexpr int kNear = 3;
    double sum = 0.0;
    for (int near = std::max(0, k - kNear); near <= std::min(count - 1, k + kNear); ++near) {
      sum += sums[static_cast<std::size_t>(near)];
    }
    const int rays = seen[static_cast<std::size_t>(k)];
    if (2 * rays * kEvery < kDirections) continue;
    if (sum / rays > best) {
      best = sum / rays;
      best_px = from_px + k;
    }
  }
  return best_px;
}

struct Circle {
  Eigen::Vector2d centre_px = Eigen::Vector2d::Zero();
  double radius_px = 0.0;
  double spread_px = 0.0;
  double centre_deviation_px = 0.0;
  double share = 0.0;
};

/// One robust step of the circle towards its points; false when they do not hold it.
bool improve(const Rim& rim, Circle& circle) {
  if (rim.points.size() < kDirections / 8) return false;
  std::vector<double> distances_px;
  const double middle_px = [&] {
    std::vector<double> radii_px;
    for (const RimPoint& point : rim.points) radii_px.push_back(point.radius_px);
    return median(std::move(radii_px));
  }();
  for (const RimPoint& point : rim.points) distances_px.push_back(std::abs(point.radius_px - middle_px));
  constexpr double kOfNormal = 1.4826;
  const double scale_px = std::max(0.1, kOfNormal * median(distances_px));
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (const RimPoint& point : rim.points) {
    const double off_px = point.radius_px - circle.radius_px;
    const double weight = 1.0 / (1.0 + std::pow((point.radius_px - middle_px) / scale_px, 2));
    const Eigen::Vector3d row = towards(point.direction).homogeneous();
    normal += weight * row * row.transpose();
    right += weight * off_px * row;
  }
  const Eigen::Matrix3d covariance = normal.inverse();
  const Eigen::Vector3d step = covariance * right;
  if (!step.allFinite()) return false;
  circle.centre_px += step.head<2>();
  circle.radius_px += step.z();
  circle.spread_px = scale_px;
  circle.centre_deviation_px = scale_px * std::sqrt(covariance.topLeftCorner<2, 2>().eigenvalues().real().maxCoeff());
  return true;
}

/// A circle of edges around `centre_px`, narrowed down to a few pixels.
std::optional<Circle> fit(const cv::Mat& grey, Circle circle, Bright bright) {
  for (const int window_px : {12, 8, 5, 5, 4, 4, 4}) {
    if (!improve(rim_near(grey, circle.centre_px, circle.radius_px, window_px, bright), circle)) return std::nullopt;
  }
  constexpr int kNear_px = 3;
  const Rim rim = rim_near(grey, circle.centre_px, circle.radius_px, kNear_px, bright);
  if (2 * rim.visible < kDirections || circle.spread_px > kSpreadMax_px) return std::nullopt;
  circle.share = static_cast<double>(rim.points.size()) / rim.visible;
  return circle;
}

/// How far the centres found in single pictures lie from the common one (RMS): light and surroundings pull them, which
/// the rim's own scatter does not show. 0 with fewer than three such pictures.
double scatter_px(const std::vector<Image>& pictures, const Circle& common) {
  double sum = 0.0;
  int count = 0;
  for (const Image& picture : pictures) {
    const auto own = fit(brightest({picture}), common, Bright::kInside);
    if (!own || own->share < kShareMin) continue;
    sum += (own->centre_px - common.centre_px).squaredNorm();
    ++count;
  }
  constexpr int kCountMin = 3;
  return count < kCountMin ? 0.0 : std::sqrt(sum / count);
}

}  // namespace

Result<MirrorRing> find_mirror_ring(const std::vector<Image>& pictures) {
  if (pictures.empty()) return fail(ErrorCode::kEmptyInput, "There are no pictures.");
  const Image& first = pictures.front();
  for (const Image& picture : pictures) {
    if (picture.width_px != first.width_px || picture.height_px != first.height_px) {
      return fail(ErrorCode::kWrongImageSize, "The pictures differ in size.");
    }
  }
  if (std::min(first.width_px, first.height_px) < kSideMin_px) {
    return fail(ErrorCode::kInvalidInput, "The pictures are too small to show a mirror.");
  }
  const cv::Mat grey = brightest(pictures);
  const double side_px = std::min(grey.rows, grey.cols);
  std::optional<Circle> rim;
  for (const Eigen::Vector2d& centre_px : centres(grey)) {
    const double radius_px = best_radius_px(grey, centre_px, kRimMin * side_px, kRimMax * side_px, Bright::kInside);
    const auto found = fit(grey, {centre_px, radius_px}, Bright::kInside);
    if (found && (!rim || found->share > rim->share)) rim = found;
  }
  if (!rim || rim->share < kShareMin) {
    return fail(ErrorCode::kTooLittleSupport, "No edge of a mirror goes round in the pictures.");
  }
  MirrorRing ring;
  ring.centre_px = rim->centre_px;
  ring.radius_max_px = rim->radius_px;
  ring.spread_px = rim->spread_px;
  ring.centre_deviation_px = std::max(rim->centre_deviation_px, scatter_px(pictures, *rim));
  ring.rim_share = rim->share;
  const double middle_px =
      best_radius_px(grey, rim->centre_px, kMiddleMin * rim->radius_px, kMiddleMax * rim->radius_px, Bright::kOutside);
  const auto middle = fit(grey, {rim->centre_px, middle_px}, Bright::kOutside);
  if (middle && middle->share >= kShareMin) {
    // The ring has one centre: what the middle hides in any direction is left out.
    ring.radius_min_px = middle->radius_px + (middle->centre_px - rim->centre_px).norm();
    ring.middle_share = middle->share;
  }
  return ring;
}

}  // namespace homeward::camera
