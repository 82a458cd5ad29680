// SPDX-License-Identifier: Apache-2.0
#include "camera/board.hpp"

#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace homeward::camera {
namespace {

constexpr int kCornersMin = 3;
constexpr int kCornersMax = 60;
constexpr int kSideMin_px = 48;  // the detectors need room for their windows
constexpr double kContrastLimit = 4.0;
constexpr int kContrastTiles = 8;
constexpr int kWindowMin_px = 2;
constexpr int kWindowMax_px = 11;
constexpr double kWindowShare = 0.35;  // of the distance to the next corner, so that the window holds one corner
constexpr double kEnlargement = 2.0;
constexpr int kEnlargeUpTo_px = 4'000'000;  // larger pictures have large boards

cv::Mat grey_of(const Image& picture) {
  const cv::Mat view(picture.height_px, picture.width_px, picture.channels == 1 ? CV_8UC1 : CV_8UC3,
                     const_cast<std::uint8_t*>(picture.data.data()));
  cv::Mat grey;
  if (picture.channels == 1) {
    grey = view.clone();
  } else {
    cv::cvtColor(view, grey, cv::COLOR_RGB2GRAY);
  }
  return grey;
}

cv::Mat even_contrast(const cv::Mat& grey) {
  cv::Mat even;
  cv::createCLAHE(kContrastLimit, cv::Size(kContrastTiles, kContrastTiles))->apply(grey, even);
  return even;
}

/// Half the side of a window around corner `i` that holds no other corner.
int window_px(const std::vector<cv::Point2f>& corners, cv::Size board, int i) {
  double nearest_px = std::numeric_limits<double>::infinity();
  const int col = i % board.width;
  const int row = i / board.width;
  const auto look = [&](int other_col, int other_row) {
    if (other_col < 0 || other_row < 0 || other_col >= board.width || other_row >= board.height) return;
    const int other = other_row * board.width + other_col;
    const cv::Point2f apart = corners[static_cast<std::size_t>(other)] - corners[static_cast<std::size_t>(i)];
    nearest_px = std::min(nearest_px, std::hypot(static_cast<double>(apart.x), static_cast<double>(apart.y)));
  };
  look(col - 1, row);
  look(col + 1, row);
  look(col, row - 1);
  look(col, row + 1);
  return std::clamp(static_cast<int>(std::lround(kWindowShare * nearest_px)), kWindowMin_px, kWindowMax_px);
}

/// Each corner to where the gradients around it agree; one that runs away stays where it was found.
void refine(const cv::Mat& grey, cv::Size board, std::vector<cv::Point2f>& corners) {
  const cv::TermCriteria until(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 50, 0.001);
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
    const int window = window_px(corners, board, i);
    std::vector<cv::Point2f> moved{corners[static_cast<std::size_t>(i)]};
    cv::cornerSubPix(grey, moved, cv::Size(window, window), cv::Size(-1, -1), until);
    const cv::Point2f step = moved.front() - corners[static_cast<std::size_t>(i)];
    if (std::hypot(step.x, step.y) < static_cast<float>(window)) corners[static_cast<std::size_t>(i)] = moved.front();
  }
}

bool find_in(const cv::Mat& grey, cv::Size board, std::vector<cv::Point2f>& corners) {
  constexpr int kWhole = cv::CALIB_CB_NORMALIZE_IMAGE | cv::CALIB_CB_EXHAUSTIVE | cv::CALIB_CB_ACCURACY;
  if (cv::findChessboardCornersSB(grey, board, corners, kWhole)) return true;
  for (const int flags : {cv::CALIB_CB_ADAPTIVE_THRESH | cv::CALIB_CB_NORMALIZE_IMAGE,
                          static_cast<int>(cv::CALIB_CB_ADAPTIVE_THRESH), 0}) {
    if (cv::findChessboardCorners(grey, board, corners, flags)) return true;
  }
  return false;
}

}  // namespace

std::vector<std::string> problems(const BoardGeometry& board) {
  std::vector<std::string> found;
  if (board.cols < kCornersMin || board.rows < kCornersMin || board.cols > kCornersMax || board.rows > kCornersMax) {
    found.emplace_back("A board has 3 to 60 inner corners along each side.");
  }
  if (!(board.square_m > 0.0) || !std::isfinite(board.square_m)) {
    found.emplace_back("The side of a square must be more than 0 m.");
  }
  return found;
}

std::vector<Eigen::Vector2d> corners_on_board_m(const BoardGeometry& board) {
  std::vector<Eigen::Vector2d> corners_m;
  for (int row = 0; row < board.rows; ++row) {
    for (int col = 0; col < board.cols; ++col) corners_m.emplace_back(col * board.square_m, row * board.square_m);
  }
  return corners_m;
}

Result<std::vector<Eigen::Vector2d>> find_board(const Image& picture, int cols, int rows) {
  const std::vector<std::string> wrong = problems(BoardGeometry{cols, rows, 1.0});
  if (!wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  if (picture.empty()) return fail(ErrorCode::kEmptyInput, "The picture is empty.");
  const auto no_board = [&] {
    return fail(ErrorCode::kTooLittleSupport, "No whole board of " + std::to_string(cols) + " x " +
                                                  std::to_string(rows) + " inner corners is in the picture.");
  };
  if (std::min(picture.width_px, picture.height_px) < kSideMin_px) return no_board();
  const cv::Size board(cols, rows);
  const cv::Mat grey = grey_of(picture);
  std::vector<double> scales{1.0};
  if (grey.total() <= kEnlargeUpTo_px) scales.push_back(kEnlargement);
  for (const double scale : scales) {
    cv::Mat sized = grey;
    if (scale != 1.0) cv::resize(grey, sized, {}, scale, scale, cv::INTER_CUBIC);
    for (const bool evened : {false, true}) {
      std::vector<cv::Point2f> corners;
      if (!find_in(evened ? even_contrast(sized) : sized, board, corners)) continue;
      // Pixel centres are whole numbers: enlarging moves (0,0) to half a pixel further out.
      std::vector<cv::Point2f> own;
      for (const cv::Point2f& corner : corners) {
        const double half = 0.5;
        own.emplace_back(static_cast<float>((corner.x + half) / scale - half),
                         static_cast<float>((corner.y + half) / scale - half));
      }
      refine(grey, board, own);
      std::vector<Eigen::Vector2d> found_px;
      found_px.reserve(own.size());
      for (const cv::Point2f& corner : own) found_px.emplace_back(corner.x, corner.y);
      return found_px;
    }
  }
  return no_board();
}

}  // namespace homeward::camera
