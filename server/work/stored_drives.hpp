// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/result.hpp"
#include "db/store.hpp"
#include "map/topological_map.hpp"
#include "pipeline/refine_map.hpp"

namespace homeward::server {

/// What each of these drives saw; those that are no longer kept are left out. Errors: kFeatureConfigMismatch (all of
/// them saw other features than the map has), those of the store and of wire::decode_appearance.
Result<std::vector<std::vector<pipeline::DriveSight>>> drives_of(db::Store& store, const std::vector<MissionId>& drives,
                                                                 const map::TopologicalMap& map);

/// All sights of drives, with one of no place after each: the next drive begins elsewhere.
std::vector<pipeline::DriveSight> one_after_the_other(const std::vector<std::vector<pipeline::DriveSight>>& drives);

}  // namespace homeward::server
