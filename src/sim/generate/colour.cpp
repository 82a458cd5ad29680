// SPDX-License-Identifier: Apache-2.0
#include "sim/generate/colour.hpp"

#include <algorithm>
#include <cmath>

namespace homeward::sim {

Rgb scaled(Rgb colour, double factor) {
  for (int& band : colour) band = std::clamp(static_cast<int>(std::lround(band * factor)), 0, 255);
  return colour;
}

Rgb varied(Random& random, Rgb colour, int by) {
  const double lightness = uniform(random, -by, by);
  for (int& band : colour) {
    band = std::clamp(static_cast<int>(std::lround(band + lightness + uniform(random, -0.3 * by, 0.3 * by))), 0, 255);
  }
  return colour;
}

Rgb rich_colour(Random& random) {
  static constexpr std::array<Rgb, 14> kColours = {{{150, 40, 38},
                                                    {40, 70, 130},
                                                    {46, 105, 64},
                                                    {196, 150, 50},
                                                    {110, 60, 110},
                                                    {200, 110, 60},
                                                    {60, 130, 140},
                                                    {120, 78, 48},
                                                    {215, 205, 180},
                                                    {70, 70, 78},
                                                    {180, 90, 110},
                                                    {130, 150, 80},
                                                    {95, 120, 170},
                                                    {225, 190, 140}}};
  return varied(random, kColours[static_cast<std::size_t>(pick(random, kColours.size()))], 18);
}

}  // namespace homeward::sim
