// SPDX-License-Identifier: Apache-2.0
#include "mapping/dempster_shafer.hpp"

#include <cmath>

#include "core/angles.hpp"

namespace homeward::mapping {

map::Masses combine(const map::Masses& a, const map::Masses& b) {
  const double conflict = a.is_true * b.is_false + a.is_false * b.is_true;
  const double agreed = 1.0 - conflict;
  if (!(agreed > 1e-12)) return {};
  map::Masses combined;
  combined.is_true = (a.is_true * b.is_true + a.is_true * b.unknown + a.unknown * b.is_true) / agreed;
  combined.is_false = (a.is_false * b.is_false + a.is_false * b.unknown + a.unknown * b.is_false) / agreed;
  combined.unknown = a.unknown * b.unknown / agreed;
  return combined;
}

double neighbour_weight(double hypothesis_distance, double threshold) {
  if (hypothesis_distance > threshold) return 0.0;
  return 1.0 - std::sin(hypothesis_distance * kPi / (2.0 * threshold));
}

map::Masses evidence(double similarity, double weight) {
  return {similarity * weight, (1.0 - similarity) * weight, 1.0 - weight};
}

}  // namespace homeward::mapping
