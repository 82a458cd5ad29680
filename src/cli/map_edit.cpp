// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/command.hpp"
#include "cli/map.hpp"
#include "cli/map_output.hpp"
#include "db/map_file.hpp"
#include "files/read_file.hpp"
#include "map/parts.hpp"
#include "mapping/edit_log.hpp"
#include "pipeline/eye.hpp"
#include "wire/edit_json.hpp"

namespace homeward::cli {
namespace {

struct MapEditOptions {
  std::string map;
  std::string edits;
  std::string out;
  std::vector<std::string> tours;
  std::string by = "command line";
  bool undo = false;
  bool redo = false;
  bool json = false;
};

/// Pictures of the map's tours, as its camera sees them.
class Pictures {
 public:
  Pictures(const map::TopologicalMap& map, const TourFolders& tours) : map_(map), tours_(tours.sources()) {}

  Result<features::Appearance> look_at(const ImageId& image) {
    for (const TourSource* tour : tours_) {
      for (std::size_t i = 0; i < tour->images().size(); ++i) {
        if (tour->images()[i].id != image) continue;
        const auto picture = tour->read(i);
        if (!picture) return pass_on(picture);
        if (!eye_) {
          auto eye = pipeline::Eye::create(map_.camera, map_.feature_config);
          if (!eye) return pass_on(eye);
          eye_.emplace(std::move(*eye));
        }
        return eye_->look(*picture);
      }
    }
    return fail(ErrorCode::kNotFound, "None of the tours has it; name its folder with --tour.", image.str());
  }

 private:
  const map::TopologicalMap& map_;
  std::vector<const TourSource*> tours_;
  std::optional<pipeline::Eye> eye_;
};

Result<std::vector<wire::EditRequest>> read_edits(const std::string& file) {
  const auto text = files::read_text(file);
  if (!text) return pass_on(text);
  const nlohmann::json value = nlohmann::json::parse(*text, nullptr, false);
  if (value.is_discarded()) return fail(ErrorCode::kInvalidInput, "This is not JSON.", file);
  auto edits = wire::edits_from_json(value, "edits");
  if (!edits) return fail(edits.error().code, edits.error().message, file + ": " + edits.error().where);
  return edits;
}

Status apply(const MapEditOptions& options, map::TopologicalMap& map, Pictures& pictures) {
  if (options.undo) return mapping::undo_change(map);
  if (options.redo) return mapping::redo_change(map, [&](const ImageId& image) { return pictures.look_at(image); });
  const auto edits = read_edits(options.edits);
  if (!edits) return pass_on(edits);
  const TimeUs t_us = now_us();
  const std::int64_t change = mapping::next_change(map);
  for (std::size_t i = 0; i < edits->size(); ++i) {
    const std::string where = options.edits + ": edits/" + std::to_string(i);
    auto lasting = wire::edit_for_map((*edits)[i], map, options.by, t_us);
    if (!lasting) return fail(lasting.error().code, lasting.error().message, where);
    lasting->change = change;
    const auto look = [&](const ImageId& image) { return pictures.look_at(image); };
    if (const Status status = mapping::apply_edit(map, *lasting, look); !status) {
      return fail(status.error().code, status.error().message, where);
    }
  }
  return {};
}

Status edit(const MapEditOptions& options) {
  const int asked = (options.edits.empty() ? 0 : 1) + (options.undo ? 1 : 0) + (options.redo ? 1 : 0);
  if (asked != 1) return fail(ErrorCode::kInvalidInput, "Say one of --edits, --undo and --redo.", "map edit");
  auto stored = db::load_map(options.map);
  if (!stored) return pass_on(stored);
  const auto tours = TourFolders::open(options.tours);
  if (!tours) return pass_on(tours);
  map::TopologicalMap edited = stored->map;
  Pictures pictures(stored->map, *tours);
  if (const Status status = apply(options, edited, pictures); !status) {
    return fail(status.error().code, status.error().message,
                status.error().where.empty() ? options.map : status.error().where);
  }
  if (!options.tours.empty()) {
    if (Status made = add_thumbnails(edited, *tours, stored->thumbnails); !made) return made;
  }
  if (const Status saved = db::save_map(options.out, edited, stored->thumbnails); !saved) return saved;
  const std::vector<map::MapPart> parts = map::parts(edited);
  if (options.json) {
    print_json({{"map", options.out},
                {"revision", edited.revision},
                {"places", edited.places.size()},
                {"edges", edited.edges.size()},
                {"destinations", edited.destinations.size()},
                {"parts", parts.size()}});
  } else {
    std::cout << summary(edited) << ", revision " << edited.revision << ": " << options.out << "\n"
              << map::tell_parts(parts);
  }
  return {};
}

}  // namespace

void register_map_edit(CLI::App& map) {
  CLI::App* command = map.add_subcommand("edit", "Change a map by hand, all edits of a file or none");
  const auto options = std::make_shared<MapEditOptions>();
  command->add_option("--map", options->map, "Map file")->required();
  command->add_option("--edits", options->edits, "JSON file of edits (proto/schemas/edits.schema.json)");
  command->add_flag("--undo", options->undo, "Instead: take the latest change back");
  command->add_flag("--redo", options->redo, "Instead: make the change again that was taken back last");
  command->add_option("--out", options->out, "Map file to write; may be the same")->required();
  command->add_option("--tour", options->tours, "Folder of a tour of the map, for edits that need its pictures");
  command->add_option("--by", options->by, "Who made the edits, for the log")->capture_default_str();
  command->add_flag("--json", options->json, "Print the outcome as JSON");
  run_on(*command, [options] { return edit(*options); });
}

}  // namespace homeward::cli
