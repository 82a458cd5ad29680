// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/topological_map.hpp"

namespace homeward::mapping {

/// Dempster's rule of combination over {true, false, unknown} (Goedemé 2006, eq. 2). Total conflict, where the rule has
/// no answer, gives complete ignorance.
map::Masses combine(const map::Masses& a, const map::Masses& b);

/// Lower bound of the probability of being true (eq. 3).
inline double support(const map::Masses& masses) { return masses.is_true; }

/// Upper bound of the probability of being true (eq. 3).
inline double plausibility(const map::Masses& masses) { return masses.is_true + masses.unknown; }

/// How much a hypothesis `hypothesis_distance` tour images away says: 1 at 0, falling to 0 at `threshold` (eq. 5).
double neighbour_weight(double hypothesis_distance, double threshold);

/// Masses of evidence with this similarity in [0,1], of which `weight` in [0,1] counts (eq. 7).
map::Masses evidence(double similarity, double weight);

}  // namespace homeward::mapping
