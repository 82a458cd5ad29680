// SPDX-License-Identifier: Apache-2.0
#include "mapping/new_places.hpp"

#include <algorithm>

#include "core/index.hpp"
#include "mapping/subclusters.hpp"

namespace homeward::mapping {

ImageLabels labels_by_image(const MappingInput& input) {
  ImageLabels labels(input.images.size(), nullptr);
  for (const MarkedImage& mark : input.marks) labels[at(mark.image)] = &mark.label;
  return labels;
}

int first_labelled(std::span<const int> images, const ImageLabels& labels) {
  const auto found = std::ranges::find_if(images, [&](int image) { return labels[at(image)] != nullptr; });
  return found == images.end() ? -1 : *found;
}

map::Place new_place(const MappingInput& input, int image, std::size_t number) {
  map::Place place;
  place.id = PlaceId("new" + std::to_string(number));
  place.prototype = input.images[at(image)].id;
  place.appearances.push_back(input.appearances[at(image)], place.prototype);
  return place;
}

map::Place new_place(const MappingInput& input, std::span<const int> images, const ImageLabels& labels,
                     std::size_t number) {
  const int labelled = first_labelled(images, labels);
  const int prototype =
      labelled >= 0 ? labelled : medoid(images, [&](int a, int b) { return input.pairs->distance(a, b); });
  map::Place place = new_place(input, prototype, number);
  if (labelled >= 0) place.label = *labels[at(labelled)];
  return place;
}

}  // namespace homeward::mapping
