// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "mapping/edit_scene.hpp"

namespace homeward::mapping {

// What people's edits do to the places of a map, see edit_log.hpp. Errors: kInvalidInput (what is wrong), kNotFound (an
// image that no place holds), kConflict (what cannot hold); the map is then unchanged.

/// The error that no place of the map holds an image.
tl::unexpected<Error> no_place_with(const ImageId& image);

/// The place of `image_b` joins that of `image_a`, with all it has; ways from there are seen anew, from the prototype
/// that is left.
Status merge_places(EditScene& scene, const ImageId& image_a, const ImageId& image_b);

/// Images leave the place of `image_a` and become a place of their own. Ways that only they were driven from go with
/// them, and tours join the new place with those before and after it. Whichever part has lost the prototype gets
/// another: the middle one of its images.
Status split_place(EditScene& scene, const ImageId& image_a, const std::vector<ImageId>& images);

/// Images leave their places for that of `image_a`; a place that loses all of them is one to merge instead. Ways follow
/// the tours as in a split.
Status move_images(EditScene& scene, const ImageId& image_a, const std::vector<ImageId>& images);

/// The place of an image goes, with its edges and destinations.
Status delete_place(EditScene& scene, const ImageId& image);

}  // namespace homeward::mapping
