// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/ids.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "core/tour.hpp"
#include "features/appearance.hpp"
#include "map/replay_check.hpp"
#include "map/topological_map.hpp"
#include "pipeline/build_map.hpp"
#include "pipeline/refine_map.hpp"

namespace homeward::pipeline {

/// A picture of a tour of the map, or what a drive saw.
struct KeptPicture {
  ImageId image;  // of a drive: the prototype of the place that its belief was sure of
  int tour = 0;   // another number for each tour and each drive
  features::Appearance seen;
  std::optional<RangeSweep> sweep = std::nullopt;  // taken with it
  bool by_drive = false;
};

using map::ReplayCheck;
using map::Worsening;
using map::WorseSpot;

/// Tries edits before they count: localises the pictures of the kept tours and drives on the map before and after them,
/// looks whether pictures that came to a place show it and were taken near it, whether new ways are seen, and whether
/// all destinations still lead to each other. Where pictures come with sweeps, these say what stands between two spots,
/// and what is free. What was no better before is not told. `after` is `before`, edited. The result does not depend on
/// `threads`. Errors: kCancelled. Ours.
Result<ReplayCheck> check_by_replay(const map::TopologicalMap& before, const map::TopologicalMap& after,
                                    const std::vector<KeptPicture>& pictures, int threads,
                                    const std::function<void(double)>& progress = {}, const std::stop_token& stop = {});

/// The same with the pictures of tours, which are looked at first, and the sights of drives at places that are still
/// there. Pictures that cannot be read are left out. Errors: also those of eye_for and look_at_tours.
Result<ReplayCheck> check_by_replay(const map::TopologicalMap& before, const map::TopologicalMap& after,
                                    const std::vector<const TourSource*>& tours,
                                    const std::vector<std::vector<DriveSight>>& drives, int threads,
                                    const ProgressSink& progress = {}, const std::stop_token& stop = {});

}  // namespace homeward::pipeline
