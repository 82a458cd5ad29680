// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/time.hpp"
#include "db/store_records.hpp"
#include "pipeline/build_map.hpp"
#include "server/work/stored_tours.hpp"

namespace homeward::server {

/// What a build leaves beside its map: the acceptance report, dated `now_us`, and how alike all pictures are. A report
/// that cannot be drawn is logged and empty.
db::MapBuild build_record(const pipeline::BuiltMap& built, const StoredTours& tours,
                          const pipeline::BuildOptions& options, TimeUs now_us);

}  // namespace homeward::server
