// SPDX-License-Identifier: Apache-2.0
#include "camera/board.hpp"

#include <gtest/gtest.h>

#include "support/board_scene.hpp"
#include "support/sample_cameras.hpp"

namespace homeward::camera::board_test {
namespace {

using homeward::testing::corners_of;
using homeward::testing::HungBoard;
using homeward::testing::pose_of;
using homeward::testing::render_board;

/// RMS distance of the corners found from the true ones; the board may be found turned half round.
double off_px(const std::vector<Eigen::Vector2d>& found_px, std::vector<Eigen::Vector2d> truth_px) {
  double best = std::numeric_limits<double>::infinity();
  for (int turned = 0; turned < 2; ++turned) {
    double sum = 0.0;
    for (std::size_t i = 0; i < truth_px.size(); ++i) sum += (found_px[i] - truth_px[i]).squaredNorm();
    best = std::min(best, std::sqrt(sum / static_cast<double>(truth_px.size())));
    std::ranges::reverse(truth_px);
  }
  return best;
}

void expect_found(const CameraConfig& config, const BoardGeometry& board, const HungBoard& hung) {
  const auto camera = Camera::create(config);
  ASSERT_TRUE(camera);
  const Eigen::Isometry3d pose = pose_of(hung, board);
  const auto truth_px = corners_of(**camera, board, pose);
  ASSERT_TRUE(truth_px);
  const auto found_px = find_board(render_board(**camera, board, pose), board.cols, board.rows);
  ASSERT_TRUE(found_px) << found_px.error().message;
  ASSERT_EQ(found_px->size(), truth_px->size());
  // A mirror exchanges left and right: then the detector counts the rows from the other side.
  auto other_px = *truth_px;
  for (int row = 0; row < board.rows; ++row) {
    std::reverse(other_px.begin() + row * board.cols, other_px.begin() + (row + 1) * board.cols);
  }
  EXPECT_LT(std::min(off_px(*found_px, *truth_px), off_px(*found_px, other_px)), 0.15);
}

TEST(FindBoard, FindsTheCornersThroughEveryLens) {
  const BoardGeometry board{7, 5, 0.04};
  expect_found(homeward::testing::pinhole_camera(), board, {0.1, -0.1, 0.6, 0.3, -0.2, 0.2});
  expect_found(homeward::testing::fisheye_camera(), board, {0.8, 0.6, 0.3, 0.2, 0.3, 0.4});
  expect_found(homeward::testing::mei_camera(), board, {2.0, 0.9, 0.4, 0.3, 0.1, 0.0});
  expect_found(homeward::testing::mirror_camera(), board, {-1.0, -0.4, 0.4, 0.2, -0.2, 0.1});
}

TEST(FindBoard, ABoardThatIsNotThereIsAnError) {
  const auto code_of = [](const Image& picture, int cols, int rows) {
    const auto found = find_board(picture, cols, rows);
    EXPECT_FALSE(found);
    return found ? ErrorCode::kInternal : found.error().code;
  };
  const BoardGeometry board{7, 5, 0.04};
  const auto camera = Camera::create(homeward::testing::pinhole_camera());
  ASSERT_TRUE(camera);
  const Image picture = render_board(**camera, board, pose_of({0.1, -0.1, 0.6, 0.3, -0.2, 0.2}, board));
  EXPECT_EQ(code_of(Image(), 7, 5), ErrorCode::kEmptyInput);
  EXPECT_EQ(code_of(Image(64, 48, 1), 7, 5), ErrorCode::kTooLittleSupport);
  EXPECT_EQ(code_of(Image(1, 1, 3), 7, 5), ErrorCode::kTooLittleSupport);
  EXPECT_EQ(code_of(picture, 9, 8), ErrorCode::kTooLittleSupport);
  EXPECT_EQ(code_of(picture, 2, 5), ErrorCode::kInvalidInput);
  EXPECT_EQ(code_of(picture, 7, -1), ErrorCode::kInvalidInput);
}

}  // namespace
}  // namespace homeward::camera::board_test
