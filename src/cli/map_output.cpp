// SPDX-License-Identifier: Apache-2.0
#include "cli/map_output.hpp"

#include <algorithm>
#include <iostream>
#include <set>

#include "cli/command.hpp"
#include "map/parts.hpp"
#include "pipeline/eye.hpp"
#include "pipeline/thumbnail.hpp"

namespace homeward::cli {

Result<TourFolders> TourFolders::open(const std::vector<std::string>& folders) {
  TourFolders result;
  std::set<std::string> names;
  for (const std::string& folder : folders) {
    auto tour = files::TourFolder::open(folder);
    if (!tour) return pass_on(tour);
    const std::string name = map::tour_of(tour->images().front().id);
    if (!names.insert(name).second) {
      return fail(ErrorCode::kInvalidInput,
                  "Two tours are named " + name + ": rename a folder, pictures are known by tour and file.", folder);
    }
    result.tours_.push_back(std::move(*tour));
  }
  return result;
}

std::vector<const TourSource*> TourFolders::sources() const {
  std::vector<const TourSource*> sources;
  for (const files::TourFolder& tour : tours_) sources.push_back(&tour);
  return sources;
}

Status add_thumbnails(const map::TopologicalMap& map, const TourFolders& tours, db::Thumbnails& thumbnails) {
  const auto eye = pipeline::Eye::create(map.camera, map.feature_config);
  if (!eye) return pass_on(eye);
  std::set<ImageId> wanted;
  for (const map::Place& place : map.places) wanted.insert(place.prototype);
  for (const map::Destination& destination : map.destinations) wanted.insert(destination.image);
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    wanted.insert(hypothesis.prototype_a);
    wanted.insert(hypothesis.prototype_b);
  }
  for (const TourSource* tour : tours.sources()) {
    for (std::size_t i = 0; i < tour->images().size(); ++i) {
      const ImageId& id = tour->images()[i].id;
      if (!wanted.contains(id) || thumbnails.contains(id)) continue;
      const auto picture = tour->read(i);
      if (!picture) return pass_on(picture);
      auto thumbnail = pipeline::make_thumbnail(*eye, *picture);
      if (!thumbnail) return pass_on(thumbnail);
      thumbnails.emplace(id, std::move(*thumbnail));
    }
  }
  return {};
}

std::string summary(const map::TopologicalMap& map) {
  return std::to_string(map.images.size()) + " pictures, " + std::to_string(map.places.size()) + " places, " +
         std::to_string(map.edges.size()) + " edges, " + std::to_string(map.destinations.size()) + " destinations";
}

void print_json(const nlohmann::json& value) {
  std::cout << value.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) << "\n";
}

void tell_skipped(const std::vector<Error>& skipped) {
  for (const Error& error : skipped) tell({error.code, "A picture was left out. " + error.message, error.where});
}

}  // namespace homeward::cli
