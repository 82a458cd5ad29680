// SPDX-License-Identifier: Apache-2.0
#include "wire/edit_json.hpp"

#include <array>
#include <limits>

#include "map/doubt.hpp"
#include "map/lookup.hpp"
#include "map/pictograms.hpp"
#include "wire/json_reader.hpp"
#include "wire/json_write.hpp"

namespace homeward::wire {
namespace {

using map::EditKind;
using nlohmann::json;

constexpr std::array<std::string_view, map::kEditKinds> kKinds = {"rename",
                                                                  "merge",
                                                                  "split",
                                                                  "delete",
                                                                  "move",
                                                                  "add_edge",
                                                                  "remove_edge",
                                                                  "block_edge",
                                                                  "decide",
                                                                  "decide_shortcut",
                                                                  "add_destination",
                                                                  "remove_destination",
                                                                  "name_destination",
                                                                  "set_pictogram",
                                                                  "set_destination_picture",
                                                                  "set_aside"};

EditKind read_kind(ObjectReader& reader) {
  const std::string name = reader.choice("kind", {kKinds.begin(), kKinds.end()});
  const auto found = std::find(kKinds.begin(), kKinds.end(), name);
  return static_cast<EditKind>(found - kKinds.begin());
}

PlaceId read_place(ObjectReader& reader, const std::string& key) { return PlaceId(reader.text(key, 100)); }

DestinationId read_destination(ObjectReader& reader) { return DestinationId(reader.text("destination", 100)); }

std::string read_pictogram(ObjectReader& reader) {
  std::string name = reader.line("pictogram", 40);
  if (!name.empty() && !map::is_pictogram(name)) reader.problem("pictogram", "There is no pictogram '" + name + "'.");
  return name;
}

std::string read_name(ObjectReader& reader) {
  std::string name = reader.line("label", 200);
  if (name.empty()) reader.problem("label", "A destination needs a name.");
  return name;
}

std::vector<ImageId> read_images(ObjectReader& reader) {
  std::vector<ImageId> images;
  for (const json& item : reader.array("images", 10'000)) {
    if (!item.is_string() || item.get_ref<const std::string&>().size() > 600) {
      reader.problem("images", "'images' must list ids of images.");
      return images;
    }
    images.emplace_back(item.get<std::string>());
  }
  if (images.empty()) reader.problem("images", "'images' must name at least one image.");
  return images;
}

/// Of edits of destinations.
void read_destination_fields(ObjectReader& reader, EditRequest& edit) {
  if (edit.kind != EditKind::kAddDestination) edit.destination = read_destination(reader);
  if (edit.kind == EditKind::kAddDestination || edit.kind == EditKind::kSetDestinationPicture) {
    edit.prototype_a = ImageId(reader.text("image", 600));
  }
  if (edit.kind == EditKind::kAddDestination || edit.kind == EditKind::kNameDestination) edit.label = read_name(reader);
  if (edit.kind == EditKind::kSetPictogram) edit.label = read_pictogram(reader);
}

void read_fields(ObjectReader& reader, EditRequest& edit) {
  switch (edit.kind) {
    case EditKind::kRename:
      edit.place = read_place(reader, "place");
      edit.label = reader.line("label", 200);
      break;
    case EditKind::kMerge:
      edit.place = read_place(reader, "place");
      edit.other = read_place(reader, "into");
      break;
    case EditKind::kSplit:
      edit.place = read_place(reader, "place");
      edit.images = read_images(reader);
      break;
    case EditKind::kDelete:
      edit.place = read_place(reader, "place");
      break;
    case EditKind::kMove:
      edit.images = read_images(reader);
      edit.other = read_place(reader, "into");
      break;
    case EditKind::kBlockEdge:
      edit.yes = reader.boolean("blocked");
      [[fallthrough]];
    case EditKind::kAddEdge:
    case EditKind::kRemoveEdge:
      edit.place = read_place(reader, "from");
      edit.other = read_place(reader, "to");
      break;
    case EditKind::kDecide:
      edit.prototype_a = ImageId(reader.text("prototype_a", 600));
      edit.prototype_b = ImageId(reader.text("prototype_b", 600));
      edit.yes = reader.boolean("accept");
      break;
    case EditKind::kDecideShortcut:
      edit.prototype_a = ImageId(reader.text("image_a", 600));
      edit.prototype_b = ImageId(reader.text("image_b", 600));
      edit.yes = reader.boolean("accept");
      break;
    case EditKind::kSetAside: {
      const auto kinds = map::kDoubtKindNames.all();
      edit.label = reader.choice("about", {kinds.begin(), kinds.end()});
      edit.prototype_a = ImageId(reader.text("image_a", 600));
      edit.prototype_b = ImageId(reader.text("image_b", 600));
      break;
    }
    default:
      read_destination_fields(reader, edit);
  }
}

/// The fields of edits of destinations.
void put_destination(const EditRequest& edit, json& value) {
  if (edit.kind != EditKind::kAddDestination) value["destination"] = edit.destination.str();
  if (edit.kind == EditKind::kAddDestination || edit.kind == EditKind::kSetDestinationPicture) {
    value["image"] = edit.prototype_a.str();
  }
  if (edit.kind == EditKind::kAddDestination || edit.kind == EditKind::kNameDestination) value["label"] = edit.label;
  if (edit.kind == EditKind::kSetPictogram) value["pictogram"] = edit.label;
}

json edit_to_json(const EditRequest& edit) {
  json value = {{"kind", edit_kind_name(edit.kind)}};
  switch (edit.kind) {
    case EditKind::kRename:
      value["place"] = edit.place.str();
      value["label"] = edit.label;
      break;
    case EditKind::kMerge:
      value["place"] = edit.place.str();
      value["into"] = edit.other.str();
      break;
    case EditKind::kSplit:
      value["place"] = edit.place.str();
      value["images"] = ids_to_json(edit.images);
      break;
    case EditKind::kDelete:
      value["place"] = edit.place.str();
      break;
    case EditKind::kMove:
      value["images"] = ids_to_json(edit.images);
      value["into"] = edit.other.str();
      break;
    case EditKind::kBlockEdge:
      value["blocked"] = edit.yes;
      [[fallthrough]];
    case EditKind::kAddEdge:
    case EditKind::kRemoveEdge:
      value["from"] = edit.place.str();
      value["to"] = edit.other.str();
      break;
    case EditKind::kDecide:
      value["prototype_a"] = edit.prototype_a.str();
      value["prototype_b"] = edit.prototype_b.str();
      value["accept"] = edit.yes;
      break;
    case EditKind::kDecideShortcut:
      value["image_a"] = edit.prototype_a.str();
      value["image_b"] = edit.prototype_b.str();
      value["accept"] = edit.yes;
      break;
    case EditKind::kSetAside:
      value["about"] = edit.label;
      value["image_a"] = edit.prototype_a.str();
      value["image_b"] = edit.prototype_b.str();
      break;
    default:
      put_destination(edit, value);
  }
  return value;
}

}  // namespace

std::string_view edit_kind_name(EditKind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

Result<std::vector<EditRequest>> edits_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  const std::vector<json> items = reader.array("edits", kMaxEdits);
  if (items.empty()) reader.problem("edits", "'edits' must hold at least one edit.");
  std::vector<EditRequest> edits;
  for (std::size_t i = 0; i < items.size(); ++i) {
    ObjectReader inner(items[i], reader.path_of("edits") + "/" + std::to_string(i));
    EditRequest edit;
    edit.kind = read_kind(inner);
    read_fields(inner, edit);
    if (const Status status = inner.finish(); !status) return pass_on(status);
    edits.push_back(std::move(edit));
  }
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return edits;
}

json edits_to_json(const std::vector<EditRequest>& edits) {
  json list = json::array();
  for (const EditRequest& edit : edits) list.push_back(edit_to_json(edit));
  return {{"edits", list}};
}

Result<map::Edit> edit_for_map(const EditRequest& request, const map::TopologicalMap& map, const std::string& by,
                               TimeUs t_us) {
  map::Edit edit;
  edit.kind = request.kind;
  edit.text = request.label;
  edit.images = request.images;
  edit.by = by;
  edit.t_us = t_us;
  if (request.kind == EditKind::kDecide || request.kind == EditKind::kDecideShortcut) {
    edit.image_a = request.prototype_a;
    edit.image_b = request.prototype_b;
    edit.text = request.yes ? "accept" : "reject";
    return edit;
  }
  if (request.kind == EditKind::kAddDestination || request.kind == EditKind::kSetAside) {
    edit.image_a = request.prototype_a;
    edit.image_b = request.prototype_b;
    return edit;
  }
  if (!request.destination.empty()) {
    const map::Destination* destination = map::find_destination(map, request.destination);
    if (destination == nullptr) {
      return fail(ErrorCode::kNotFound, "The map has no destination " + request.destination.str() + ".",
                  request.destination.str());
    }
    edit.image_a = destination->image;
    edit.image_b = request.prototype_a;
    return edit;
  }
  if (request.kind == EditKind::kBlockEdge) edit.text = request.yes ? "true" : "false";
  const auto image_of = [&](const PlaceId& id) -> Result<ImageId> {
    const map::Place* place = map::find_place(map, id);
    if (place == nullptr) return fail(ErrorCode::kUnknownPlace, "There is no place " + id.str() + ".", id.str());
    return place->prototype;
  };
  // The log names first the place that stays: for merge and move that is the one which things go into.
  const bool into = request.kind == EditKind::kMerge || request.kind == EditKind::kMove;
  const PlaceId& first = into ? request.other : request.place;
  const PlaceId& second = into ? request.place : request.other;
  const Result<ImageId> image_a = image_of(first);
  if (!image_a) return pass_on(image_a);
  edit.image_a = *image_a;
  if (second.empty()) return edit;
  const Result<ImageId> image_b = image_of(second);
  if (!image_b) return pass_on(image_b);
  edit.image_b = *image_b;
  return edit;
}

json logged_edit_to_json(const map::Edit& edit) {
  return {{"kind", edit_kind_name(edit.kind)},
          {"image_a", edit.image_a.str()},
          {"image_b", edit.image_b.empty() ? json(nullptr) : json(edit.image_b.str())},
          {"text", edit.text},
          {"images", ids_to_json(edit.images)},
          {"by", edit.by},
          {"t_us", edit.t_us},
          {"undone", edit.undone},
          {"change", edit.change},
          {"redoable", edit.redoable},
          {"lost", edit.lost.empty() ? json(nullptr) : json(edit.lost)}};
}

Result<map::Edit> logged_edit_from_json(const json& value, const std::string& path) {
  ObjectReader reader(value, path);
  map::Edit edit;
  edit.kind = read_kind(reader);
  edit.image_a = ImageId(reader.text("image_a"));
  edit.image_b = ImageId(reader.optional_text("image_b").value_or(""));
  edit.text = reader.text("text");
  for (const json& image : reader.array("images")) {
    if (!image.is_string()) {
      reader.problem("images", "'images' must list ids of images.");
      break;
    }
    edit.images.emplace_back(image.get<std::string>());
  }
  edit.by = reader.text("by");
  edit.t_us = reader.integer("t_us", 0, std::numeric_limits<std::int64_t>::max());
  edit.undone = reader.boolean("undone");
  edit.change = reader.integer("change", 1, std::numeric_limits<std::int64_t>::max());
  edit.redoable = reader.boolean("redoable");
  edit.lost = reader.optional_text("lost").value_or("");
  if (const Status status = reader.finish(); !status) return pass_on(status);
  return edit;
}

}  // namespace homeward::wire
