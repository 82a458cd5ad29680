// SPDX-License-Identifier: Apache-2.0
#include "mapping/destination_edits.hpp"

#include <algorithm>
#include <string>

#include "map/lookup.hpp"
#include "map/pictograms.hpp"
#include "mapping/place_edits.hpp"

namespace homeward::mapping {
namespace {

constexpr std::size_t kMaxLabelBytes = 200;

Status check_label(const std::string& label) {
  if (label.size() <= kMaxLabelBytes) return {};
  return fail(ErrorCode::kInvalidInput, "A label may be at most 200 bytes long.", "label");
}

Status check_destination_label(const std::string& label) {
  if (label.empty()) return fail(ErrorCode::kInvalidInput, "A destination needs a name.", "label");
  return check_label(label);
}

map::Destination* destination_of(map::TopologicalMap& map, const ImageId& image) {
  const auto found = std::ranges::find(map.destinations, image, &map::Destination::image);
  return found == map.destinations.end() ? nullptr : &*found;
}

Error no_destination(const ImageId& image) {
  return {ErrorCode::kNotFound, "The map has no destination at the picture " + image.str() + ".", image.str()};
}

}  // namespace

Status rename_place(EditScene& scene) {
  map::Place* place = map::find_place_of(scene.map(), scene.edit().image_a);
  if (place == nullptr) return no_place_with(scene.edit().image_a);
  if (const Status fits = check_label(scene.edit().text); !fits) return fits;
  place->label = scene.edit().text;
  return {};
}

Status add_destination(EditScene& scene) {
  const map::Edit& edit = scene.edit();
  if (const Status fits = check_destination_label(edit.text); !fits) return fits;
  const map::Place* place = map::find_place_of(scene.map(), edit.image_a);
  if (place == nullptr) return no_place_with(edit.image_a);
  if (const map::Destination* known = destination_of(scene.map(), edit.image_a)) {
    return scene.already_so(
        {ErrorCode::kConflict,
         "The picture " + edit.image_a.str() + " is the destination '" + known->label + "' already.",
         edit.image_a.str()});
  }
  const auto seen = scene.look_at(edit.image_a);
  if (!seen) return pass_on(seen);
  map::Destination destination;
  destination.place = place->id;
  destination.image = edit.image_a;
  destination.label = edit.text;
  destination.appearance = *seen->appearance;
  destination.id = scene.made_destination();
  scene.map().destinations.push_back(std::move(destination));
  return {};
}

Status remove_destination(EditScene& scene) {
  auto& destinations = scene.map().destinations;
  const auto removed =
      std::erase_if(destinations, [&](const map::Destination& one) { return one.image == scene.edit().image_a; });
  return removed > 0 ? Status() : scene.already_so(no_destination(scene.edit().image_a));
}

Status name_destination(EditScene& scene) {
  if (const Status fits = check_destination_label(scene.edit().text); !fits) return fits;
  map::Destination* destination = destination_of(scene.map(), scene.edit().image_a);
  if (destination == nullptr) return tl::unexpected<Error>(no_destination(scene.edit().image_a));
  destination->label = scene.edit().text;
  return {};
}

Status set_pictogram(EditScene& scene) {
  const map::Edit& edit = scene.edit();
  if (!edit.text.empty() && !map::is_pictogram(edit.text)) {
    return fail(ErrorCode::kInvalidInput, "There is no pictogram '" + edit.text + "'.", "pictogram");
  }
  map::Destination* destination = destination_of(scene.map(), edit.image_a);
  if (destination == nullptr) return tl::unexpected<Error>(no_destination(edit.image_a));
  destination->pictogram = edit.text;
  return {};
}

Status set_destination_picture(EditScene& scene) {
  const map::Edit& edit = scene.edit();
  const map::Place* place = map::find_place_of(scene.map(), edit.image_b);
  if (place == nullptr) return no_place_with(edit.image_b);
  if (const map::Destination* known = destination_of(scene.map(), edit.image_b)) {
    return scene.already_so(
        {ErrorCode::kConflict,
         "The picture " + edit.image_b.str() + " is the destination '" + known->label + "' already.",
         edit.image_b.str()});
  }
  if (destination_of(scene.map(), edit.image_a) == nullptr) {
    return tl::unexpected<Error>(no_destination(edit.image_a));
  }
  const auto seen = scene.look_at(edit.image_b);
  if (!seen) return pass_on(seen);
  map::Destination& destination = *destination_of(scene.map(), edit.image_a);
  destination.place = place->id;
  destination.image = edit.image_b;
  destination.appearance = *seen->appearance;
  return {};
}

}  // namespace homeward::mapping
