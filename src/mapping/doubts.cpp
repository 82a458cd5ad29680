// SPDX-License-Identifier: Apache-2.0
#include "mapping/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <tuple>
#include <utility>

#include "core/index.hpp"
#include "map/lookup.hpp"
#include "mapping/dempster_shafer.hpp"
#include "mapping/doubt_kinds.hpp"
#include "mapping/doubt_scene.hpp"
#include "mapping/hypotheses.hpp"

namespace homeward::mapping {
namespace {

using map::Doubt;

/// Hypotheses by where their pictures lie along the tours.
class NearHypotheses {
 public:
  explicit NearHypotheses(const DoubtScene& scene) : scene_(scene) {
    const map::TopologicalMap& map = scene.map();
    std::vector<double> along;  // pictures, tours far apart
    double gap = 0.0;
    for (std::size_t i = 0; i < map.images.size(); ++i) {
      const bool begins = i > 0 && map::tour_name(map.images[i].id) != map::tour_name(map.images[i - 1].id);
      if (begins) gap += 10.0 * reach_;
      along.push_back(static_cast<double>(i) + gap);
    }
    for (std::size_t h = 0; h < map.hypotheses.size(); ++h) {
      const int a = scene.number_of(map.hypotheses[h].prototype_a);
      const int b = scene.number_of(map.hypotheses[h].prototype_b);
      if (a >= 0 && b >= 0) spots_.push_back({along[at(std::min(a, b))], along[at(std::max(a, b))], h});
    }
    std::ranges::sort(spots_, {}, [](const Spot& spot) { return std::tie(spot.a, spot.b, spot.hypothesis); });
  }

  [[nodiscard]] std::vector<map::DoubtNeighbour> of(std::size_t hypothesis, int most) const {
    const auto own = std::ranges::find(spots_, hypothesis, &Spot::hypothesis);
    std::vector<map::DoubtNeighbour> near;
    if (own == spots_.end()) return near;
    auto other = std::ranges::lower_bound(spots_, own->a - reach_, {}, &Spot::a);
    for (; other != spots_.end() && other->a <= own->a + reach_; ++other) {
      const map::Hypothesis& one = scene_.map().hypotheses[other->hypothesis];
      const double weight = neighbour_weight(std::abs(other->a - own->a) + std::abs(other->b - own->b), reach_);
      // One that the way driven excludes says nothing to others, nor one that a person made.
      if (other == own || !(weight > 0.0) || one.masses_before.is_false >= kExcluded) continue;
      if (one.by == map::Decider::kPerson && one.masses_before.unknown >= 1.0) continue;
      const int a = scene_.place_of(one.prototype_a);
      const int b = scene_.place_of(one.prototype_b);
      if (a < 0 || b < 0) continue;
      near.push_back({scene_.place(a).id, scene_.place(b).id, one.similarity >= 0.5, weight});
    }
    std::ranges::stable_sort(near, std::greater<>(), &map::DoubtNeighbour::weight);
    near.resize(std::min(near.size(), at(most)));
    return near;
  }

 private:
  struct Spot {
    double a = 0.0;
    double b = 0.0;
    std::size_t hypothesis = 0;
  };
  static constexpr double kExcluded = 0.98;

  const DoubtScene& scene_;
  double reach_ = HypothesisConfig{}.neighbour_threshold_images;
  std::vector<Spot> spots_;
};

/// What a person decided last, before that what somebody was not sure of, then by weight.
void order(std::vector<Doubt>& doubts) {
  const auto turn = [](const Doubt& doubt) {
    if (doubt.by == map::Decider::kPerson) return 2;
    return doubt.set_aside_by.empty() ? 0 : 1;
  };
  std::ranges::stable_sort(doubts, [&](const Doubt& x, const Doubt& y) {
    return std::pair(turn(x), -x.weight()) < std::pair(turn(y), -y.weight());
  });
}

}  // namespace

Result<std::vector<Doubt>> doubts_of(const map::TopologicalMap& map, const DoubtConfig& config, int threads,
                                     const std::stop_token& stop) {
  const DoubtScene scene(map);
  std::vector<Doubt> doubts = mixed_place_doubts(scene, config);
  std::vector<double> mixed(map.places.size(), 0.0);
  for (const Doubt& doubt : doubts) {
    const int place = scene.place_of(doubt.image_a);
    if (doubt.by == map::Decider::kMethod) mixed[at(place)] = std::max(mixed[at(place)], doubt.probability);
  }
  std::ranges::move(way_doubts(scene, config, mixed), std::back_inserter(doubts));
  auto same = same_place_doubts(scene, config, threads, stop);
  if (!same) return pass_on(same);
  std::ranges::move(*same, std::back_inserter(doubts));
  const NearHypotheses near(scene);
  for (Doubt& doubt : doubts) {
    if (doubt.by == map::Decider::kMethod) {
      doubt.set_aside_by = scene.set_aside_by(doubt.kind, scene.place_of(doubt.image_a), scene.place_of(doubt.image_b));
    }
    if (doubt.hypothesis) doubt.neighbours = near.of(*doubt.hypothesis, config.most_neighbours);
  }
  std::erase_if(doubts, [&](const Doubt& doubt) {
    return doubt.by == map::Decider::kMethod && doubt.probability < config.least_probability;
  });
  order(doubts);
  return doubts;
}

}  // namespace homeward::mapping
