// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "linemodel/expected_view.hpp"
#include "linemodel/hough_space.hpp"
#include "linemodel/image_line.hpp"

namespace homeward::linemodel {

/// How well the lines of a picture confirm those that a plan lets expect (Fichtner & Grossmann 2003).
enum class LineMeasure {
  kCentredMatchCount,  // share of expected lines with one of the picture within a rectangle of Hough space around them
  kGridLengthMatch,    // share of expected length met by length seen in the same cells of a grid over Hough space
  kDistanceTransform,  // how near points of expected lines are to the nearest edge of the picture (a plain score)
  kMatchOdds,          // the match count, each line by how much likelier it is where the robot is there than by chance
};

struct MeasureConfig {
  LineMeasure measure = LineMeasure::kCentredMatchCount;
  double tolerance_rad = 0.025;  // half a side of the rectangle, of the angle and of the offset as seen by the camera
  double cell_rad = 0.07;        // side of a cell of the grid
  double spread_rad = 0.03;      // of the distance transform: a point so far off counts e^-1/2
  double true_match = 0.85;      // how probable it is that a line that is there is confirmed
  double around_rad = 0.2;       // half a side of the square of Hough space whose fullness is the probability by chance
};

/// Where these lines are in Hough space; those that it has no point for are left out.
std::vector<HoughPoint> hough_points(std::span<const ImageLine> lines, const HoughSpace& space);

/// The lines of one picture, made ready to be asked by many poses what they confirm.
class PictureLines {
 public:
  PictureLines(std::span<const ImageLine> lines, const HoughSpace& space, const MeasureConfig& config);
  /// Lines of which no more is known than this, such as those that a plan lets expect: scored by the match count or by
  /// its odds alone, as they have no length to match and nothing to be near to.
  PictureLines(std::span<const HoughPoint> points, const HoughSpace& space, const MeasureConfig& config);

  /// 0 (nothing of what is expected is seen) to 1; 0 where nothing is expected. Of the match odds it is `log_odds`.
  [[nodiscard]] double score(const ExpectedView& view) const;
  /// The mean over expected lines of the logarithm of how much likelier it is that each is confirmed, or is not, where
  /// it is there than by chance, which in a busy part of Hough space is great; 0 where nothing is expected. Ours:
  /// whether the robot is on this plan at all cannot be told by counts, as a full room confirms much of any plan.
  [[nodiscard]] double log_odds(const ExpectedView& view) const;
  /// The same of lines of which no more is known than their points.
  [[nodiscard]] double log_odds(std::span<const HoughPoint> points) const;
  /// Whether an expected line has one of the picture within the rectangle around it, whatever the measure.
  [[nodiscard]] bool confirmed(const ExpectedLine& line) const;
  [[nodiscard]] int confirmed_count(const ExpectedView& view) const;

 private:
  [[nodiscard]] double grid_length_match(const ExpectedView& view) const;
  [[nodiscard]] double nearness(const ExpectedView& view) const;

  void mark_rectangles(std::span<const HoughPoint> points, const HoughSpace& space);
  void add_lengths(std::span<const ImageLine> lines, const HoughSpace& space);
  void mark_nearness(std::span<const ImageLine> lines);
  void weigh_odds();
  [[nodiscard]] std::size_t match_cell(const HoughPoint& point) const;
  [[nodiscard]] std::size_t length_cell(const HoughPoint& point) const;

  MeasureConfig config_;
  float most_offset_;
  float offset_per_rad_;
  int offsets_ = 0;      // rows of the fine grid of matches
  int cell_angles_ = 0;  // columns and rows of the grid of lengths
  int cell_offsets_ = 0;
  std::vector<std::uint8_t> matches_;  // angle x offset, 1 = a line of the picture is within the rectangle around it
  std::vector<float> log_odds_;        // of the cells of matches_
  std::vector<float> lengths_rad_;     // of the picture's lines in each cell of the grid
  std::vector<float> nearness_;        // of each cell of SightMap to the nearest edge, 1 = on it
};

}  // namespace homeward::linemodel
