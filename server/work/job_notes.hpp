// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/result.hpp"
#include "map/topological_map.hpp"
#include "mapping/grow.hpp"
#include "mapping/refine.hpp"
#include "pipeline/build_map.hpp"
#include "wire/reason.hpp"

namespace homeward::server {

/// What a person should know of a build: the pictures left out, with the first of them, and each warning.
std::vector<wire::Reason> notes_of(const pipeline::BuildNotes& build);

/// Which places gained how many appearances; `offered`: would gain.
std::vector<wire::Reason> notes_of(const map::TopologicalMap& map, const mapping::Refinement& refinement, bool offered);

/// What tours brought to a map.
std::vector<wire::Reason> notes_of(const mapping::GrowthCounts& added);

/// The edits that a map could not keep when it was made anew, where that is news after `before`.
std::vector<wire::Reason> notes_of_lost_edits(const std::vector<map::Edit>& before,
                                              const std::vector<map::Edit>& after);

/// One note on pictures that cannot be read, with the first of them; nothing when there are none.
std::vector<wire::Reason> notes_of_skipped(const std::vector<Error>& skipped);

}  // namespace homeward::server
