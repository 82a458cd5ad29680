// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "wire/json_reader.hpp"
#include "wire/link_messages.hpp"

namespace homeward::wire {

// What robots that explore together say to each other, in the codec of the link: all but "type" and "v".

void add_fields(nlohmann::json& value, const Companion& m);
void add_fields(nlohmann::json& value, const CompanionView& m);
void add_fields(nlohmann::json& value, const CompanionState& m);

/// The reader keeps the first problem.
Companion read_companion(ObjectReader& reader);
CompanionView read_companion_view(ObjectReader& reader);
CompanionState read_companion_state(ObjectReader& reader);

}  // namespace homeward::wire
