// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>

#include "core/result.hpp"
#include "core/time.hpp"
#include "db/store_records.hpp"
#include "pipeline/build_map.hpp"
#include "server/work/stored_tours.hpp"

namespace homeward::server {

/// What a build leaves beside its map: the acceptance report, dated `now_us`, and how alike all pictures are. A report
/// that cannot be drawn is logged and empty, whatever the reason: the map is what was asked for. Errors: kCancelled.
Result<db::MapBuild> build_record(const pipeline::BuiltMap& built, const StoredTours& tours,
                                  const pipeline::BuildOptions& options, TimeUs now_us, const std::stop_token& stop);

}  // namespace homeward::server
