// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/tour.hpp"
#include "db/map_file.hpp"
#include "files/tour_folder.hpp"
#include "map/topological_map.hpp"

namespace homeward::cli {

/// The folders of several tours.
class TourFolders {
 public:
  /// Errors: those of TourFolder::open; kInvalidInput (two folders of one name: their pictures would be the same).
  static Result<TourFolders> open(const std::vector<std::string>& folders);
  [[nodiscard]] std::vector<const TourSource*> sources() const;

 private:
  std::vector<files::TourFolder> tours_;
};

/// Adds thumbnails of what a dashboard shows and `thumbnails` lacks: prototypes, destinations, hypotheses.
Status add_thumbnails(const map::TopologicalMap& map, const TourFolders& tours, db::Thumbnails& thumbnails);

/// "300 pictures, 57 places, ..."
std::string summary(const map::TopologicalMap& map);

/// One JSON object on standard output; file names that are no UTF-8 are made readable.
void print_json(const nlohmann::json& value);

/// Tells on stderr which pictures were left out and why.
void tell_skipped(const std::vector<Error>& skipped);

struct AddToOptions {
  std::string map;     // file
  std::string camera;  // file; empty: the map's
  std::string out;     // file
  int threads = 0;
  std::uint64_t seed = 1;
  bool json = false;
};

/// `homeward map build --add-to`.
Status add_to_map(const AddToOptions& options, const TourFolders& tours);

}  // namespace homeward::cli
