// SPDX-License-Identifier: Apache-2.0
#include "features/gaussian_blur.hpp"

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <vector>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace homeward::features {
namespace {

#if defined(__x86_64__)

constexpr int kLanes = 8;           // numbers of one AVX2 register
constexpr int kBlock = 8 * kLanes;  // made at once: as many sums as are on their way through the processor
constexpr int kStrip = 4 * kBlock;  // columns made from top to bottom: their rows stay in the processor's first cache

constexpr int kLine = 16;  // numbers of one line of the cache
constexpr int kAhead = 2;  // rows

/// The row or column on this side of the border that stands for one beyond it: mirrored, the border itself once.
int reflected(int i, int count) {
  if (i < 0) return -i;
  return i < count ? i : 2 * (count - 1) - i;
}

/// `count` sums (a multiple of kLanes) of neighbours in one row, weighted; `from` is the first one's leftmost
/// neighbour.
__attribute__((target("avx2,fma"))) void along_row(const float* from, int count, const std::vector<float>& kernel,
                                                   float* to) {
  const std::size_t taps = kernel.size();
  int i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    __m256 sums[kBlock / kLanes];
    for (std::ptrdiff_t b = 0; b < kBlock / kLanes; ++b) {
      sums[b] = _mm256_mul_ps(_mm256_loadu_ps(from + i + b * kLanes), _mm256_set1_ps(kernel[0]));
    }
    for (std::size_t k = 1; k < taps; ++k) {
      const __m256 weight = _mm256_set1_ps(kernel[k]);
      const float* neighbour = from + i + k;
      for (std::ptrdiff_t b = 0; b < kBlock / kLanes; ++b) {
        sums[b] = _mm256_fmadd_ps(_mm256_loadu_ps(neighbour + b * kLanes), weight, sums[b]);
      }
    }
    for (std::ptrdiff_t b = 0; b < kBlock / kLanes; ++b) _mm256_storeu_ps(to + i + b * kLanes, sums[b]);
  }
  for (; i < count; i += kLanes) {
    __m256 sum = _mm256_mul_ps(_mm256_loadu_ps(from + i), _mm256_set1_ps(kernel[0]));
    for (std::size_t k = 1; k < taps; ++k) {
      sum = _mm256_fmadd_ps(_mm256_loadu_ps(from + i + k), _mm256_set1_ps(kernel[k]), sum);
    }
    _mm256_storeu_ps(to + i, sum);
  }
}

/// The same down columns: `rows` are the neighbours, as many as weights, from the uppermost on. The weights are the
/// same above and below.
__attribute__((target("avx2,fma"))) void down_columns(const std::vector<const float*>& rows, int count,
                                                      const std::vector<float>& kernel, float* to) {
  const std::size_t middle = kernel.size() / 2;
  int i = 0;
  for (; i + kBlock <= count; i += kBlock) {
    __m256 sums[kBlock / kLanes];
    for (std::ptrdiff_t b = 0; b < kBlock / kLanes; ++b) {
      sums[b] = _mm256_mul_ps(_mm256_loadu_ps(rows[middle] + i + b * kLanes), _mm256_set1_ps(kernel[middle]));
    }
    for (std::size_t k = 1; k <= middle; ++k) {
      const __m256 weight = _mm256_set1_ps(kernel[middle + k]);
      const float* above = rows[middle - k] + i;
      const float* below = rows[middle + k] + i;
      for (std::ptrdiff_t b = 0; b < kBlock / kLanes; ++b) {
        const __m256 both = _mm256_add_ps(_mm256_loadu_ps(below + b * kLanes), _mm256_loadu_ps(above + b * kLanes));
        sums[b] = _mm256_fmadd_ps(both, weight, sums[b]);
      }
    }
    for (std::ptrdiff_t b = 0; b < kBlock / kLanes; ++b) _mm256_storeu_ps(to + i + b * kLanes, sums[b]);
  }
  for (; i < count; i += kLanes) {
    __m256 sum = _mm256_mul_ps(_mm256_loadu_ps(rows[middle] + i), _mm256_set1_ps(kernel[middle]));
    for (std::size_t k = 1; k <= middle; ++k) {
      const __m256 both = _mm256_add_ps(_mm256_loadu_ps(rows[middle + k] + i), _mm256_loadu_ps(rows[middle - k] + i));
      sum = _mm256_fmadd_ps(both, _mm256_set1_ps(kernel[middle + k]), sum);
    }
    _mm256_storeu_ps(to + i, sum);
  }
}

/// One strip of columns. Rows are blurred along as they are needed and kept while they are neighbours.
void blur_strip(const cv::Mat& from, int first, int width, const std::vector<float>& kernel, cv::Mat& to) {
  const int reach = static_cast<int>(kernel.size()) / 2;
  const int whole = (width + kLanes - 1) / kLanes * kLanes;  // with room for whole registers
  const bool inside = first >= reach && first + whole + reach <= from.cols;
  const std::size_t taps = kernel.size();
  std::vector<float> ring(taps * static_cast<std::size_t>(kStrip));
  std::vector<float> padded(static_cast<std::size_t>(whole + 2 * reach), 0.0F);
  std::vector<float> out(static_cast<std::size_t>(whole));
  std::vector<const float*> neighbours(taps);
  std::vector<float*> kept;  // where each row's sums are while it is a neighbour
  kept.reserve(static_cast<std::size_t>(from.rows));
  for (int row = 0; row < from.rows; ++row) {
    kept.push_back(ring.data() + static_cast<std::size_t>(row) % taps * static_cast<std::size_t>(kStrip));
  }
  int next = 0;  // row to blur along
  for (int row = 0; row < from.rows; ++row) {
    for (; next <= std::min(row + reach, from.rows - 1); ++next) {
      const float* source = from.ptr<float>(next);
      // The strip's next rows lie pages apart, where the processor does not look ahead by itself.
      if (next + kAhead < from.rows) {
        const float* ahead = from.ptr<float>(next + kAhead) + first;
        for (int i = 0; i < width; i += kLine) _mm_prefetch(reinterpret_cast<const char*>(ahead + i), _MM_HINT_T0);
      }
      if (inside) {
        along_row(source + first - reach, whole, kernel, kept[static_cast<std::size_t>(next)]);
        continue;
      }
      const int before = std::max(0, reach - first);  // numbers beyond the border
      const int after = std::max(0, first + width + reach - from.cols);
      const int end = width + 2 * reach;
      std::copy_n(source + first - reach + before, end - before - after, padded.begin() + before);
      for (int i = 0; i < before; ++i) padded[static_cast<std::size_t>(i)] = source[before - i];
      for (int i = end - after; i < end; ++i) {
        padded[static_cast<std::size_t>(i)] = source[reflected(first - reach + i, from.cols)];
      }
      along_row(padded.data(), whole, kernel, kept[static_cast<std::size_t>(next)]);
    }
    for (std::size_t k = 0; k < taps; ++k) {
      const int neighbour = reflected(row + static_cast<int>(k) - reach, from.rows);
      neighbours[k] = kept[static_cast<std::size_t>(neighbour)];
    }
    if (whole == width) {
      down_columns(neighbours, width, kernel, to.ptr<float>(row) + first);
    } else {
      down_columns(neighbours, whole, kernel, out.data());
      std::copy_n(out.begin(), width, to.ptr<float>(row) + first);
    }
  }
}

#endif

}  // namespace

void gaussian_blur(const cv::Mat& from, cv::Mat& to, double sigma_px) {
#if defined(__x86_64__)
  constexpr double kReachOfSigma = 4.0;  // as cv::GaussianBlur has it
  const int taps = cvRound(2.0 * kReachOfSigma * sigma_px + 1.0) | 1;
  static const bool can = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (can && std::min(from.rows, from.cols) > taps / 2) {
    const cv::Mat weights = cv::getGaussianKernel(taps, sigma_px, CV_32F);
    const std::vector<float> kernel(weights.ptr<float>(), weights.ptr<float>() + taps);
    to.create(from.rows, from.cols, CV_32F);
    for (int first = 0; first < from.cols; first += kStrip) {
      blur_strip(from, first, std::min(kStrip, from.cols - first), kernel, to);
    }
    return;
  }
#endif
  cv::GaussianBlur(from, to, {}, sigma_px, sigma_px);
}

}  // namespace homeward::features
