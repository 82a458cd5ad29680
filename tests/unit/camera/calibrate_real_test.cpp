// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "camera/calibrate.hpp"
#include "camera/mirror_ring.hpp"
#include "files/csv.hpp"
#include "files/read_file.hpp"
#include "support/folders.hpp"

namespace homeward::camera::calibrate_real_test {
namespace {

namespace fs = std::filesystem;

/// Pictures of boards in real mirrors (Mei's and Scaramuzza's toolboxes), where the developers have them.
class RealMirrors : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!fs::is_directory(folder_ / "images")) GTEST_SKIP() << "no pictures in " << folder_;
  }

  void read(const std::string& start) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_ / "images")) {
      if (entry.path().filename().string().starts_with(start)) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    for (const fs::path& file : files) {
      auto picture = files::read_picture(file);
      ASSERT_TRUE(picture) << picture.error().message;
      names_.push_back(file.filename().string());
      pictures_.push_back(std::move(*picture));
    }
    ASSERT_FALSE(pictures_.empty());
  }

  /// Calibrates, and judges: at least so many boards found, within a pixel, the rim's centre near the principal point.
  void expect_calibrated(const BoardGeometry& board, std::size_t boards_min) {
    for (std::size_t i = 0; i < pictures_.size(); ++i) {
      auto corners = find_board(pictures_[i], board.cols, board.rows);
      if (corners) views_.push_back({names_[i], std::move(*corners)});
    }
    ASSERT_GE(views_.size(), boards_min);
    CalibrationInput input;
    input.model = CalibratedModel::kMei;
    input.mirror = true;
    input.board = board;
    input.camera.width_px = pictures_.front().width_px;
    input.camera.height_px = pictures_.front().height_px;
    const auto result = calibrate(input, views_);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_LT(result->rms_px, 0.5);
    EXPECT_TRUE(result->left_out.empty());
    EXPECT_TRUE(result->warnings.empty());
    const auto ring = find_mirror_ring(pictures_);
    ASSERT_TRUE(ring) << ring.error().message;
    const auto& mei = std::get<Mei>(result->config.model);
    EXPECT_LT((ring->centre_px - Eigen::Vector2d(mei.intrinsics.cx_px, mei.intrinsics.cy_px)).norm(), 2.0);
    EXPECT_GT(ring->radius_min_px, 0.0);
  }

  fs::path folder_ = testing::shared_folder() / "data/real/ocam_catadioptric_calib";
  std::vector<std::string> names_;
  std::vector<Image> pictures_;
  std::vector<BoardView> views_;
};

TEST_F(RealMirrors, AParabolicMirror) {
  read("mei_para");
  expect_calibrated({6, 8, 0.042}, 10);
}

TEST_F(RealMirrors, AHyperbolicMirror) {
  read("VMRImage");
  expect_calibrated({6, 7, 0.03}, 10);
}

TEST_F(RealMirrors, AMirrorForPanoramas) {
  read("KaidanOmni");
  expect_calibrated({7, 11, 0.03}, 16);
}

TEST_F(RealMirrors, CornersLieWhereTheToolboxHasThem) {
  read("VMRImage");
  const auto table = files::read_csv(folder_ / "vmr_corners.csv");
  ASSERT_TRUE(table);
  const auto column = [&](const char* name) { return table->column(name).value(); };
  std::map<std::string, std::vector<Eigen::Vector2d>> truth_px;
  for (const auto& row : table->rows) {
    // Counted from 1 there.
    truth_px[row[column("filename")]].emplace_back(std::stod(row[column("col_px_1based")]) - 1.0,
                                                   std::stod(row[column("row_px_1based")]) - 1.0);
  }
  std::vector<double> off_px;
  for (std::size_t i = 0; i < pictures_.size(); ++i) {
    const auto found_px = find_board(pictures_[i], 6, 7);
    ASSERT_TRUE(found_px) << names_[i];
    for (const Eigen::Vector2d& truth : truth_px[names_[i]]) {
      double nearest_px = std::numeric_limits<double>::infinity();
      for (const Eigen::Vector2d& at_px : *found_px) nearest_px = std::min(nearest_px, (at_px - truth).norm());
      off_px.push_back(nearest_px);
    }
  }
  ASSERT_EQ(off_px.size(), 420U);
  std::ranges::sort(off_px);
  EXPECT_LT(off_px[210], 0.2);
  EXPECT_LT(off_px[399], 0.5);
  RecordProperty("median_px", std::to_string(off_px[210]));
  RecordProperty("p95_px", std::to_string(off_px[399]));
}

}  // namespace
}  // namespace homeward::camera::calibrate_real_test
