// SPDX-License-Identifier: Apache-2.0
#include "mapping/doubt_kinds.hpp"

#include <utility>

namespace homeward::mapping {

double effect_of(double change_m, const DoubtConfig& config) {
  const double share = change_m / (change_m + config.usual_detour_m);
  return config.least_effect + (1.0 - config.least_effect) * share;
}

map::Edit edit_of(map::EditKind kind, const ImageId& image_a, const ImageId& image_b, std::string text) {
  map::Edit edit;
  edit.kind = kind;
  edit.image_a = image_a;
  edit.image_b = image_b;
  edit.text = std::move(text);
  return edit;
}

}  // namespace homeward::mapping
