// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/mapping_input.hpp"

namespace homeward::mapping {

/// Of each image the label that a person gave it, null where there is none.
using ImageLabels = std::vector<const std::string*>;

/// The labels of marked images. The input outlives them.
ImageLabels labels_by_image(const MappingInput& input);

/// The first of the images that has a label; -1: none has.
int first_labelled(std::span<const int> images, const ImageLabels& labels);

/// A place that the map has no id for yet, seen from one image, its prototype. `number` tells it from other new ones.
/// Members are left to the caller.
map::Place new_place(const MappingInput& input, int image, std::size_t number);

/// The same from several images: the prototype is the first that has a label, which names the place, else their medoid.
/// Precondition: `images` is not empty.
map::Place new_place(const MappingInput& input, std::span<const int> images, const ImageLabels& labels,
                     std::size_t number);

}  // namespace homeward::mapping
