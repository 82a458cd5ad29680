// SPDX-License-Identifier: Apache-2.0
#include "mapping/loops.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mapping/dempster_shafer.hpp"

namespace homeward::mapping {
namespace {

constexpr double kToursApartImages = 1e6;  // so far apart along the way are images of different tours

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// D, but infinite between two images that carry different marks (each stands for a place of its own) and between two
/// that the way driven keeps apart. Valid as long as its parameters are.
DistanceFunction clustering_distance(const MappingInput& input, const std::vector<const std::string*>& labels,
                                     const TourTrack& track) {
  return [&input, &labels, &track](int a, int b) {
    const bool marks_differ = labels[at(a)] != nullptr && labels[at(b)] != nullptr && *labels[at(a)] != *labels[at(b)];
    const float distance = input.pairs->distance(a, b);
    const bool apart =
        marks_differ || (std::isfinite(distance) && track.judge(a, b).verdict == TrackVerdict::kContradicts);
    return apart ? std::numeric_limits<float>::infinity() : distance;
  };
}

/// What images have to say to each other, by `distance`.
NearLists near_lists(const PairTable& pairs, const DistanceFunction& distance) {
  NearLists near(at(pairs.images()));
  for (int a = 0; a < pairs.images(); ++a) {
    for (const int b : pairs.partners(a)) near[at(a)].push_back({b, distance(std::min(a, b), std::max(a, b))});
  }
  return near;
}

/// Pairs of subclusters in different clusters that look like one place. Clusters are cut somewhere, and two passes are
/// not cut at the same spots: of those beside each other on one pass, the one most like the other counts. And what
/// looks alike but is excluded by the way driven: a person sees what it is and why it stays apart.
void add_across_clusters(std::vector<LoopHypothesis>& hypotheses, std::span<const Subcluster> subclusters,
                         const MappingInput& input, const TourTrack& track, float threshold,
                         const SimilarityFunction& similarity, const HypothesisConfig& config) {
  std::vector<int> represented(input.images.size(), -1);  // the subcluster that an image is the prototype of
  for (std::size_t s = 0; s < subclusters.size(); ++s) represented[at(subclusters[s].prototype)] = static_cast<int>(s);
  const int count = static_cast<int>(subclusters.size());
  const auto far = [&](int a, int b) {
    return input.pairs->distance(subclusters[at(a)].prototype, subclusters[at(b)].prototype);
  };
  /// Whether b is no less like a than those before and after it on the tour.
  const auto most_like = [&](int a, int b) {
    return (b == 0 || b - 1 == a || far(a, b) <= far(a, b - 1)) &&
           (b + 1 == count || b + 1 == a || far(a, b) <= far(a, b + 1));
  };
  for (int a = 0; a < count; ++a) {
    const int image_a = subclusters[at(a)].prototype;
    for (const int image_b : input.pairs->partners(image_a)) {
      const int b = represented[at(image_b)];
      if (b <= a || subclusters[at(a)].cluster == subclusters[at(b)].cluster || far(a, b) > threshold) continue;
      const bool excluded = track.judge(image_a, image_b).verdict == TrackVerdict::kContradicts;
      // The next one on the way is another place because clustering said so.
      if (!excluded && (b == a + 1 || !(most_like(a, b) || most_like(b, a)))) continue;
      LoopHypothesis hypothesis;
      hypothesis.a = a;
      hypothesis.b = b;
      hypothesis.across = true;
      hypothesis.similarity = similarity(a, b);
      hypothesis.before = hypothesis.after = evidence(hypothesis.similarity, config.own_weight);
      hypotheses.push_back(hypothesis);
    }
  }
  std::ranges::stable_sort(hypotheses, {}, [](const LoopHypothesis& h) { return std::pair(h.a, h.b); });
}

std::vector<double> positions_of_evidence(const MappingInput& input) {
  std::vector<double> positions;
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    positions.push_back(static_cast<double>(i) + kToursApartImages * input.tour_of[i]);
  }
  return positions;
}

/// A person's decisions on hypotheses, keyed to images, hold for the pair of subclusters that hold these images.
void apply_decisions(std::vector<LoopHypothesis>& hypotheses, std::span<const Subcluster> subclusters,
                     const MappingInput& input, const map::TopologicalMap* previous) {
  if (previous == nullptr) return;
  const auto holds = [&](int subcluster, const ImageId& id) {
    return std::ranges::any_of(subclusters[at(subcluster)].images,
                               [&](int image) { return input.images[at(image)].id == id; });
  };
  for (const map::Edit& edit : previous->edits) {
    if (edit.kind != map::EditKind::kDecide || edit.undone) continue;
    for (LoopHypothesis& hypothesis : hypotheses) {
      const bool concerned = (holds(hypothesis.a, edit.image_a) && holds(hypothesis.b, edit.image_b)) ||
                             (holds(hypothesis.a, edit.image_b) && holds(hypothesis.b, edit.image_a));
      if (!concerned) continue;
      hypothesis.decision = edit.text == "accept" ? map::Decision::kAccepted : map::Decision::kRejected;
      hypothesis.by = "person";
    }
  }
}

/// Learnt between tour neighbours, whose distance the way driven knows well: up to one place extent is one place, from
/// 1.5 to 3 is beside it.
SamePlaceScale same_place_scale(const MappingInput& input, const TourTrack& track, double extent) {
  constexpr int kNeighbours = 12;
  constexpr double kBesideFrom = 1.5;
  constexpr double kBesideTo = 3.0;
  std::vector<float> same;
  std::vector<float> beside;
  for (int i = 0; i < static_cast<int>(input.images.size()); ++i) {
    for (int j = i + 1; j <= i + kNeighbours && j < static_cast<int>(input.images.size()); ++j) {
      if (input.tour_of[at(i)] != input.tour_of[at(j)]) break;
      const TrackPrediction way = track.predict(i, j);
      if (!way.known) break;
      const float distance = input.pairs->distance(i, j);
      if (way.distance <= extent * (1.0 + 1e-9)) same.push_back(distance);
      if (way.distance >= kBesideFrom * extent && way.distance <= kBesideTo * extent) beside.push_back(distance);
    }
  }
  return {std::move(same), std::move(beside)};
}

}  // namespace

ClosedLoops close_loops(const MappingInput& input, const MappingConfig& config, const TourTrack& track,
                        const std::vector<const std::string*>& labels, float threshold,
                        const map::TopologicalMap* previous) {
  const DistanceFunction distance = clustering_distance(input, labels, track);
  const SamePlaceScale scale = same_place_scale(input, track, track.place_extent());
  ClosedLoops result;
  result.cluster_of = complete_linkage(near_lists(*input.pairs, distance), threshold);
  std::vector<int> marked;
  for (const MarkedImage& mark : input.marks) marked.push_back(mark.image);
  result.parts = subclusters(result.cluster_of, input.tour_of, marked, distance);
  const std::vector<Subcluster>& parts = result.parts;
  const auto similarity = [&](int a, int b) {
    return scale.similarity(input.pairs->distance(parts[at(a)].prototype, parts[at(b)].prototype));
  };
  std::vector<LoopHypothesis>& hypotheses = result.hypotheses;
  hypotheses = formulate_hypotheses(parts, similarity, config.hypotheses);
  add_across_clusters(hypotheses, parts, input, track, threshold, similarity, config.hypotheses);
  const auto way = [&](int a, int b) { return track.judge(parts[at(a)].prototype, parts[at(b)].prototype); };
  weigh_way(hypotheses, way, config.hypotheses);
  apply_decisions(hypotheses, parts, input, previous);
  collect_evidence(hypotheses, parts, positions_of_evidence(input), config.hypotheses);
  // What one place may not hold, whatever speaks for it: two marks, two stretches that follow each other on the tour,
  // images that look too different to be one place.
  const float widest = config.widest_place * threshold;
  const auto apart = [&](int a, int b) {
    const std::string* label_a = labels[at(parts[at(a)].prototype)];
    const std::string* label_b = labels[at(parts[at(b)].prototype)];
    if (label_a != nullptr && label_b != nullptr && *label_a != *label_b) return true;
    if (parts[at(a)].cluster == parts[at(b)].cluster) return false;
    const int last = parts[at(std::min(a, b))].images.back();
    if (std::abs(a - b) == 1 && input.tour_of[at(last)] == input.tour_of[at(last + 1)]) return true;
    return std::ranges::any_of(parts[at(a)].images, [&](int x) {
      return std::ranges::any_of(parts[at(b)].images, [&](int y) { return distance(x, y) > widest; });
    });
  };
  result.place_of_part = merge_accepted(static_cast<int>(parts.size()), hypotheses, apart);
  return result;
}

}  // namespace homeward::mapping
