// SPDX-License-Identifier: Apache-2.0
#include "driving/footprint.hpp"

#include <algorithm>
#include <cmath>

#include "core/angles.hpp"

namespace homeward::driving {

Footprint::Footprint(const Outline& outline, double first_heading_rad, int headings) {
  const double r = outline.radius_m;
  const double middle_m = 0.5 * (outline.front_m - outline.back_m);
  const double half_length_m = 0.5 * (outline.front_m + outline.back_m) + r;
  const double half_width_m = outline.side_m + r;
  std::vector<Disc> discs;
  const auto add = [&](double x_m, double y_m, double radius_m) {
    discs.push_back({static_cast<float>(middle_m + x_m), static_cast<float>(y_m), static_cast<float>(radius_m)});
  };
  add(0.0, 0.0, std::hypot(half_length_m - r, half_width_m - r) + r);
  // Along the longer axis, as large as fits, so close together that the outline hardly dips between two.
  const double large_m = std::min(half_length_m, half_width_m);
  const double row_m = std::max(half_length_m, half_width_m) - large_m;
  const int gaps = static_cast<int>(std::ceil(2.0 * row_m / (0.5 * large_m)));
  for (int i = 0; i <= gaps; ++i) {
    const double along_m = gaps == 0 ? 0.0 : -row_m + 2.0 * row_m * i / gaps;
    half_length_m >= half_width_m ? add(along_m, 0.0, large_m) : add(0.0, along_m, large_m);
  }
  // What these leave out in the corners; smaller ones than the corners' own radius have nothing to add.
  constexpr double kLeast_m = 0.05;
  for (double small_m = 0.5 * large_m; small_m > std::max(kLeast_m, r); small_m *= 0.45) {
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-1.0, 1.0}) add(x * (half_length_m - small_m), y * (half_width_m - small_m), small_m);
    }
  }
  // Corners are what is in the way most often, and are asked about first.
  std::reverse(discs.begin() + 1, discs.end());
  count_ = discs.size();
  for (int heading = 0; heading < headings; ++heading) {
    const double angle_rad = first_heading_rad + 2.0 * kPi * heading / headings;
    const auto c = static_cast<float>(std::cos(angle_rad));
    const auto s = static_cast<float>(std::sin(angle_rad));
    for (const Disc& disc : discs) {
      turned_.push_back({c * disc.x_m - s * disc.y_m, s * disc.x_m + c * disc.y_m, disc.radius_m});
    }
  }
}

float Footprint::clearance_m(const DistanceField& field, float x_m, float y_m, int heading, float least_m,
                             float enough_m) const {
  const Disc* disc = turned_.data() + static_cast<std::size_t>(heading) * count_;
  const Disc* end = disc + count_;
  const float coarse_m = field.at(x_m + disc->x_m, y_m + disc->y_m) - disc->radius_m;
  if (coarse_m >= enough_m) return coarse_m;
  float nearest_m = enough_m;
  for (++disc; disc != end && nearest_m >= least_m; ++disc) {
    nearest_m = std::min(nearest_m, field.at(x_m + disc->x_m, y_m + disc->y_m) - disc->radius_m);
  }
  return nearest_m;
}

}  // namespace homeward::driving
