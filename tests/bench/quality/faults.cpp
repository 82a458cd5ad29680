// SPDX-License-Identifier: Apache-2.0
// Breaks a map on purpose, as if the builder had erred: places wrongly merged, loops missed, ways that do not exist.
// The faults go to a JSON file. Which ones: chance by --seed, held against the tour's true poses.
#include <CLI/CLI.hpp>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <set>

#include "db/map_file.hpp"
#include "files/tour_folder.hpp"
#include "map/lookup.hpp"
#include "mapping/compare_all.hpp"
#include "mapping/edit_log.hpp"
#include "mapping/parallel.hpp"
#include "truth.hpp"
#include "wire/json_write.hpp"

namespace homeward {
namespace {

namespace fs = std::filesystem;
using map::Decision;
using nlohmann::json;

constexpr double kSame_m = 1.0;  // as map.py counts revisits
constexpr double kFar_m = 4.0;   // and wrong merges

struct Options {
  fs::path map, tour, out, faults;
  int merges = 5;
  int loops = 5;
  int ways = 3;
  std::uint64_t seed = 1;
  bool alike = false;
};

class Breaker {
 public:
  Breaker(const Options& options, map::TopologicalMap map)
      : options_(options),
        map_(std::move(map)),
        tour_(or_die(files::TourFolder::open(options.tour))),
        eye_(or_die(pipeline::Eye::create(map_.camera, map_.feature_config))),
        poses_(read_poses(options.tour / "poses.csv")),
        random_(options.seed) {
    for (const map::Hypothesis& one : map_.hypotheses) {
      const bool open = one.decision == Decision::kUndecided;
      (one.decision == Decision::kAccepted ? accepted_ : (open ? open_ : rejected_)).push_back(one);
    }
    lengths_ = map_.edges;
  }

  void merge_places() {
    std::vector<std::pair<double, std::pair<ImageId, ImageId>>> pairs = far_pairs(kFar_m + 0.5);
    if (options_.alike) keep_alike(pairs);
    for (int done = 0; done < options_.merges && !pairs.empty();) {
      auto [a, b] = drawn(pairs).second;
      if (used_.contains(place(a)) || used_.contains(place(b)) || map::find_edge(map_, place(a), place(b))) continue;
      if (random_() % 2 == 0) std::swap(a, b);
      json fault = {{"kind", "mixed_place"}, {"images_a", members(a)}, {"images_b", members(b)}};
      use(place(a));
      use(place(b));
      apply(map::EditKind::kMerge, a, b);
      map::find_place_of(map_, a)->appearances.resize(1);
      map::Hypothesis& loop = between(a, b);
      take_evidence(loop, accepted_);
      loop.decision = Decision::kAccepted;
      faults_.push_back(std::move(fault));
      ++done;
    }
  }

  void miss_loops() {
    std::vector<std::vector<ImageId>> visits = true_revisits();
    for (int done = 0; done < options_.loops && !visits.empty();) {
      const std::vector<ImageId> visit = drawn(visits);
      const map::Place before = *map::find_place_of(map_, visit.front());
      if (used_.contains(before.id)) continue;
      used_.insert(before.id);
      apply(map::EditKind::kSplit, before.prototype, {}, visit);
      const int how = static_cast<int>(random_() % 3);
      keep_apart(before.prototype, visit.front(), how);
      faults_.push_back({{"kind", "same_place"},
                         {"images_a", members(before.prototype)},
                         {"images_b", members(visit.front())},
                         {"hypothesis", how == 0 ? "undecided" : (how == 1 ? "rejected" : "none")}});
      ++done;
    }
  }

  void add_ways() {
    auto pairs = far_pairs(1.5 * kFar_m + 0.5);
    for (int done = 0; done < options_.ways && !pairs.empty();) {
      const auto [a, b] = drawn(pairs).second;
      if (used_.contains(place(a)) || used_.contains(place(b)) || map::find_edge(map_, place(a), place(b))) continue;
      const std::size_t first = map_.edges.size();
      apply(map::EditKind::kAddEdge, a, b);
      const map::Edge like = lengths_[random_() % lengths_.size()];
      for (std::size_t e = first; e < map_.edges.size(); ++e) {
        map_.edges[e].length_m = like.length_m;
        map_.edges[e].length_from = like.length_from;
        // Every other one looks as if both ends saw each other.
        if (done % 2 == 0) continue;
        map_.edges[e].bearing_rad = like.bearing_rad;
        map_.edges[e].turn_rad = like.turn_rad;
        map_.edges[e].confidence = like.confidence;
        map_.edges[e].inliers = like.inliers;
        map_.edges[e].weak = like.weak;
      }
      faults_.push_back({{"kind", "way"}, {"images_a", members(a)}, {"images_b", members(b)}});
      ++done;
    }
  }

  void save(const db::Thumbnails& thumbnails) {
    map_.edits.clear();
    map_.unedited = nullptr;
    map_.settled_edits = 0;
    map_.revision = 1;
    for (map::Edge& edge : map_.edges) edge.by = map::Decider::kMethod;
    for (map::Hypothesis& one : map_.hypotheses) one.by = map::Decider::kMethod;
    or_die(Result<int>(db::save_map(options_.out, map_, thumbnails).map([] { return 0; })));
    std::ofstream(options_.faults) << json{{"faults", faults_}}.dump(1) << "\n";
  }

 private:
  [[nodiscard]] const Pose& pose(const ImageId& image) const {
    return poses_.at(image.str().substr(image.str().rfind('/') + 1));
  }
  [[nodiscard]] const PlaceId& place(const ImageId& image) const { return map::find_place_of(map_, image)->id; }
  [[nodiscard]] json members(const ImageId& image) const {
    return wire::ids_to_json(map::find_place_of(map_, image)->members);
  }

  /// The place and those beside it are not broken again, so that each fault is one.
  void use(const PlaceId& id) {
    used_.insert(id);
    for (const map::Edge& edge : map_.edges) {
      if (edge.from == id) used_.insert(edge.to);
    }
  }

  template <typename T>
  T drawn(std::vector<T>& from) {
    const std::size_t chosen = random_() % from.size();
    std::swap(from[chosen], from.back());
    T one = std::move(from.back());
    from.pop_back();
    return one;
  }

  [[nodiscard]] std::vector<std::pair<double, std::pair<ImageId, ImageId>>> far_pairs(double least_m) const {
    std::vector<std::pair<double, std::pair<ImageId, ImageId>>> pairs;
    for (const map::Place& a : map_.places) {
      for (const map::Place& b : map_.places) {
        if (a.id < b.id && distance_m(pose(a.prototype), pose(b.prototype)) > least_m) {
          pairs.push_back({0.0, {a.prototype, b.prototype}});
        }
      }
    }
    return pairs;
  }

  /// The tenth of the pairs whose prototypes have most in common.
  void keep_alike(std::vector<std::pair<double, std::pair<ImageId, ImageId>>>& pairs) const {
    mapping::parallel_for(pairs.size(), 0,
                          [&](std::size_t i) {
                            const map::Place* a = map::find_place_of(map_, pairs[i].second.first);
                            const map::Place* b = map::find_place_of(map_, pairs[i].second.second);
                            pairs[i].first =
                                -mapping::relate(a->appearances.front(), b->appearances.front(), {}, 1).match_share;
                          },
                          {}, {});
    std::ranges::sort(pairs);
    pairs.resize(std::max<std::size_t>(1, pairs.size() / 10));
  }

  /// Visits to a place whose prototype another visit gave, taken where it was.
  [[nodiscard]] std::vector<std::vector<ImageId>> true_revisits() const {
    std::vector<std::vector<ImageId>> visits;
    for (const map::Place& place : map_.places) {
      const std::set<ImageId> own(place.members.begin(), place.members.end());
      std::vector<std::vector<ImageId>> of_place;
      bool goes_on = false;
      for (const map::MapImage& image : map_.images) {
        const bool here = own.contains(image.id);
        if (here && !goes_on) of_place.emplace_back();
        if (here) of_place.back().push_back(image.id);
        goes_on = here;
      }
      for (const auto& visit : of_place) {
        const ImageId& middle = visit[visit.size() / 2];
        const bool holds_prototype = std::ranges::find(visit, place.prototype) != visit.end();
        const bool same = distance_m(pose(middle), pose(place.prototype)) < kSame_m;
        if (!holds_prototype && same) visits.push_back(visit);
      }
    }
    return visits;
  }

  void apply(map::EditKind kind, const ImageId& a, const ImageId& b, std::vector<ImageId> images = {}) {
    map::Edit edit;
    edit.kind = kind;
    edit.image_a = a;
    edit.image_b = b;
    edit.images = std::move(images);
    const auto look = [&](const ImageId& image) -> Result<features::Appearance> {
      for (std::size_t i = 0; i < tour_.images().size(); ++i) {
        if (tour_.images()[i].id == image) return eye_.look(or_die(tour_.read(i)));
      }
      return fail(ErrorCode::kNotFound, "The tour does not have it.", image.str());
    };
    or_die(Result<int>(mapping::apply_edit(map_, edit, look).map([] { return 0; })));
  }

  map::Hypothesis& between(const ImageId& a, const ImageId& b) {
    for (map::Hypothesis& one : map_.hypotheses) {
      if (std::minmax(one.prototype_a, one.prototype_b) == std::minmax(a, b)) return one;
    }
    map::Hypothesis fresh;
    fresh.prototype_a = a;
    fresh.prototype_b = b;
    map_.hypotheses.push_back(fresh);
    return map_.hypotheses.back();
  }

  /// As one of the map's own had it.
  void take_evidence(map::Hypothesis& hypothesis, const std::vector<map::Hypothesis>& from) {
    if (from.empty()) return;
    const map::Hypothesis& like = from[random_() % from.size()];
    hypothesis.similarity = like.similarity;
    hypothesis.masses_before = like.masses_before;
    hypothesis.masses_after = like.masses_after;
    hypothesis.support = like.support;
    hypothesis.plausibility = like.plausibility;
  }

  /// What the map says of the two places: undecided, rejected, or nothing.
  void keep_apart(const ImageId& a, const ImageId& b, int how) {
    const auto joins = [&](const map::Hypothesis& one) {
      const map::Place* first = map::find_place_of(map_, one.prototype_a);
      const map::Place* second = map::find_place_of(map_, one.prototype_b);
      return first != nullptr && second != nullptr &&
             std::minmax(first->id, second->id) == std::minmax(place(a), place(b));
    };
    if (how == 2) {
      std::erase_if(map_.hypotheses, joins);
      return;
    }
    for (map::Hypothesis& one : map_.hypotheses) {
      if (!joins(one)) continue;
      take_evidence(one, how == 0 ? open_ : rejected_);
      one.decision = how == 0 ? Decision::kUndecided : Decision::kRejected;
    }
  }

  const Options& options_;
  map::TopologicalMap map_;
  files::TourFolder tour_;
  pipeline::Eye eye_;
  std::map<std::string, Pose> poses_;
  std::mt19937_64 random_;
  std::vector<map::Hypothesis> accepted_;  // of the sound map
  std::vector<map::Hypothesis> open_;
  std::vector<map::Hypothesis> rejected_;
  std::vector<map::Edge> lengths_;
  std::set<PlaceId> used_;
  json faults_ = json::array();
};

int run(const Options& options) {
  db::StoredMap stored = or_die(db::load_map(options.map));
  Breaker breaker(options, std::move(stored.map));
  breaker.merge_places();
  breaker.miss_loops();
  breaker.add_ways();
  breaker.save(stored.thumbnails);
  return 0;
}

}  // namespace
}  // namespace homeward

int main(int argc, char** argv) {
  homeward::Options options;
  CLI::App app("Breaks a map on purpose, as if the builder had erred");
  app.add_option("--map", options.map, "Sound map of the tour")->required();
  app.add_option("--tour", options.tour, "Folder of the tour, with true poses")->required();
  app.add_option("--out", options.out, "Map file to write")->required();
  app.add_option("--faults", options.faults, "JSON file to write: what is wrong")->required();
  app.add_option("--merges", options.merges, "Places wrongly merged")->capture_default_str();
  app.add_option("--loops", options.loops, "Loops missed")->capture_default_str();
  app.add_option("--ways", options.ways, "Ways that do not exist")->capture_default_str();
  app.add_option("--seed", options.seed, "Of chance")->capture_default_str();
  app.add_flag("--alike", options.alike, "Merge places that look most alike, not any two");
  CLI11_PARSE(app, argc, argv);
  try {
    return homeward::run(options);
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 2;
  }
}
