// SPDX-License-Identifier: Apache-2.0
#include "tracking/harris.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>

namespace homeward::tracking {
namespace {

cv::Mat strengths(const GreyLevel& level, const HarrisConfig& config) {
  const cv::Mat grey(level.height_px, level.width_px, CV_32F, const_cast<float*>(level.row(0)),
                     static_cast<std::size_t>(level.stride) * sizeof(float));  // cv::Mat has no read-only view
  cv::Mat strength;
  cv::cornerHarris(grey, strength, config.window_px, 3, config.sensitivity);
  return strength;
}

/// Corners stronger than their eight neighbours; of equal neighbours the first.
std::vector<Corner> peaks(const cv::Mat& strength, double scale, const HarrisConfig& config) {
  std::vector<Corner> found;
  const int margin = std::max(1, config.margin_px);
  for (int v = margin; v < strength.rows - margin; ++v) {
    const float* above = strength.ptr<float>(v - 1);
    const float* row = strength.ptr<float>(v);
    const float* below = strength.ptr<float>(v + 1);
    for (int u = margin; u < strength.cols - margin; ++u) {
      const float here = row[u];
      if (!(scale * static_cast<double>(here) >= config.least_strength)) continue;
      const float before = std::max({above[u - 1], above[u], above[u + 1], row[u - 1]});
      const float after = std::max({row[u + 1], below[u - 1], below[u], below[u + 1]});
      if (here > before && here >= after) found.push_back({{u, v}, scale * static_cast<double>(here)});
    }
  }
  std::sort(found.begin(), found.end(), [](const Corner& a, const Corner& b) {
    return std::tuple(-a.strength, a.pixel_px.y(), a.pixel_px.x()) <
           std::tuple(-b.strength, b.pixel_px.y(), b.pixel_px.x());
  });
  return found;
}

/// Which points are taken, in squares of the spacing's side: what is too near lies in one of nine.
class Taken {
 public:
  Taken(int width_px, int height_px, double spacing_px)
      : spacing_px_(spacing_px),
        side_px_(std::max(1.0, spacing_px)),
        across_(static_cast<int>(width_px / side_px_) + 1),
        down_(static_cast<int>(height_px / side_px_) + 1),
        squares_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_)) {}

  void add(const Eigen::Vector2d& pixel_px) {
    if (const auto [u, v] = square(pixel_px); u >= 0 && v >= 0 && u < across_ && v < down_) {
      squares_[index(u, v)].push_back(pixel_px);
    }
  }
  [[nodiscard]] bool is_near(const Eigen::Vector2d& pixel_px) const {
    const auto [middle_u, middle_v] = square(pixel_px);
    for (int v = std::max(0, middle_v - 1); v <= std::min(down_ - 1, middle_v + 1); ++v) {
      for (int u = std::max(0, middle_u - 1); u <= std::min(across_ - 1, middle_u + 1); ++u) {
        for (const Eigen::Vector2d& other : squares_[index(u, v)]) {
          if ((other - pixel_px).norm() < spacing_px_) return true;
        }
      }
    }
    return false;
  }

 private:
  [[nodiscard]] std::pair<int, int> square(const Eigen::Vector2d& pixel_px) const {
    const double most = 1e6;
    const auto of = [&](double at_px) {
      return static_cast<int>(std::floor(std::clamp(at_px / side_px_, -most, most)));
    };
    return pixel_px.allFinite() ? std::pair(of(pixel_px.x()), of(pixel_px.y())) : std::pair(-2, -2);
  }
  [[nodiscard]] std::size_t index(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(u);
  }

  double spacing_px_;
  double side_px_;
  int across_;
  int down_;
  std::vector<std::vector<Eigen::Vector2d>> squares_;
};

}  // namespace

std::vector<std::string> problems(const HarrisConfig& config) {
  std::vector<std::string> found;
  const auto expect = [&](bool holds, const char* problem) {
    if (!holds) found.emplace_back(problem);
  };
  expect(config.most >= 0, "most is negative");
  expect(config.spacing_px >= 0.0 && config.spacing_px < 1e4, "spacing_px is not 0 to 10000");
  expect(config.cells_across >= 1 && config.cells_across <= 256, "cells_across is not 1 to 256");
  expect(config.cells_down >= 1 && config.cells_down <= 256, "cells_down is not 1 to 256");
  expect(config.cells_share >= 0.0, "cells_share is negative");
  expect(config.margin_px >= 0, "margin_px is negative");
  expect(config.window_px >= 1 && config.window_px <= 31 && config.window_px % 2 == 1, "window_px is not odd, 1 to 31");
  expect(config.sensitivity >= 0.0 && config.sensitivity < 0.25, "sensitivity is not 0 to 0.25");
  expect(config.least_strength > 0.0, "least_strength is not positive");
  return found;
}

Result<std::vector<Corner>> harris_corners(const ImagePyramid& picture, const HarrisConfig& config,
                                           std::span<const Eigen::Vector2d> occupied_px) {
  if (const auto wrong = problems(config); !wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  const cv::Mat strength = strengths(picture.levels().front(), config);
  // With gradients g in grey levels a pixel, OpenCV's sums over the window are 4 times the mean of g g.
  constexpr double kToMean = 1.0 / 16.0;
  Taken taken(picture.width_px(), picture.height_px(), config.spacing_px);
  for (const Eigen::Vector2d& pixel_px : occupied_px) taken.add(pixel_px);

  const int cells = config.cells_across * config.cells_down;
  const double even = static_cast<double>(config.most) / cells;
  const int most_in_cell =
      config.cells_share > 0.0 ? static_cast<int>(std::ceil(config.cells_share * even)) : config.most;
  std::vector<int> in_cell(static_cast<std::size_t>(cells));
  std::vector<Corner> chosen;
  for (const Corner& corner : peaks(strength, kToMean, config)) {
    if (static_cast<int>(chosen.size()) >= config.most) break;
    const int across = static_cast<int>(corner.pixel_px.x() * config.cells_across / picture.width_px());
    const int down = static_cast<int>(corner.pixel_px.y() * config.cells_down / picture.height_px());
    int& count = in_cell[static_cast<std::size_t>(down) * static_cast<std::size_t>(config.cells_across) +
                         static_cast<std::size_t>(across)];
    if (count >= most_in_cell || taken.is_near(corner.pixel_px)) continue;
    taken.add(corner.pixel_px);
    chosen.push_back(corner);
    ++count;
  }
  return chosen;
}

}  // namespace homeward::tracking
