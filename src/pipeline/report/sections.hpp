// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>

#include "pipeline/report/facts.hpp"
#include "pipeline/report/hypothesis_pictures.hpp"

namespace homeward::pipeline {

// Sections of a report, as HTML. Each stands also where it has nothing to tell, and says so.

std::string loops_section(const BuiltMap& built, const ReportFacts& facts,
                          const std::unordered_map<int, HypothesisPicture>& pictures);
std::string look_alikes_section(const BuiltMap& built, const ReportFacts& facts);
std::string weak_section(const BuiltMap& built, const ReportFacts& facts);
std::string coverage_section(const BuiltMap& built, const ReportFacts& facts);
std::string skipped_section(const BuiltMap& built);

/// "accepted", "rejected", "undecided".
const char* decision_name(map::Decision decision);

/// "12.4 m", or "31 steps" where nothing told metres.
std::string length_text(double length, const ReportFacts& facts);

}  // namespace homeward::pipeline
