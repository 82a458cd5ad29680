// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::mapping {

// What people's edits do to the places of a map, see edits.hpp. Errors: kInvalidInput (what is wrong), kNotFound (an
// image that no place holds).

/// The error that no place of the map holds an image.
tl::unexpected<Error> no_place_with(const ImageId& image);

/// An edge each way between two places where there is none; weak, for no picture has seen it.
void join_both_ways(map::TopologicalMap& map, const PlaceId& a, const PlaceId& b, map::Decider by);

/// The place of `image_b` joins that of `image_a`.
Status merge_places(map::TopologicalMap& map, const ImageId& image_a, const ImageId& image_b);

/// Images leave the place of `image_a`, whose prototype stays, and become a place of their own, joined with the places
/// before and after them on the tour.
Status split_place(map::TopologicalMap& map, const ImageId& image_a, const std::vector<ImageId>& named);

/// Images, no prototypes, leave their places for that of `image_a`. The map is unchanged where one of them cannot.
Status move_images(map::TopologicalMap& map, const ImageId& image_a, const std::vector<ImageId>& images);

/// The place of an image goes, with its edges and destinations.
Status delete_place(map::TopologicalMap& map, const ImageId& image);

}  // namespace homeward::mapping
