// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "agent/link/rest_client.hpp"
#include "core/range_sweep.hpp"

namespace homeward::agent {

struct UploadOptions {
  std::string folder;
  std::string camera;  // camera.json; empty: the one in the folder
  std::string name;
  /// No other tour has this name: one that is complete is this one, of which the word that it is did not arrive.
  bool own_name = false;
  /// Of the pictures in their order, in place of those of the folder; empty: those.
  std::vector<RangeSweep> sweeps = {};
};

struct UploadedTour {
  std::string id;
  std::vector<Error> skipped;  // pictures that the server cannot read; the tour is made of the others
};

/// Brings a folder's tour to a server: pictures, times, odometry, sweeps and marks. A tour of the same name that is
/// still open is carried on with; one of its own name that is complete is given as it is. Errors: those of TourFolder
/// and read_camera, kIo, and what the server refuses but for single pictures that it cannot read. `progress` hears the
/// share that is there; false ends it (kConflict).
Result<UploadedTour> upload_tour(RestClient& server, const UploadOptions& options,
                                 const std::function<bool(double)>& progress);

}  // namespace homeward::agent
