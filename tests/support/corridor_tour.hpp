// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "mapping/map_builder.hpp"
#include "support/sample_map.hpp"

namespace homeward::testing {

/// A tour along a corridor as a table of pairs: the visual distance of two images grows with the way between them.
struct CorridorTour {
  std::vector<double> position_m;
  std::vector<map::MapImage> images;
  std::vector<int> tour_of;
  std::vector<features::Appearance> appearances;
  std::vector<mapping::MarkedImage> marks;
  mapping::PairTable pairs{0};

  [[nodiscard]] mapping::MappingInput input() const { return {images, tour_of, appearances, marks, &pairs}; }
};

/// Images taken at these positions; further than `sight_m` apart they have nothing in common. `tour_lengths`: how many
/// images each tour has.
inline CorridorTour corridor_tour(const std::vector<double>& position_m, const std::vector<int>& tour_lengths,
                                  double sight_m = 3.0) {
  CorridorTour tour;
  tour.position_m = position_m;
  tour.pairs = mapping::PairTable(static_cast<int>(position_m.size()));
  for (std::size_t t = 0; t < tour_lengths.size(); ++t) {
    for (int i = 0; i < tour_lengths[t]; ++i) {
      tour.images.push_back(
          {ImageId("t" + std::to_string(t) + "/" + std::to_string(1000 + i) + ".jpg"), std::nullopt, std::nullopt});
      tour.tour_of.push_back(static_cast<int>(t));
    }
  }
  for (std::size_t b = 0; b < position_m.size(); ++b) {
    tour.appearances.push_back(random_appearance(3, static_cast<unsigned>(b)));
    for (std::size_t a = 0; a < b; ++a) {
      const double apart_m = std::abs(position_m[a] - position_m[b]);
      if (apart_m > sight_m) continue;
      mapping::PairRelation relation;
      // Slightly more than by the way alone, different for each pair: no ties.
      relation.distance =
          static_cast<float>(0.5 * apart_m + 0.01 + 0.001 * std::fmod(7.0 * static_cast<double>(a + 3 * b), 11.0));
      relation.inliers = 60;
      relation.match_share = static_cast<float>(0.44 * std::exp(-0.55 * apart_m));  // as in rendered rooms
      relation.confidence = 0.95F;
      relation.parallax_rad = static_cast<float>(std::atan(apart_m / 3.0));  // walls 3 m away
      relation.direction_rad = position_m[b] >= position_m[a] ? 0.0F : 3.14F;
      tour.pairs.set(static_cast<int>(a), static_cast<int>(b), relation);
    }
  }
  return tour;
}

/// `count` images from 0 m to the end and, when asked, the same way back, 0.4 m apart.
inline std::vector<double> walk(int count, bool and_back) {
  std::vector<double> position_m;
  for (int i = 0; i < count; ++i) position_m.push_back(0.4 * i);
  for (int i = count - 1; and_back && i >= 0; --i) position_m.push_back(0.4 * i + 0.02);
  return position_m;
}

}  // namespace homeward::testing
