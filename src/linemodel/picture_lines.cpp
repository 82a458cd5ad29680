// SPDX-License-Identifier: Apache-2.0
#include "linemodel/picture_lines.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/angles.hpp"
#include "core/index.hpp"

namespace homeward::linemodel {
namespace {

constexpr int kAngles = 360;  // columns of the fine grid: half a degree
constexpr double kAngleStep_rad = kPi / kAngles;

}  // namespace

std::vector<HoughPoint> hough_points(std::span<const ImageLine> lines, const HoughSpace& space) {
  std::vector<HoughPoint> points;
  points.reserve(lines.size());
  for (const ImageLine& line : lines) {
    if (const auto point = space.point(line.normal.cast<float>())) points.push_back(*point);
  }
  return points;
}

PictureLines::PictureLines(std::span<const ImageLine> lines, const HoughSpace& space, const MeasureConfig& config)
    : PictureLines(hough_points(lines, space), space, config) {
  config_.measure = config.measure;
  if (config.measure == LineMeasure::kGridLengthMatch) add_lengths(lines, space);
  if (config.measure == LineMeasure::kDistanceTransform) mark_nearness(lines);
}

PictureLines::PictureLines(std::span<const HoughPoint> points, const HoughSpace& space, const MeasureConfig& config)
    : config_(config), most_offset_(space.most_offset()), offset_per_rad_(space.offset_of_angle(0.01) / 0.01F) {
  const double across_rad = 2.0 * most_offset_ / offset_per_rad_;
  offsets_ = std::max(1, static_cast<int>(std::ceil(across_rad / kAngleStep_rad)));
  cell_angles_ = std::max(1, static_cast<int>(std::lround(kPi / config.cell_rad)));
  cell_offsets_ = std::max(1, static_cast<int>(std::lround(across_rad / config.cell_rad)));
  if (config.measure != LineMeasure::kMatchOdds) config_.measure = LineMeasure::kCentredMatchCount;
  mark_rectangles(points, space);
  weigh_odds();
}

std::size_t PictureLines::match_cell(const HoughPoint& point) const {
  const int column = std::min(kAngles - 1, static_cast<int>(point.angle_rad / static_cast<float>(kAngleStep_rad)));
  const float share = (point.offset + most_offset_) / (2.0F * most_offset_);
  const int row = std::clamp(static_cast<int>(share * static_cast<float>(offsets_)), 0, offsets_ - 1);
  return at(column) * at(offsets_) + at(row);
}

std::size_t PictureLines::length_cell(const HoughPoint& point) const {
  const float turn = point.angle_rad / static_cast<float>(kPi);
  const int column = std::min(cell_angles_ - 1, static_cast<int>(turn * static_cast<float>(cell_angles_)));
  const float share = (point.offset + most_offset_) / (2.0F * most_offset_);
  const int row = std::clamp(static_cast<int>(share * static_cast<float>(cell_offsets_)), 0, cell_offsets_ - 1);
  return at(column) * at(cell_offsets_) + at(row);
}

void PictureLines::mark_rectangles(std::span<const HoughPoint> points, const HoughSpace& space) {
  matches_.assign(at(kAngles) * at(offsets_), 0);
  const double step = 2.0 * most_offset_ / offsets_;  // of the offset
  const double half_offset = config_.tolerance_rad * offset_per_rad_;
  for (const HoughPoint& point : points) {
    // Of normals near the vertical, azimuths that are far apart are nearly the same line.
    const double narrow = space.of_pinhole() ? 1.0 : std::max(0.1, std::cos(static_cast<double>(point.offset)));
    const int half_angle = static_cast<int>(std::lround(config_.tolerance_rad / narrow / kAngleStep_rad));
    const int middle = static_cast<int>(point.angle_rad / kAngleStep_rad);
    for (int k = -half_angle; k <= half_angle; ++k) {
      const int around = middle + k;
      const bool flipped = around < 0 || around >= kAngles;  // past an end of [0, pi) the offset changes its sign
      const double offset = flipped ? -point.offset : point.offset;
      const int column = (around % kAngles + kAngles) % kAngles;
      const int least = static_cast<int>(std::floor((offset - half_offset + most_offset_) / step));
      const int most = static_cast<int>(std::floor((offset + half_offset + most_offset_) / step));
      for (int row = std::max(0, least); row <= std::min(offsets_ - 1, most); ++row) {
        matches_[at(column) * at(offsets_) + at(row)] = 1;
      }
    }
  }
}

void PictureLines::weigh_odds() {
  constexpr double kLeast = 0.02;  // by chance, however empty it is around
  constexpr double kMost = 0.9;
  const int reach = std::max(1, static_cast<int>(std::lround(config_.around_rad / kAngleStep_rad)));
  // Columns that go on past both ends of [0, pi), where offsets change their sign.
  cv::Mat wide(kAngles + 2 * reach, offsets_, CV_32F);
  for (int i = 0; i < wide.rows; ++i) {
    const int column = i - reach;
    const bool flipped = column < 0 || column >= kAngles;
    const std::uint8_t* from = &matches_[at((column + kAngles) % kAngles) * at(offsets_)];
    for (int row = 0; row < offsets_; ++row) {
      wide.at<float>(i, row) = static_cast<float>(from[flipped ? offsets_ - 1 - row : row]);
    }
  }
  cv::Mat fullness;
  cv::boxFilter(wide, fullness, CV_32F, cv::Size(2 * reach + 1, 2 * reach + 1), cv::Point(-1, -1), true,
                cv::BORDER_REPLICATE);
  log_odds_.resize(matches_.size());
  for (int column = 0; column < kAngles; ++column) {
    for (int row = 0; row < offsets_; ++row) {
      const std::size_t cell = at(column) * at(offsets_) + at(row);
      const double chance = std::clamp(static_cast<double>(fullness.at<float>(column + reach, row)), kLeast, kMost);
      const double here = std::max(config_.true_match, chance);
      log_odds_[cell] =
          static_cast<float>(matches_[cell] != 0 ? std::log(here / chance) : std::log((1.0 - here) / (1.0 - chance)));
    }
  }
}

void PictureLines::add_lengths(std::span<const ImageLine> lines, const HoughSpace& space) {
  lengths_rad_.assign(at(cell_angles_) * at(cell_offsets_), 0.0F);
  for (const ImageLine& line : lines) {
    const auto point = space.point(line.normal.cast<float>());
    if (point) lengths_rad_[length_cell(*point)] += static_cast<float>(line.length_rad);
  }
}

void PictureLines::mark_nearness(std::span<const ImageLine> lines) {
  // Three turns side by side, so that what is near across the seam is near.
  cv::Mat edges(SightMap::kHeight, 3 * SightMap::kWidth, CV_8UC1, cv::Scalar(255));
  for (const ImageLine& line : lines) {
    const int steps = std::max(1, static_cast<int>(line.length_rad * SightMap::kCells_per_rad * 1.5));
    for (int k = 0; k <= steps; ++k) {
      const double share = static_cast<double>(k) / steps;
      const Eigen::Vector3d direction = (1.0 - share) * line.from + share * line.to;
      const std::int32_t cell = SightMap::cell_of(direction.cast<float>());
      if (cell == SightMap::kNowhere) continue;
      for (int turn = 0; turn < 3; ++turn) {
        edges.at<std::uint8_t>(cell / SightMap::kWidth, turn * SightMap::kWidth + cell % SightMap::kWidth) = 0;
      }
    }
  }
  cv::Mat distances;
  cv::distanceTransform(edges, distances, cv::DIST_L2, cv::DIST_MASK_5);
  nearness_.resize(at(SightMap::kWidth) * at(SightMap::kHeight));
  for (int up = 0; up < SightMap::kHeight; ++up) {
    for (int around = 0; around < SightMap::kWidth; ++around) {
      const double off_rad = distances.at<float>(up, SightMap::kWidth + around) / SightMap::kCells_per_rad;
      const double spreads = off_rad / config_.spread_rad;
      nearness_[at(up) * at(SightMap::kWidth) + at(around)] = static_cast<float>(std::exp(-0.5 * spreads * spreads));
    }
  }
}

bool PictureLines::confirmed(const ExpectedLine& line) const { return matches_[match_cell(line.point)] != 0; }

int PictureLines::confirmed_count(const ExpectedView& view) const {
  int count = 0;
  for (const ExpectedLine& line : view.lines) count += matches_[match_cell(line.point)];
  return count;
}

double PictureLines::score(const ExpectedView& view) const {
  if (view.lines.empty()) return 0.0;
  switch (config_.measure) {
    case LineMeasure::kCentredMatchCount:
      return static_cast<double>(confirmed_count(view)) / static_cast<double>(view.lines.size());
    case LineMeasure::kGridLengthMatch:
      return grid_length_match(view);
    case LineMeasure::kDistanceTransform:
      return nearness(view);
    case LineMeasure::kMatchOdds:
      return log_odds(view);
  }
  return 0.0;
}

double PictureLines::log_odds(const ExpectedView& view) const {
  double sum = 0.0;
  for (const ExpectedLine& line : view.lines) sum += log_odds_[match_cell(line.point)];
  return view.lines.empty() ? 0.0 : sum / static_cast<double>(view.lines.size());
}

double PictureLines::log_odds(std::span<const HoughPoint> points) const {
  double sum = 0.0;
  for (const HoughPoint& point : points) sum += log_odds_[match_cell(point)];
  return points.empty() ? 0.0 : sum / static_cast<double>(points.size());
}

double PictureLines::grid_length_match(const ExpectedView& view) const {
  // Expected lines by cell: sorted, as there are few of them.
  std::vector<std::pair<std::size_t, float>> expected;
  expected.reserve(view.lines.size());
  for (const ExpectedLine& line : view.lines) expected.emplace_back(length_cell(line.point), line.length_rad);
  std::sort(expected.begin(), expected.end());
  double met_rad = 0.0;
  double all_rad = 0.0;
  for (std::size_t i = 0; i < expected.size();) {
    const std::size_t cell = expected[i].first;
    float length_rad = 0.0F;
    for (; i < expected.size() && expected[i].first == cell; ++i) length_rad += expected[i].second;
    met_rad += std::min(length_rad, lengths_rad_[cell]);
    all_rad += length_rad;
  }
  return met_rad / all_rad;
}

double PictureLines::nearness(const ExpectedView& view) const {
  double sum = 0.0;
  for (const std::int32_t cell : view.cells) sum += nearness_[static_cast<std::size_t>(cell)];
  return view.cells.empty() ? 0.0 : sum / static_cast<double>(view.cells.size());
}

}  // namespace homeward::linemodel
