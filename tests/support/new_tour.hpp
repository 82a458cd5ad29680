// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "mapping/growth_input.hpp"
#include "support/sample_map.hpp"

namespace homeward::testing {

/// A tour of so many pictures to be added to a map, <name>/1000.jpg and so on, that look like nothing else.
inline mapping::NewTours new_tour(int pictures, const std::string& name = "new") {
  mapping::NewTours tours;
  for (int i = 0; i < pictures; ++i) {
    tours.images.push_back({ImageId(name + "/" + std::to_string(1000 + i) + ".jpg"), std::nullopt, std::nullopt});
    tours.tour_of.push_back(0);
    tours.appearances.push_back(random_appearance(3, static_cast<unsigned>(500 + i)));
  }
  return tours;
}

}  // namespace homeward::testing
