// SPDX-License-Identifier: Apache-2.0
#include "pipeline/comparison_picture.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "core/angles.hpp"
#include "features/columns.hpp"

namespace homeward::pipeline {
namespace {

constexpr int kHeader_px = 24;   // strip at the top for a sentence
constexpr int kAxis_px = 30;     // strip above each panorama for its marks
constexpr int kBetween_px = 10;  // between the two views
const cv::Scalar kPaper(250, 249, 245);
const cv::Scalar kInk(40, 40, 40);
const cv::Scalar kAgrees(20, 200, 60);
const cv::Scalar kDisagrees(215, 60, 45);
const cv::Scalar kFeature(255, 190, 40);
const cv::Scalar kColumn(60, 190, 205);
const cv::Scalar kColumnAgrees(160, 60, 220);
const cv::Scalar kColumnDisagrees(225, 150, 175);
const cv::Scalar kHome(30, 90, 220);

/// One view as it is drawn: its first row, and the turn that its panorama is shifted by.
struct Drawn {
  const ComparedView& view;
  int top_px = 0;
  double turn_rad = 0.0;

  [[nodiscard]] cv::Point point(const Eigen::Vector3d& bearing) const {
    const Eigen::Vector2d pixel_px =
        view.panorama.geometry.pixel(Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()) * bearing);
    return {static_cast<int>(std::lround(pixel_px.x())), top_px + static_cast<int>(std::lround(pixel_px.y()))};
  }
  [[nodiscard]] cv::Point feature(int index) const {
    return point(view.appearance.sift.bearings.row(index).transpose().cast<double>());
  }
};

cv::Mat as_mat(const Image& image) {
  return {image.height_px, image.width_px, CV_8UC3, const_cast<std::uint8_t*>(image.data.data())};
}

/// The panorama with its columns shifted by the turn.
void paste(cv::Mat& rgb, const Drawn& drawn) {
  const cv::Mat view = as_mat(drawn.view.panorama.rgb);
  const int left_px = static_cast<int>(std::lround(drawn.turn_rad / (2.0 * kPi) * view.cols));
  const int split_px = ((left_px % view.cols) + view.cols) % view.cols;
  view.colRange(split_px, view.cols).copyTo(rgb(cv::Rect(0, drawn.top_px, view.cols - split_px, view.rows)));
  if (split_px > 0) {
    view.colRange(0, split_px).copyTo(rgb(cv::Rect(view.cols - split_px, drawn.top_px, split_px, view.rows)));
  }
}

void write(cv::Mat& rgb, const std::string& words, const cv::Point& at) {
  cv::putText(rgb, words, at, cv::FONT_HERSHEY_SIMPLEX, 0.45, kInk, 1, cv::LINE_AA);
}

/// A triangle on the axis above a panorama, pointing at an azimuth, and a thin line down through the picture.
void mark(cv::Mat& rgb, const Drawn& drawn, double azimuth_rad, const std::string& words) {
  const int u = drawn.point({std::cos(azimuth_rad), std::sin(azimuth_rad), 0.0}).x;
  const int top_px = drawn.top_px;
  const std::vector<cv::Point> triangle = {{u, top_px}, {u - 8, top_px - 13}, {u + 8, top_px - 13}};
  cv::fillConvexPoly(rgb, triangle, kHome, cv::LINE_AA);
  cv::line(rgb, {u, top_px}, {u, top_px + drawn.view.panorama.rgb.height_px - 1}, kHome, 1, cv::LINE_AA);
  int baseline = 0;
  const int width = cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, &baseline).width;
  write(rgb, words, {u + 12 + width < rgb.cols ? u + 12 : u - 12 - width, top_px - 5});
}

/// A line the short way round: one that crosses the seam leaves on one side and comes in on the other.
void connect(cv::Mat& rgb, const cv::Point& above, const cv::Point& below, const cv::Scalar& colour) {
  const int width = rgb.cols;
  const int shift = below.x - above.x > width / 2 ? -width : (above.x - below.x > width / 2 ? width : 0);
  cv::line(rgb, above, {below.x + shift, below.y}, colour, 1, cv::LINE_AA);
  if (shift != 0) cv::line(rgb, {above.x - shift, above.y}, below, colour, 1, cv::LINE_AA);
}

/// The stroke of one column segment. Its ends stand above each other.
void stroke(cv::Mat& rgb, const Drawn& drawn, int index, const cv::Scalar& colour, int thickness_px) {
  const features::ColumnEnds ends = features::column_ends(drawn.view.appearance.columns, index);
  cv::line(rgb, drawn.point(ends.top), drawn.point(ends.bottom), colour, thickness_px, cv::LINE_8);
}

void draw_matches(cv::Mat& rgb, const Drawn& upper, const Drawn& lower, const matching::VerifiedMatch& verified,
                  const ComparisonStyle& style) {
  std::vector<bool> agrees(verified.matches.size(), false);
  for (const int inlier : verified.pose.inliers) agrees[static_cast<std::size_t>(inlier)] = true;
  const auto middle = [](const Drawn& drawn, int column) {
    return drawn.point(drawn.view.appearance.columns.bearings.row(column).transpose().cast<double>());
  };
  const auto agreeing = static_cast<int>(verified.pose.inliers.size());
  int passed = 0;                            // of those that agree; every so many of them is drawn
  for (const bool wanted : {false, true}) {  // what agrees is drawn over what does not
    if (!wanted && !style.unmatched) continue;
    for (std::size_t i = 0; i < verified.matches.size(); ++i) {
      if (agrees[i] != wanted) continue;
      if (wanted && agreeing > style.most_lines) {
        const std::int64_t before = std::int64_t{passed} * style.most_lines / agreeing;
        const std::int64_t after = std::int64_t{++passed} * style.most_lines / agreeing;
        if (before == after) continue;
      }
      const matching::Match& match = verified.matches[i];
      if (match.kind == matching::FeatureKind::kColumn) {
        const cv::Scalar& colour = wanted ? kColumnAgrees : kColumnDisagrees;
        stroke(rgb, upper, match.current, colour, 2);
        stroke(rgb, lower, match.target, colour, 2);
        connect(rgb, middle(upper, match.current), middle(lower, match.target), colour);
        continue;
      }
      const cv::Scalar& colour = wanted ? kAgrees : kDisagrees;
      const cv::Point above = upper.feature(match.current);
      const cv::Point below = lower.feature(match.target);
      connect(rgb, above, below, colour);
      cv::circle(rgb, above, 3, colour, 1, cv::LINE_AA);
      cv::circle(rgb, below, 3, colour, 1, cv::LINE_AA);
    }
  }
}

/// What the colours mean, at the right of the strip at the top.
void legend(cv::Mat& rgb) {
  struct Entry {
    cv::Scalar colour;
    const char* words;
  };
  const std::array<Entry, 4> entries = {{{kAgrees, "features agree"},
                                         {kDisagrees, "do not"},
                                         {kColumnAgrees, "columns agree"},
                                         {kColumnDisagrees, "do not"}}};
  int left_px = rgb.cols - 510;
  for (const Entry& entry : entries) {
    cv::line(rgb, {left_px, 12}, {left_px + 18, 12}, entry.colour, 3);
    write(rgb, entry.words, {left_px + 23, 16});
    int baseline = 0;
    left_px += 45 + cv::getTextSize(entry.words, cv::FONT_HERSHEY_SIMPLEX, 0.45, 1, &baseline).width;
  }
}

std::string summary(const std::optional<matching::VerifiedMatch>& verified) {
  if (!verified) return "no motion explains enough matches";
  char text[160];
  std::snprintf(text, sizeof text, "%zu of %zu matches agree; turn %.0f deg; sure %.0f %%",
                verified->pose.inliers.size(), verified->matches.size(), degrees(verified->pose.motion.turn_rad),
                100.0 * verified->pose.confidence);
  return text;
}

/// The columns that one view or the other sees, first and last.
cv::Range seen_columns(const Drawn& upper, const Drawn& lower) {
  const int width = upper.view.panorama.rgb.width_px;
  std::vector<char> seen(static_cast<std::size_t>(width), 0);
  for (const Drawn& drawn : {upper, lower}) {
    const int shift_px = static_cast<int>(std::lround(drawn.turn_rad / (2.0 * kPi) * width));
    const std::vector<std::uint8_t>& valid = drawn.view.panorama.valid;
    for (std::size_t i = 0; i < valid.size(); ++i) {
      if (valid[i] == 0) continue;
      const int u = (static_cast<int>(i % seen.size()) - shift_px) % width;
      seen[static_cast<std::size_t>((u + width) % width)] = 1;
    }
  }
  const auto first = std::ranges::find(seen, 1);
  if (first == seen.end()) return {0, width};
  const auto last = std::find(seen.rbegin(), seen.rend(), 1);
  return {static_cast<int>(first - seen.begin()), static_cast<int>(seen.rend() - last)};
}

}  // namespace

Image draw_comparison(const ComparedView& current, const ComparedView& target,
                      const std::optional<matching::VerifiedMatch>& verified, const ComparisonStyle& style) {
  const double turn_rad = verified ? verified->pose.motion.turn_rad : 0.0;
  const int axis_px = style.words ? kAxis_px : 0;
  const Drawn upper{current, style.words ? kHeader_px + kAxis_px : 0, 0.0};
  const Drawn lower{target, upper.top_px + current.panorama.rgb.height_px + kBetween_px + axis_px, turn_rad};
  cv::Mat rgb(lower.top_px + target.panorama.rgb.height_px, current.panorama.rgb.width_px, CV_8UC3, kPaper);
  for (const Drawn& drawn : {upper, lower}) {
    paste(rgb, drawn);
    if (!style.unmatched) continue;
    for (int i = 0; i < drawn.view.appearance.sift.size(); ++i) {
      cv::circle(rgb, drawn.feature(i), 1, kFeature, cv::FILLED);
    }
    for (int i = 0; i < drawn.view.appearance.columns.size(); ++i) stroke(rgb, drawn, i, kColumn, 1);
  }
  if (verified) draw_matches(rgb, upper, lower, *verified, style);
  if (verified && style.words) {
    const double home_rad = verified->pose.motion.direction_rad;
    mark(rgb, upper, home_rad, "way home");
    mark(rgb, lower, wrap_angle(home_rad + kPi - turn_rad), "way back");
  }
  if (style.words) {
    write(rgb, summary(verified), {6, 16});
    if (verified) legend(rgb);
    write(rgb, "here", {6, upper.top_px - 8});
    write(rgb, "there", {6, lower.top_px - 8});
  }
  const cv::Mat kept = style.cut ? rgb.colRange(seen_columns(upper, lower)).clone() : rgb;

  Image picture(kept.cols, kept.rows, 3);
  std::copy_n(kept.ptr<std::uint8_t>(0), picture.data.size(), picture.data.begin());
  return picture;
}

}  // namespace homeward::pipeline
