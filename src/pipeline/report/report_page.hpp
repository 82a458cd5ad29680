// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "core/tour.hpp"
#include "pipeline/build_map.hpp"
#include "pipeline/report/report_options.hpp"

namespace homeward::pipeline {

/// One page of HTML about a map and how it came about, for people to read and print: complete in itself, without
/// scripts, well-formed as XML too. `tours`: those that the map was built of; pictures of hypotheses are taken from
/// them. Same map, same page. Errors: kCancelled, those of TourSource::read, naming the picture.
Result<std::string> report_page(const BuiltMap& built, const std::vector<const TourSource*>& tours,
                                const ReportOptions& options, const std::stop_token& stop = {});

}  // namespace homeward::pipeline
