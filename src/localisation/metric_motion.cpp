// SPDX-License-Identifier: Apache-2.0
#include "localisation/metric_motion.hpp"

#include <algorithm>
#include <cmath>
#include <queue>

#include "core/index.hpp"

namespace homeward::localisation {
namespace {

constexpr double kMetresPerImage = 0.4;  // where a tour counts but pictures: the builder holds 3 of them for 1.2 m
constexpr double kDriveSigma = 0.1;      // of odometry, and of driving beside the tour's line, as a share of the way
constexpr double kShortCutSigma = 0.25;  // of a way that is longer than the drive: a robot need not go round
// Of a difference between two places, in squares of their extents along the ways. Were robots anywhere within them
// alike, it would be 1/12; walks through rendered buildings give 1/4 to 1/9, for places are of uneven size, and drives
// beside them.
constexpr double kPlaceVariance = 1.0 / 6.0;
constexpr double kUsualExtent_m = 1.2;  // of a place without ways
constexpr double kLeastExtent_m = 0.3;
constexpr double kSureSigmas = 3.0;  // a drive that misses every way by more has none on the map
constexpr double kLongest_m = 20.0;
constexpr std::size_t kMostReached = 256;

/// Standard deviation of an edge's length, as a share of it.
double length_sigma(map::LengthSource from) {
  switch (from) {
    case map::LengthSource::kOdometry:
      return 0.1;
    case map::LengthSource::kTourTime:
    case map::LengthSource::kTourImages:
      return 0.5;  // people guide a chair at 0.25 to 1 m/s and take a picture every 0.2 to 0.8 m
    case map::LengthSource::kUnknown:
      break;
  }
  return 1.0;
}

double length_m(const map::Edge& edge) {
  return edge.length_from == map::LengthSource::kTourImages ? edge.length_m * kMetresPerImage : edge.length_m;
}

double squared(double x) { return x * x; }

}  // namespace

double MetricMotion::longest_m() { return kLongest_m; }

MetricMotion::MetricMotion(const map::TopologicalMap& map, const map::PlaceGraph& graph) : ways_(at(graph.size())) {
  for (int from = 0; from < graph.size(); ++from) {
    double sum_m = 0.0;
    for (const map::Arc& arc : graph.arcs_from(from)) {
      const map::Edge& edge = map.edges[at(arc.edge)];
      const double length = std::max(0.0, length_m(edge));
      ways_[at(from)].push_back({arc.to, length, length_sigma(edge.length_from) * length});
      sum_m += length;
    }
    // Places lie beside each other along the ways: each begins where the way to the next is half over.
    const double mean_m =
        ways_[at(from)].empty() ? kUsualExtent_m : sum_m / static_cast<double>(ways_[at(from)].size());
    extent_m_.push_back(std::max(kLeastExtent_m, mean_m));
  }
}

std::vector<PlaceShare> MetricMotion::likely_from(int from, double driven_m) const {
  struct Reached {
    int place = 0;
    double length_m = 0.0;
    double sigma_m = 0.0;
  };
  if (driven_m <= 0.0) return {{from, extent_m_[at(from)]}};
  const auto later = [](const Reached& a, const Reached& b) {
    return a.length_m != b.length_m ? a.length_m > b.length_m : a.place > b.place;
  };
  // Dijkstra's search, which ends where ways are too long. The uncertainties of a way's edges add up: a map whose
  // lengths are wrong is wrong in all of them.
  std::priority_queue<Reached, std::vector<Reached>, decltype(later)> open(later);
  std::vector<PlaceShare> likely;
  open.push({from, 0.0, 0.0});
  while (!open.empty() && likely.size() < kMostReached) {
    const Reached here = open.top();
    open.pop();
    if (std::ranges::find(likely, here.place, &PlaceShare::place) != likely.end()) continue;
    const double places = kPlaceVariance * (squared(extent_m_[at(from)]) + squared(extent_m_[at(here.place)]));
    // Of a length that may be wrong by a factor, the logarithm is as far off on both sides: near it, that is a share of
    // the geometric mean.
    const double share = here.length_m > 0.0 ? here.sigma_m / here.length_m : 0.0;
    const double cut = here.length_m > driven_m ? kShortCutSigma * here.length_m : 0.0;
    const double variance =
        places + squared(kDriveSigma * driven_m) + squared(share) * here.length_m * driven_m + squared(cut);
    const double off = squared(here.length_m - driven_m) / variance;
    // A large place is met more often than a small one.
    likely.push_back({here.place, extent_m_[at(here.place)] * std::exp(-0.5 * off)});
    if (here.length_m > driven_m && off > squared(kSureSigmas)) continue;
    for (const Way& way : ways_[at(here.place)]) {
      open.push({way.to, here.length_m + way.length_m, here.sigma_m + way.sigma_m});
    }
  }
  return likely;
}

DrivenBelief MetricMotion::predict(std::span<const PlaceShare> belief, double driven_m) const {
  DrivenBelief predicted;
  std::vector<PlaceShare> moved;
  for (const PlaceShare& from : belief) {
    const std::vector<PlaceShare> likely = likely_from(from.place, driven_m);
    const double no_way = extent_m_[at(from.place)] * std::exp(-0.5 * squared(kSureSigmas));
    double sum = no_way;
    for (const PlaceShare& to : likely) sum += to.probability;
    for (const PlaceShare& to : likely) moved.push_back({to.place, from.probability * to.probability / sum});
    predicted.unexplained += from.probability * no_way / sum;
  }
  std::ranges::stable_sort(moved, {}, &PlaceShare::place);
  for (const PlaceShare& share : moved) {
    if (predicted.shares.empty() || predicted.shares.back().place != share.place) {
      predicted.shares.push_back(share);
    } else {
      predicted.shares.back().probability += share.probability;
    }
  }
  return predicted;
}

}  // namespace homeward::localisation
