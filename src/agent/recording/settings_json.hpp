// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "agent/driving/step.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"

namespace homeward::agent {

// What decides beside the inputs how the heart drives, as JSON text: numbers come back bit for bit. A key that lacks
// keeps the program's value; one that the program does not know is kUnsupportedFormat, what cannot be is kCorruptFile.

std::string driving_to_json(const DrivingConfig& config);
Result<DrivingConfig> driving_from_json(const std::string& text);

std::string features_to_json(const features::FeatureConfig& config);
Result<features::FeatureConfig> features_from_json(const std::string& text);

}  // namespace homeward::agent
