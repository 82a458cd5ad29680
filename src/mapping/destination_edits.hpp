// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/result.hpp"
#include "mapping/edit_scene.hpp"

namespace homeward::mapping {

// What people's edits do to names and destinations, see edit_log.hpp. Errors: kInvalidInput, kNotFound (image or
// destination), kConflict (a picture that nothing here knows); the map is then unchanged.

/// The place of image_a gets the label `text`.
Status rename_place(EditScene& scene);

/// image_a becomes a destination called `text`: arrival is at its place, facing as the picture does.
Status add_destination(EditScene& scene);

/// The destination of image_a goes.
Status remove_destination(EditScene& scene);

/// The destination of image_a is called `text`.
Status name_destination(EditScene& scene);

/// The destination of image_a is known by the pictogram `text` (map::kPictograms); by none where that is empty.
Status set_pictogram(EditScene& scene);

/// The destination of image_a is where image_b was taken, facing as that does.
Status set_destination_picture(EditScene& scene);

}  // namespace homeward::mapping
