// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "driving/driving_config.hpp"
#include "features/appearance.hpp"

namespace homeward::recording {

// What decides beside the inputs how a robot drives, as JSON text: numbers come back bit for bit. A key that lacks
// keeps the program's value; one that the program does not know is kUnsupportedFormat, what cannot be is kCorruptFile.

std::string driving_to_json(const driving::DrivingConfig& config);
Result<driving::DrivingConfig> driving_from_json(const std::string& text);

std::string features_to_json(const features::FeatureConfig& config);
Result<features::FeatureConfig> features_from_json(const std::string& text);

}  // namespace homeward::recording
