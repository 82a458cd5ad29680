// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/result.hpp"
#include "core/tour.hpp"
#include "pipeline/build_map.hpp"
#include "pipeline/report/report_options.hpp"

namespace homeward::pipeline {

inline constexpr int kMostLines = 70;  // between two views; more would hide them

/// Two views that may be one place, for a page.
struct HypothesisPicture {
  std::string uri;  // JPEG: one view above the other, lines between what agrees
  int matches = 0;  // that look alike
  int agree = 0;    // of these, that one motion explains
};

/// Pictures of the hypotheses with these indices, by index. Errors: kCancelled, those of TourSource::read and Eye.
Result<std::unordered_map<int, HypothesisPicture>> draw_hypotheses(const BuiltMap& built,
                                                                   const std::vector<const TourSource*>& tours,
                                                                   const std::vector<int>& wanted,
                                                                   const ReportOptions& options,
                                                                   const std::stop_token& stop = {});

}  // namespace homeward::pipeline
