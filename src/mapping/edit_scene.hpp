// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/result.hpp"
#include "map/topological_map.hpp"

namespace homeward::mapping {

/// What a picture of the tours looks like to the map that is edited. Errors: kNotFound (it is not kept).
using LookAt = std::function<Result<features::Appearance>(const ImageId&)>;

/// A map while one edit is applied to it. What is found out on the way is kept with the edit (map::EditFindings) and
/// taken from there when the edit is applied again.
class EditScene {
 public:
  /// `look` may be empty: then pictures are known by what the map and the edit keep of them. `again`: a rebuilt map may
  /// be as the edit wants it.
  EditScene(map::TopologicalMap& map, map::Edit& edit, const LookAt& look, bool again)
      : map_(map), edit_(edit), look_(look), again_(again) {}

  [[nodiscard]] map::TopologicalMap& map() { return map_; }
  [[nodiscard]] const map::Edit& edit() const { return edit_; }
  /// Keeps with the edit which images it took away, for when it is applied again.
  void keep_images(std::vector<ImageId> images) { edit_.images = std::move(images); }
  /// Where the map is as the edit wants it: fine for an edit that is applied again, else the given error.
  [[nodiscard]] Status already_so(Error otherwise) const {
    return again_ ? Status() : Status(tl::unexpected<Error>(std::move(otherwise)));
  }

  /// Errors: kConflict: nothing here knows what the picture looks like.
  Result<map::AppearanceList::Entry> look_at(const ImageId& image);

  /// Which of these images is the prototype of their place: the one chosen before, else the middle one.
  ImageId prototype_among(const std::vector<ImageId>& images);

  /// The id of the place or destination that the edit makes, the same each time.
  PlaceId made_place();
  DestinationId made_destination();

  /// Bearing, turn, confidence and weakness of an edge, as the prototypes of its ends see each other (Sights). Its
  /// length stays.
  void see(map::Edge& edge);

 private:
  [[nodiscard]] std::string made(char letter, std::int64_t& next_number,
                                 const std::function<bool(const std::string&)>& is_free) const;

  map::TopologicalMap& map_;
  map::Edit& edit_;
  const LookAt& look_;
  bool again_;
};

}  // namespace homeward::mapping
