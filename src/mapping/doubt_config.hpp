// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace homeward::mapping {

struct DoubtConfig {
  int look_alikes = 4;          // of each place, the places most like it as a whole that are looked at closely
  int most_compared = 1500;     // pairs of places whose features are compared, those most like each other
  int most_neighbours = 6;      // hypotheses near one that are named
  double usual_detour_m = 5.0;  // a decision that makes ways change by so much has half of the greatest effect
  double least_effect = 0.05;   // of a decision that changes no way: it still keeps together what is known of a place
  double least_probability = 0.02;  // below, nothing is asked
};

}  // namespace homeward::mapping
