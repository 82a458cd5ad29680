// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <stop_token>
#include <vector>

#include "core/tour.hpp"
#include "db/store.hpp"

namespace homeward::server {

/// Tours of the store with one camera, opened for the pipeline.
struct StoredTours {
  std::vector<std::unique_ptr<TourSource>> sources;
  camera::CameraConfig camera;

  [[nodiscard]] std::vector<const TourSource*> views() const;
};

/// Errors: kNotFound.
Result<StoredTours> open_tours(db::Store& store, const std::vector<TourId>& ids);

/// Adds pictures of the places, their look-alikes and destinations, as far as the tours have them; others are made when
/// somebody asks. Errors: kCancelled, those of TourSource::read.
Status add_thumbnails(const map::TopologicalMap& map, const StoredTours& tours, const std::stop_token& stop,
                      db::Thumbnails& thumbnails);

}  // namespace homeward::server
