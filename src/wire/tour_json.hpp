// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "camera/camera_config.hpp"
#include "core/ids.hpp"
#include "core/result.hpp"
#include "core/time.hpp"

namespace homeward::wire {

/// A tour on the server (proto/schemas/tour_info.schema.json).
struct TourView {
  TourId id;
  std::string name;
  bool complete = false;  // else open for more pictures
  std::int64_t images = 0;
  camera::CameraConfig camera;
  TimeUs created_us = 0;
  std::vector<std::int64_t> missing;  // numbers below the highest one that no picture has; the first 100
};

nlohmann::json tour_info_to_json(const TourView& tour);

/// A picture of the tour that is a destination.
struct TourMark {
  std::string image;  // file name within the tour
  std::string label;
};

/// tour.json (proto/schemas/tour.schema.json): {"marks":[{"image","label"}]}, and nothing else.
nlohmann::json marks_to_json(const std::vector<TourMark>& marks);

/// Strict; labels must not be empty, an image bears one mark at most. `path` starts the JSON paths of errors.
/// Errors: kInvalidInput.
Result<std::vector<TourMark>> marks_from_json(const nlohmann::json& value, const std::string& path = "tour");

/// The same from text.
Result<std::vector<TourMark>> parse_marks(const std::string& text, const std::string& where);

}  // namespace homeward::wire
