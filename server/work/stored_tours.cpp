// SPDX-License-Identifier: Apache-2.0
#include "server/work/stored_tours.hpp"

#include <set>

#include "pipeline/thumbnail.hpp"
#include "server/services/tours.hpp"

namespace homeward::server {

std::vector<const TourSource*> StoredTours::views() const {
  std::vector<const TourSource*> views;
  for (const auto& source : sources) views.push_back(source.get());
  return views;
}

Result<StoredTours> open_tours(db::Store& store, const std::vector<TourId>& ids) {
  StoredTours tours;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto tour = store.tour(ids[i]);
    if (!tour) return pass_on(tour);
    auto camera = camera_of(*tour);
    if (!camera) return pass_on(camera);
    if (i == 0) tours.camera = *camera;
    auto source = stored_tour(store, ids[i]);
    if (!source) return pass_on(source);
    tours.sources.push_back(std::move(*source));
  }
  return tours;
}

Status add_thumbnails(const map::TopologicalMap& map, const StoredTours& tours, const std::stop_token& stop,
                      db::Thumbnails& thumbnails) {
  std::set<ImageId> wanted;
  for (const map::Place& place : map.places) wanted.insert(place.prototype);
  for (const map::Hypothesis& hypothesis : map.hypotheses) {
    wanted.insert(hypothesis.prototype_a);
    wanted.insert(hypothesis.prototype_b);
  }
  for (const map::Destination& destination : map.destinations) wanted.insert(destination.image);
  const auto eye = pipeline::Eye::create(map.camera, map.feature_config);
  if (!eye) return pass_on(eye);
  for (const auto& source : tours.sources) {
    for (std::size_t i = 0; i < source->images().size(); ++i) {
      if (stop.stop_requested()) return fail(ErrorCode::kCancelled, "The job was cancelled.", map.name);
      const ImageId& id = source->images()[i].id;
      if (!wanted.contains(id) || thumbnails.contains(id)) continue;
      const auto picture = source->read(i);
      if (!picture) return pass_on(picture);
      auto thumbnail = pipeline::make_thumbnail(*eye, *picture);
      if (!thumbnail) return pass_on(thumbnail);
      thumbnails[id] = std::move(*thumbnail);
    }
  }
  return {};
}

}  // namespace homeward::server
