// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "core/result.hpp"
#include "driving/driving_state.hpp"

namespace homeward::recording {

/// What outlives the beginning of a mission in the memory of the driving step, but for the sweep, as JSON text: numbers
/// come back bit for bit.
std::string memory_to_json(const driving::DrivingState& before);
/// A key that lacks keeps the program's value. Errors: kUnsupportedFormat for a key that the program does not know,
/// kCorruptFile for what cannot be.
Result<driving::DrivingState> memory_from_json(const std::string& text);

}  // namespace homeward::recording
