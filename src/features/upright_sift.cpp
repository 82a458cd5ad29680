// SPDX-License-Identifier: Apache-2.0
#include "features/upright_sift.hpp"

#include <hwy/cache_control.h>
#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core/hal/hal.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "features/direction_histogram.hpp"
#include "features/extremum_rows.hpp"
#include "features/gaussian_blur.hpp"

namespace homeward::features {
namespace {

constexpr int kLayers = 3;               // searched per octave
constexpr double kFirstSigma_px = 1.6;   // of each octave's first picture
constexpr double kCameraSigma_px = 0.5;  // blur that a picture comes with
constexpr int kBorder_px = 5;
constexpr int kSmallestSide_px = 2 * kBorder_px + 6;
static_assert(kDifferences == kLayers + 2);

/// Differences of an octave's neighbouring blurs about one pixel, made as they are asked for.
class Differences {
 public:
  Differences(const std::vector<cv::Mat>& blurred, int layer, int row, int column)
      : blurred_(blurred), layer_(layer), row_(row), column_(column) {}

  /// `layer`, `row` and `column` as offsets from the pixel.
  [[nodiscard]] float operator()(int layer, int row, int column) const {
    const int sharper = layer_ + layer;
    const auto l = static_cast<std::size_t>(sharper);
    return blurred_[l + 1].ptr<float>(row_ + row)[column_ + column] -
           blurred_[l].ptr<float>(row_ + row)[column_ + column];
  }

 private:
  const std::vector<cv::Mat>& blurred_;
  int layer_;
  int row_;
  int column_;
};

/// Whether no neighbour in three scales beats the middle band's value at `column`.
bool is_extremum(std::span<const RowBand, 3> bands, int column) {
  const float value = bands[1].here[column];
  const float sign = value > 0.0F ? 1.0F : -1.0F;
  for (const RowBand& band : bands) {
    for (const float* row : {band.above, band.here, band.below}) {
      for (int c = column - 1; c <= column + 1; ++c) {
        if (sign * row[c] > sign * value) return false;
      }
    }
  }
  return true;
}

using Pyramid = std::vector<std::vector<cv::Mat>>;

/// The memory of this thread's last scale space, for the next one: pictures of a stream are all of one size, and to ask
/// the operating system for it each time takes as long as half of the blurring.
Pyramid& spare_pyramid() {
  thread_local Pyramid spare;
  return spare;
}

/// The pixels with even row and column. (Resizing to half an odd size would drift by up to a pixel.)
void every_other_pixel(const cv::Mat& picture, cv::Mat& half) {
  half.create((picture.rows + 1) / 2, (picture.cols + 1) / 2, CV_32F);
  for (int row = 0; row < half.rows; ++row) {
    const float* from = picture.ptr<float>(2 * row);
    float* to = half.ptr<float>(row);
    for (std::ptrdiff_t column = 0; column < half.cols; ++column) to[column] = from[2 * column];
  }
}

struct Fit {
  Eigen::Vector3f offset;  // column, row, layer
  float contrast;
  bool edge;
};

/// Where the parabola through the neighbourhood has its top (Lowe 2004, §4), and whether it is a ridge (§4.1).
std::optional<Fit> fit(const Differences& d) {
  const float here = d(0, 0, 0);
  const Eigen::Vector3f gradient(0.5F * (d(0, 0, 1) - d(0, 0, -1)), 0.5F * (d(0, 1, 0) - d(0, -1, 0)),
                                 0.5F * (d(1, 0, 0) - d(-1, 0, 0)));
  const float xx = d(0, 0, 1) + d(0, 0, -1) - 2.0F * here;
  const float yy = d(0, 1, 0) + d(0, -1, 0) - 2.0F * here;
  const float ss = d(1, 0, 0) + d(-1, 0, 0) - 2.0F * here;
  const float xy = 0.25F * (d(0, 1, 1) - d(0, 1, -1) - d(0, -1, 1) + d(0, -1, -1));
  const float xs = 0.25F * (d(1, 0, 1) - d(1, 0, -1) - d(-1, 0, 1) + d(-1, 0, -1));
  const float ys = 0.25F * (d(1, 1, 0) - d(1, -1, 0) - d(-1, 1, 0) + d(-1, -1, 0));
  Eigen::Matrix3f hessian;
  hessian << xx, xy, xs, xy, yy, ys, xs, ys, ss;
  Eigen::Matrix3f inverse;
  bool invertible = false;
  hessian.computeInverseWithCheck(inverse, invertible, 1e-20F);
  if (!invertible) return std::nullopt;
  Fit result;
  result.offset = -inverse * gradient;
  result.contrast = here + 0.5F * gradient.dot(result.offset);
  constexpr float kEdgeRatio = 10.0F;
  const float trace = xx + yy;
  const float determinant = xx * yy - xy * xy;
  result.edge = determinant <= 0.0F || trace * trace * kEdgeRatio >= (kEdgeRatio + 1) * (kEdgeRatio + 1) * determinant;
  return result;
}

/// Differences of the neighbours of each pixel of a window, row by row.
void gradients(const cv::Mat& picture, const cv::Rect& window, float* across, float* down) {
  for (int r = 0; r < window.height; ++r) {
    const float* above = picture.ptr<float>(window.y + r - 1) + window.x;
    const float* here = picture.ptr<float>(window.y + r) + window.x;
    const float* below = picture.ptr<float>(window.y + r + 1) + window.x;
    float* row_across = across + static_cast<std::ptrdiff_t>(r) * window.width;
    float* row_down = down + static_cast<std::ptrdiff_t>(r) * window.width;
    for (int i = 0; i < window.width; ++i) {
      row_across[i] = here[i + 1] - here[i - 1];
      row_down[i] = below[i] - above[i];
    }
  }
}

/// Where `count` rows or columns from `first` on lie among the cells about `centre`.
void place(int first, int count, float centre, float cell_px, CellPlaces& places) {
  places.resize(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const float cells = (static_cast<float>(first + static_cast<int>(i)) - centre) / cell_px;
    const float at = cells + kCells * 0.5F - 0.5F;
    const float lower = std::floor(at);
    places.cell[i] = static_cast<int>(lower) + 1;  // with the margin
    places.share[i] = at - lower;
    places.weight[i] = std::exp(-cells * cells / (0.5F * kCells * kCells));  // a Gaussian of half the window
  }
}

/// The pixels about a point that its descriptor tells of, in the point's picture.
struct Window {
  float u_px;
  float v_px;
  float cell_px;
  cv::Rect pixels;  // empty beyond the picture
};

Window window_of(const SiftPoint& point, const cv::Mat& picture) {
  constexpr float kCellPerSigma = 3.0F;
  constexpr float kWithin = 0.999F;  // of the outermost cells' reach, so that rounding cannot leave them
  const float from_picture = std::ldexp(2.0F, -point.octave);
  const float u = (point.u_px + 0.25F) * from_picture;
  const float v = (point.v_px + 0.25F) * from_picture;
  const float cell_px = kCellPerSigma * point.sigma_px * from_picture;
  const float reach_px = kWithin * cell_px * (kCells + 1) * 0.5F;
  const int first_column = std::max(1, static_cast<int>(std::ceil(u - reach_px)));
  const int last_column = std::min(picture.cols - 2, static_cast<int>(std::floor(u + reach_px)));
  const int first_row = std::max(1, static_cast<int>(std::ceil(v - reach_px)));
  const int last_row = std::min(picture.rows - 2, static_cast<int>(std::floor(v + reach_px)));
  if (last_column < first_column || last_row < first_row) return {u, v, cell_px, {}};
  return {u, v, cell_px, cv::Rect(first_column, first_row, last_column - first_column + 1, last_row - first_row + 1)};
}

/// Kept by each thread from one feature to the next.
struct DescribingMemory {
  CellPlaces columns;
  CellPlaces rows;
  std::vector<float> numbers;
  WindowScratch scratch;
};

/// The cells as a descriptor: directions wrap at the end, and square roots of shares are taken.
void finish(CellHistograms& cells, float* descriptor) {
  float squares = 0.0F;
  float* out = descriptor;
  for (int r = 1; r <= kCells; ++r) {
    for (int c = 1; c <= kCells; ++c) {
      cells.at(r, c, 0) += cells.at(r, c, kDirections);
      cells.at(r, c, 1) += cells.at(r, c, kDirections + 1);
      for (int d = 0; d < kDirections; ++d, ++out) {
        *out = cells.at(r, c, d);
        squares += *out * *out;
      }
    }
  }
  // No single gradient may dominate (Lowe 2004, §6.1): glare and lamps.
  const float highest = 0.2F * std::sqrt(squares);
  float sum = 0.0F;
  for (int d = 0; d < UprightSift::kDescriptorLength; ++d) {
    descriptor[d] = std::min(descriptor[d], highest);
    sum += descriptor[d];
  }
  if (sum <= 1e-12F) return;
  for (int d = 0; d < UprightSift::kDescriptorLength; ++d) descriptor[d] = std::sqrt(descriptor[d] / sum);
}

}  // namespace

UprightSift::UprightSift(const cv::Mat& grey) {
  Pyramid& spare = spare_pyramid();
  octaves_ = std::move(spare);
  spare.clear();
  thread_local cv::Mat sharp;
  thread_local cv::Mat doubled;
  grey.convertTo(sharp, CV_32F, 1.0 / 255.0);
  cv::resize(sharp, doubled, {}, 2.0, 2.0, cv::INTER_LINEAR);
  const double missing = std::sqrt(kFirstSigma_px * kFirstSigma_px - 4.0 * kCameraSigma_px * kCameraSigma_px);
  cv::Size size = doubled.size();
  std::size_t octave = 0;
  for (; std::min(size.width, size.height) >= kSmallestSide_px; ++octave) {
    if (octave == octaves_.size()) octaves_.emplace_back(kLayers + 3);
    std::vector<cv::Mat>& blurred = octaves_[octave];
    if (octave == 0) {
      gaussian_blur(doubled, blurred[0], missing);
    } else {
      every_other_pixel(octaves_[octave - 1][kLayers], blurred[0]);
    }
    for (std::size_t layer = 1; layer < blurred.size(); ++layer) {
      const double step = std::pow(2.0, 1.0 / kLayers);
      const double before = kFirstSigma_px * std::pow(step, static_cast<double>(layer) - 1.0);
      gaussian_blur(blurred[layer - 1], blurred[layer], before * std::sqrt(step * step - 1.0));
    }
    size = {(size.width + 1) / 2, (size.height + 1) / 2};
  }
  octaves_.resize(octave);
}

UprightSift::~UprightSift() { spare_pyramid() = std::move(octaves_); }

std::vector<SiftPoint> UprightSift::detect(double contrast) const {
  std::vector<SiftPoint> points;
  for (std::size_t octave = 0; octave < octaves_.size(); ++octave) search(static_cast<int>(octave), contrast, points);
  return points;
}

std::optional<SiftPoint> UprightSift::refined(int octave, int layer, int row, int column, double contrast) const {
  const std::vector<cv::Mat>& blurred = octaves_[static_cast<std::size_t>(octave)];
  constexpr int kSteps = 5;
  for (int step = 0; step < kSteps; ++step) {
    const auto found = fit(Differences(blurred, layer, row, column));
    if (!found) return std::nullopt;
    const Eigen::Vector3f& offset = found->offset;
    if (offset.cwiseAbs().maxCoeff() < 0.5F) {
      if (found->edge || std::abs(found->contrast) * kLayers < static_cast<float>(contrast)) return std::nullopt;
      const float to_picture = std::ldexp(0.5F, octave);
      SiftPoint point;
      // Octave 0 has two pixels for one of the picture, a quarter of a pixel before and behind its centre.
      point.u_px = (static_cast<float>(column) + offset.x()) * to_picture - 0.25F;
      point.v_px = (static_cast<float>(row) + offset.y()) * to_picture - 0.25F;
      point.sigma_px = static_cast<float>(kFirstSigma_px) *
                       std::exp2((static_cast<float>(layer) + offset.z()) / kLayers) * to_picture;
      point.response = std::abs(found->contrast);
      point.octave = octave;
      point.layer = layer;
      return point;
    }
    constexpr float kFarthest_px = 1e4F;
    if (!offset.allFinite() || offset.cwiseAbs().maxCoeff() > kFarthest_px) return std::nullopt;
    column += static_cast<int>(std::lround(offset.x()));
    row += static_cast<int>(std::lround(offset.y()));
    layer += static_cast<int>(std::lround(offset.z()));
    const bool inside = layer >= 1 && layer <= kLayers && row >= kBorder_px && row < blurred[0].rows - kBorder_px &&
                        column >= kBorder_px && column < blurred[0].cols - kBorder_px;
    if (!inside) return std::nullopt;
  }
  return std::nullopt;
}

void UprightSift::search(int octave, double contrast, std::vector<SiftPoint>& points) const {
  const std::vector<cv::Mat>& blurred = octaves_[static_cast<std::size_t>(octave)];
  const int rows = blurred[0].rows;
  const int columns = blurred[0].cols;
  const auto floor = static_cast<float>(0.5 * contrast / kLayers);
  // The last three rows of each difference; they stay in the processor's cache.
  const auto width = static_cast<std::size_t>(columns);
  std::vector<float> ring(kDifferences * 3 * width);
  const auto row_of = [&](std::size_t difference, int row) {
    return ring.data() + (difference * 3 + static_cast<std::size_t>(row % 3)) * width;
  };
  std::vector<Candidate> found;
  for (int filled = kBorder_px - 1; filled <= rows - kBorder_px; ++filled) {
    std::array<const float*, kDifferences + 1> sources{};
    std::array<float*, kDifferences> differences{};
    for (std::size_t d = 0; d < sources.size(); ++d) sources[d] = blurred[d].ptr<float>(filled);
    for (std::size_t d = 0; d < differences.size(); ++d) differences[d] = row_of(d, filled);
    subtract(sources, differences, columns);
    const int row = filled - 1;
    if (row < kBorder_px) continue;
    std::array<RowBand, kDifferences> bands;
    for (std::size_t d = 0; d < bands.size(); ++d) {
      bands[d] = {row_of(d, row - 1), row_of(d, row), row_of(d, row + 1)};
    }
    find_candidates(bands, kBorder_px, columns - kBorder_px, floor, found);
    for (const Candidate& candidate : found) {
      const auto below = static_cast<std::size_t>(candidate.layer) - 1;
      if (!is_extremum(std::span(bands).subspan(below).first<3>(), candidate.column)) continue;
      const auto point = refined(octave, candidate.layer, row, candidate.column, contrast);
      if (point) points.push_back(*point);
    }
  }
}

SiftPoint UprightSift::widened(SiftPoint point) const {
  point.sigma_px *= 2.0F;
  point.octave = std::min(point.octave + 1, static_cast<int>(octaves_.size()) - 1);
  return point;
}

void UprightSift::fetch(const SiftPoint& point) const {
  const cv::Mat& picture = picture_of(point);
  const cv::Rect pixels = window_of(point, picture).pixels;
  if (pixels.empty()) return;
  constexpr int kLine = 16;  // numbers of one line of the cache
  for (int row = pixels.y - 1; row <= pixels.y + pixels.height; ++row) {
    const float* from = picture.ptr<float>(row) + pixels.x - 1;
    for (int i = 0; i <= pixels.width; i += kLine) hwy::Prefetch(from + i);
    hwy::Prefetch(from + pixels.width + 1);
  }
}

void UprightSift::describe(const SiftPoint& point, float* descriptor) const {
  std::fill_n(descriptor, kDescriptorLength, 0.0F);
  const cv::Mat& picture = picture_of(point);
  const Window window = window_of(point, picture);
  if (window.pixels.empty()) return;
  thread_local DescribingMemory memory;
  place(window.pixels.x, window.pixels.width, window.u_px, window.cell_px, memory.columns);
  place(window.pixels.y, window.pixels.height, window.v_px, window.cell_px, memory.rows);
  const int pixels = window.pixels.area();
  const std::size_t room = static_cast<std::size_t>(pixels) + CellPlaces::kMore;
  memory.numbers.resize(room * 4);
  float* across = memory.numbers.data();  // of all pixels, row by row, as the next three
  float* down = across + room;
  float* angles_deg = down + room;
  float* magnitudes = angles_deg + room;
  gradients(picture, window.pixels, across, down);
  cv::hal::fastAtan32f(down, across, angles_deg, pixels, true);
  cv::hal::magnitude32f(across, down, magnitudes, pixels);
  CellHistograms cells;
  add_window({angles_deg, magnitudes}, memory.columns, memory.rows, memory.scratch, cells);
  finish(cells, descriptor);
}

}  // namespace homeward::features
