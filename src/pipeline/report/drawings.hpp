// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "pipeline/report/facts.hpp"

namespace homeward::pipeline {

/// The places and the ways between them, as SVG.
std::string draw_graph(const map::TopologicalMap& map, const ReportFacts& facts);

/// The tours from their first picture to their last: arcs for hypotheses, clusters, places and weak stretches, as SVG.
std::string draw_strip(const BuiltMap& built, const ReportFacts& facts);

/// The least of 1, 2, 5, 10, 20 and so on that covers the range in at most so many steps.
int round_step(int range, int most_steps);

/// How alike all pictures are (above the diagonal) and which of them make one place (below), a PNG within SVG.
std::string draw_matrix(const BuiltMap& built);

/// One bar of three lengths: for, unknown, against.
std::string draw_masses(const map::Masses& masses, const std::string& words);

/// How many places were visited how often: bars, as SVG.
std::string draw_visits(const ReportFacts& facts);

}  // namespace homeward::pipeline
