// SPDX-License-Identifier: Apache-2.0
#include "repeat/picture_shift.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace homeward::repeat {
namespace {

constexpr double kOfWidth = 0.6;  // a turn of 40 degrees seen by a lens of 70
constexpr double kOfHeight = 0.125;
constexpr int kMostWidth_px = 80;  // of what is compared
constexpr double kPlain = 1.0;     // squared grey levels: correlation says nothing of what varies less

/// A coarse picture, rows from the top.
struct Coarse {
  int width_px = 0;
  int height_px = 0;
  double pixels = 1.0;  // of the finest level in one of these
  std::vector<float> grey;

  [[nodiscard]] const float* row(int v) const {
    return grey.data() + static_cast<std::ptrdiff_t>(v) * static_cast<std::ptrdiff_t>(width_px);
  }
};

/// The means of squares of the coarsest level.
Coarse coarse(const tracking::ImagePyramid& picture) {
  const tracking::GreyLevel& level = picture.levels().back();
  const int side = std::max(1, (level.width_px + kMostWidth_px - 1) / kMostWidth_px);
  Coarse made;
  made.width_px = level.width_px / side;
  made.height_px = level.height_px / side;
  made.pixels = side * std::exp2(static_cast<double>(picture.levels().size()) - 1.0);
  for (int v = 0; v < made.height_px; ++v) {
    for (int u = 0; u < made.width_px; ++u) {
      float sum = 0.0F;
      for (int j = 0; j < side; ++j) {
        for (int i = 0; i < side; ++i) sum += level.row(side * v + j)[side * u + i];
      }
      made.grey.push_back(sum / static_cast<float>(side * side));
    }
  }
  return made;
}

/// The correlation of what two pictures share when a point of `a` lies `du`, `dv` further in `b`; nothing where plain.
std::optional<double> correlation(const Coarse& a, const Coarse& b, int du, int dv) {
  const int left = std::max(0, -du);
  const int right = std::min(a.width_px, a.width_px - du);
  const int top = std::max(0, -dv);
  const int bottom = std::min(a.height_px, a.height_px - dv);
  using Row = Eigen::Map<const Eigen::ArrayXf>;
  double sum_a = 0.0;
  double sum_b = 0.0;
  double sum_aa = 0.0;
  double sum_bb = 0.0;
  double sum_ab = 0.0;
  for (int v = top; v < bottom; ++v) {
    const Row x(a.row(v) + left, right - left);
    const Row y(b.row(v + dv) + left + du, right - left);
    sum_a += x.sum();
    sum_b += y.sum();
    sum_aa += x.square().sum();
    sum_bb += y.square().sum();
    sum_ab += (x * y).sum();
  }
  const double count = static_cast<double>(right - left) * (bottom - top);
  const double spread_a = sum_aa / count - sum_a / count * (sum_a / count);
  const double spread_b = sum_bb / count - sum_b / count * (sum_b / count);
  if (!(spread_a > kPlain) || !(spread_b > kPlain)) return std::nullopt;
  return (sum_ab / count - sum_a / count * (sum_b / count)) / std::sqrt(spread_a * spread_b);
}

}  // namespace

std::optional<Eigen::Vector2d> picture_shift(const tracking::ImagePyramid& first,
                                             const tracking::ImagePyramid& second) {
  if (first.width_px() != second.width_px() || first.height_px() != second.height_px()) return std::nullopt;
  if (first.levels().size() != second.levels().size()) return std::nullopt;
  const Coarse a = coarse(first);
  const Coarse b = coarse(second);
  double best = 0.0;
  std::optional<Eigen::Vector2d> shift_px;
  const int across = static_cast<int>(kOfWidth * a.width_px);
  const int down = static_cast<int>(kOfHeight * a.height_px);
  for (int dv = -down; dv <= down; ++dv) {
    for (int du = -across; du <= across; ++du) {
      const auto now = correlation(a, b, du, dv);
      if (!now || *now <= best) continue;
      best = *now;
      shift_px = a.pixels * Eigen::Vector2d(du, dv);
    }
  }
  return shift_px;
}

}  // namespace homeward::repeat
