// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace homeward::wire {

/// One line of what `homeward repeat` prints (proto/schemas/repeated.schema.json).
struct RepeatedView {
  std::string image;
  int arc = 0;
  std::string from;  // file names of its key images
  std::string to;
  int tracked = 0;
  int expected = 0;
  int predicted = 0;
  int recovered = 0;
  double progress = 0.0;
  double lateral_over_arc = 0.0;
  double steering_rad = 0.0;
  std::optional<double> bearing_rad;  // of the next key image
  double error_px = 0.0;
  double confidence = 0.0;
  bool structure_agrees = true;
  bool at_end = false;
  std::string lost;  // why; empty: it is not
  double ms = 0.0;
};

nlohmann::json repeated_to_json(const RepeatedView& view);

}  // namespace homeward::wire
