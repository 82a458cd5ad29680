// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/ids.hpp"
#include "core/result.hpp"
#include "core/time.hpp"
#include "map/topological_map.hpp"

namespace homeward::wire {

/// One edit as a person asks for it, in terms of the places of one revision
/// (proto/schemas/edits.schema.json). Which fields count depends on the kind:
///   rename {place, label}         merge {place, into}          split {place, images}      move {images, into}
///   delete {place}                add_edge / remove_edge {from, to}    block_edge {from, to, blocked}
///   decide {prototype_a, prototype_b, accept}                  decide_shortcut {image_a, image_b, accept}
///   add_destination {image, label}                             remove_destination {destination}
///   name_destination {destination, label}                      set_pictogram {destination, pictogram}
///   set_destination_picture {destination, image}               set_aside {about, image_a, image_b}
struct EditRequest {
  map::EditKind kind = map::EditKind::kRename;
  PlaceId place;      // also: from
  PlaceId other;      // into, to
  std::string label;  // also: pictogram, about
  DestinationId destination;
  std::vector<ImageId> images;
  ImageId prototype_a;  // also: image_a, image_b, image
  ImageId prototype_b;
  bool yes = false;  // blocked, accept
};

inline constexpr std::size_t kMaxEdits = 1000;

std::string_view edit_kind_name(map::EditKind kind);

/// Reads {"edits":[...]}, strictly, 1 to kMaxEdits of them. Errors: kInvalidInput.
Result<std::vector<EditRequest>> edits_from_json(const nlohmann::json& value, const std::string& path = "body");
nlohmann::json edits_to_json(const std::vector<EditRequest>& edits);

/// The edit in the lasting form of a map's log, keyed to images. Errors: kUnknownPlace, kNotFound (destination).
Result<map::Edit> edit_for_map(const EditRequest& request, const map::TopologicalMap& map, const std::string& by,
                               TimeUs t_us);

/// An entry of the log of a map or of a draft: {kind, image_a, image_b, text, images, by, t_us, undone, change,
/// redoable, lost}.
nlohmann::json logged_edit_to_json(const map::Edit& edit);

/// Reads what logged_edit_to_json wrote (proto/schemas/logged_edit.schema.json). Errors: kInvalidInput.
Result<map::Edit> logged_edit_from_json(const nlohmann::json& value, const std::string& path);

}  // namespace homeward::wire
