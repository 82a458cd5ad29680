// SPDX-License-Identifier: Apache-2.0
#include "mapping/loops.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "core/index.hpp"
#include "mapping/closed_loops.hpp"
#include "mapping/dempster_shafer.hpp"

namespace homeward::mapping {
namespace {

constexpr double kToursApartImages = 1e6;  // so far apart along the way are images of different tours

/// D, but infinite between two images that carry different marks (each stands for a place of its own), that have hardly
/// anything in common, or that the way driven keeps apart. Valid as long as its parameters are.
DistanceFunction clustering_distance(const MappingInput& input, const MappingConfig& config, const ImageLabels& labels,
                                     const TourTrack& track) {
  return [&input, &config, &labels, &track](int a, int b) {
    const bool marks_differ = labels[at(a)] != nullptr && labels[at(b)] != nullptr && *labels[at(a)] != *labels[at(b)];
    const PairRelation relation = a == b ? PairRelation{0.0F, 1, 1.0F} : input.pairs->relation(a, b);
    const float distance = relation.distance;
    const bool apart =
        marks_differ || relation.match_share < config.least_place_share ||
        (config.sources.way && std::isfinite(distance) && track.judge(a, b).verdict == TrackVerdict::kContradicts);
    return apart ? std::numeric_limits<float>::infinity() : distance;
  };
}

bool is_old(const OldPlaces* old, int image) { return old != nullptr && old->is_old(image); }

/// What images have to say to each other, by `distance`.
NearLists near_lists(const PairTable& pairs, const DistanceFunction& distance) {
  NearLists near(at(pairs.images()));
  for (int a = 0; a < pairs.images(); ++a) {
    for (const int b : pairs.partners(a)) near[at(a)].push_back({b, distance(std::min(a, b), std::max(a, b))});
  }
  return near;
}

/// Pairs of subclusters in different clusters that look like one place. Clusters are cut somewhere, and two passes are
/// not cut at the same spots: of those beside each other on one pass, the one most like the other counts; beside an
/// old place are those that its edges lead to. And what looks alike but is excluded by the way driven: a person sees
/// what it is and why it stays apart.
void add_across_clusters(std::vector<LoopHypothesis>& hypotheses, std::span<const Subcluster> subclusters,
                         const MappingInput& input, const TourTrack& track, float threshold,
                         const SimilarityFunction& similarity, const HypothesisConfig& config, const OldPlaces* old) {
  std::vector<int> represented(input.images.size(), -1);  // the subcluster that an image is the prototype of
  for (std::size_t s = 0; s < subclusters.size(); ++s) represented[at(subclusters[s].prototype)] = static_cast<int>(s);
  const int count = static_cast<int>(subclusters.size());
  const auto far = [&](int a, int b) {
    return input.pairs->distance(subclusters[at(a)].prototype, subclusters[at(b)].prototype);
  };
  const auto tour_of = [&](int s) { return input.tour_of[at(subclusters[at(s)].prototype)]; };
  std::vector<std::vector<int>> beside(subclusters.size());
  std::map<int, std::vector<int>> of_place;
  for (int s = 0; s < count; ++s) {
    if (is_old(old, subclusters[at(s)].prototype)) {
      of_place[old->place(subclusters[at(s)].prototype)].push_back(s);
      continue;
    }
    if (s > 0 && tour_of(s - 1) == tour_of(s)) beside[at(s)].push_back(s - 1);
    if (s + 1 < count && tour_of(s + 1) == tour_of(s)) beside[at(s)].push_back(s + 1);
  }
  for (const auto& [place, parts] : of_place) {
    for (const int neighbour : old->adjoining(place)) {
      const auto there = of_place.find(neighbour);
      if (there == of_place.end()) continue;
      for (const int part : parts)
        beside[at(part)].insert(beside[at(part)].end(), there->second.begin(), there->second.end());
    }
  }
  /// Whether b is no less like a than those beside it.
  const auto most_like = [&](int a, int b) {
    return std::ranges::all_of(beside[at(b)], [&](int other) { return other == a || far(a, b) <= far(a, other); });
  };
  for (int a = 0; a < count; ++a) {
    const int image_a = subclusters[at(a)].prototype;
    for (const int image_b : input.pairs->partners(image_a)) {
      const int b = represented[at(image_b)];
      if (b <= a || subclusters[at(a)].cluster == subclusters[at(b)].cluster || far(a, b) > threshold) continue;
      const bool excluded = track.judge(image_a, image_b).verdict == TrackVerdict::kContradicts;
      // The next one on the way is another place because clustering said so.
      if (!excluded && ((b == a + 1 && tour_of(a) == tour_of(b)) || !(most_like(a, b) || most_like(b, a)))) continue;
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

std::vector<double> positions_of_evidence(const MappingInput& input, const OldPlaces* old) {
  if (old != nullptr) return old->positions();
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
      hypothesis.by = map::Decider::kPerson;
    }
  }
}

/// Learnt between tour neighbours, whose distance the way driven knows well: up to one place extent is one place, from
/// 1.5 to 3 is beside it.
SamePlaceScale same_place_scale(const MappingInput& input, const TourTrack& track, bool ask_beside) {
  const double extent = track.place_extent();
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
      if (ask_beside && way.distance >= kBesideFrom * extent && way.distance <= kBesideTo * extent)
        beside.push_back(distance);
    }
  }
  return {std::move(same), std::move(beside)};
}

/// All that decides on hypotheses.
class Judgement {
 public:
  Judgement(const MappingInput& input, const MappingConfig& config, const TourTrack& track,
            std::span<const Subcluster> parts, const map::TopologicalMap* previous, const OldPlaces* old,
            std::function<bool(int, int)> apart)
      : input_(input),
        config_(config),
        track_(track),
        parts_(parts),
        previous_(previous),
        old_(old),
        apart_(std::move(apart)),
        positions_(positions_of_evidence(input, old)) {}

  /// Weighs, decides and merges; what closed loops then exclude is taken back, and what they tell is weighed in turn.
  std::vector<int> decide(std::vector<LoopHypothesis>& hypotheses) const;

 private:
  /// What speaks besides looks: the way, and of each hypothesis with an old place how far looks count for it.
  struct Witnesses {
    std::vector<WayEvidence> way;
    std::vector<OldPlaces::Trust> trust;
  };
  std::vector<int> decide_by(std::vector<LoopHypothesis>& hypotheses, const Witnesses& witnesses) const;
  /// What the way says once loops are closed; false if that is nothing new.
  bool reconsider(std::vector<LoopHypothesis>& hypotheses, Witnesses& witnesses) const;
  /// The same of hypotheses between old and new.
  bool reconsider_old(std::vector<LoopHypothesis>& hypotheses, Witnesses& witnesses, const ClosedWay* closed) const;
  /// Hypotheses between old and new that the way does not exclude, of `accepted` ones or of all.
  struct Claims {
    std::vector<std::size_t> hypothesis_of;
    std::vector<OldPlaces::Claim> claims;
  };
  [[nodiscard]] Claims claims(std::span<const LoopHypothesis> hypotheses, std::span<const WayEvidence> way,
                              bool accepted) const;
  void exclude(LoopHypothesis& hypothesis) const;
  [[nodiscard]] int prototype(int part) const { return parts_[at(part)].prototype; }

  const MappingInput& input_;
  const MappingConfig& config_;
  const TourTrack& track_;
  std::span<const Subcluster> parts_;
  const map::TopologicalMap* previous_;
  const OldPlaces* old_;
  std::function<bool(int, int)> apart_;
  std::vector<double> positions_;
};

std::vector<int> Judgement::decide_by(std::vector<LoopHypothesis>& hypotheses, const Witnesses& witnesses) const {
  std::vector<LoopHypothesis> taken_back;  // why loops were believed that are taken back
  for (LoopHypothesis& hypothesis : hypotheses) {
    if (hypothesis.taken_back) taken_back.push_back(hypothesis);
    hypothesis.before = hypothesis.after = evidence(hypothesis.similarity, config_.hypotheses.own_weight);
    hypothesis.reliability = 1.0;
  }
  std::map<std::pair<int, int>, WayEvidence> evidence_of;
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    evidence_of[{hypotheses[h].a, hypotheses[h].b}] = witnesses.way[h];
  }
  weigh_way(
      hypotheses,
      [&](int a, int b) {
        return evidence_of.at({a, b});
      },
      config_.hypotheses);
  for (std::size_t h = 0; h < witnesses.trust.size(); ++h) {
    LoopHypothesis& hypothesis = hypotheses[h];
    const OldPlaces::Trust& trust = witnesses.trust[h];
    if (trust == OldPlaces::Trust() || hypothesis.way.verdict == TrackVerdict::kContradicts) continue;
    hypothesis.reliability = (trust.borne_out ? 1.0 : hypothesis.reliability) * trust.factor;
    hypothesis.before = evidence(hypothesis.similarity, config_.hypotheses.own_weight * hypothesis.reliability);
  }
  apply_decisions(hypotheses, parts_, input_, previous_);
  HypothesisConfig asked = config_.hypotheses;
  if (!config_.sources.neighbours) asked.neighbour_threshold_images = 0.0;
  collect_evidence(hypotheses, parts_, positions_, asked);
  std::vector<int> place_of_part = merge_accepted(static_cast<int>(parts_.size()), hypotheses, apart_);
  auto next = taken_back.begin();
  for (LoopHypothesis& hypothesis : hypotheses) {
    if (!hypothesis.taken_back) continue;
    hypothesis.before = next->before;
    hypothesis.after = next->after;
    ++next;
  }
  return place_of_part;
}

void Judgement::exclude(LoopHypothesis& hypothesis) const {
  hypothesis.taken_back = true;
  // What excludes overrules, as it does from the beginning where the way alone knows enough.
  hypothesis.after = evidence(0.0, config_.hypotheses.contradicting_way_mass);
  hypothesis.decision = map::Decision::kRejected;
}

bool Judgement::reconsider(std::vector<LoopHypothesis>& hypotheses, Witnesses& witnesses) const {
  std::vector<WayEvidence>& way = witnesses.way;
  constexpr double kNews = 0.05;  // less sharpness than that changes nothing
  bool news = false;
  if (config_.sources.take_back) {
    for (const std::size_t h : take_back(hypotheses, parts_, *input_.pairs, track_, config_.hypotheses)) {
      exclude(hypotheses[h]);
      way[h] = {TrackVerdict::kContradicts, 0.0};
      news = true;
    }
  }
  if (!config_.sources.closed_way) return reconsider_old(hypotheses, witnesses, nullptr) || news;
  const WayWithLoops with_loops = close_way(hypotheses, parts_, *input_.pairs, track_, config_.hypotheses);
  for (std::size_t h = 0; h < hypotheses.size(); ++h) {
    LoopHypothesis& hypothesis = hypotheses[h];
    if (hypothesis.taken_back || way[h].verdict == TrackVerdict::kContradicts) continue;
    const int a = prototype(hypothesis.a);
    const int b = prototype(hypothesis.b);
    // A loop that was closed is judged by the others.
    const int tie = with_loops.tie_of[h];
    const TrackPrediction predicted = tie >= 0 ? with_loops.without[at(tie)].prediction : with_loops.way.predict(a, b);
    const WayEvidence evidence = track_.judge(a, b, predicted);
    const bool more = evidence.verdict == TrackVerdict::kContradicts ||
                      (evidence.verdict == TrackVerdict::kAgrees && evidence.sharpness > way[h].sharpness);
    if (!more) continue;
    news = news || evidence.verdict != way[h].verdict || evidence.sharpness > way[h].sharpness + kNews;
    way[h] = evidence;
    if (evidence.verdict == TrackVerdict::kContradicts && hypothesis.by == map::Decider::kMethod &&
        hypothesis.decision == map::Decision::kAccepted) {
      exclude(hypothesis);
    }
  }
  return reconsider_old(hypotheses, witnesses, &with_loops.way) || news;
}

Judgement::Claims Judgement::claims(std::span<const LoopHypothesis> hypotheses, std::span<const WayEvidence> way,
                                    bool accepted) const {
  Claims result;
  for (std::size_t h = 0; h < hypotheses.size() && old_ != nullptr; ++h) {
    const int a = prototype(hypotheses[h].a);
    const int b = prototype(hypotheses[h].b);  // the old one: they come last
    if (old_->is_old(a) == old_->is_old(b) || way[h].verdict == TrackVerdict::kContradicts) continue;
    if (accepted && hypotheses[h].decision != map::Decision::kAccepted) continue;
    result.hypothesis_of.push_back(h);
    result.claims.push_back({a, b});
  }
  return result;
}

bool Judgement::reconsider_old(std::vector<LoopHypothesis>& hypotheses, Witnesses& witnesses,
                               const ClosedWay* closed) const {
  constexpr double kNews = 0.05;  // less trust than that changes nothing
  bool news = false;
  if (config_.sources.take_back) {
    const Claims believed = claims(hypotheses, witnesses.way, true);
    const std::vector<char> excluded =
        believed.claims.empty() ? std::vector<char>() : old_->excluded(believed.claims, track_, closed);
    for (std::size_t c = 0; c < excluded.size(); ++c) {
      if (excluded[c] == 0) continue;
      exclude(hypotheses[believed.hypothesis_of[c]]);
      witnesses.way[believed.hypothesis_of[c]] = {TrackVerdict::kContradicts, 0.0};
      news = true;
    }
  }
  const Claims left = claims(hypotheses, witnesses.way, false);
  if (left.claims.empty()) return news;
  const std::vector<OldPlaces::Trust> trust = old_->trust(left.claims, track_, closed);
  for (std::size_t c = 0; c < trust.size(); ++c) {
    OldPlaces::Trust& known = witnesses.trust[left.hypothesis_of[c]];
    news = news || known.borne_out != trust[c].borne_out || std::abs(known.factor - trust[c].factor) > kNews;
    known = trust[c];
  }
  return news;
}

std::vector<int> Judgement::decide(std::vector<LoopHypothesis>& hypotheses) const {
  Witnesses witnesses{std::vector<WayEvidence>(hypotheses.size()), std::vector<OldPlaces::Trust>(hypotheses.size())};
  for (std::size_t h = 0; h < hypotheses.size() && config_.sources.way; ++h) {
    witnesses.way[h] = track_.judge(prototype(hypotheses[h].a), prototype(hypotheses[h].b));
  }
  const Claims with_old = claims(hypotheses, witnesses.way, false);
  if (!with_old.claims.empty()) {
    const std::vector<OldPlaces::Trust> trust = old_->trust(with_old.claims, track_, nullptr);
    for (std::size_t c = 0; c < trust.size(); ++c) witnesses.trust[with_old.hypothesis_of[c]] = trust[c];
  }
  std::vector<int> place_of_part = decide_by(hypotheses, witnesses);
  constexpr int kRounds = 5;
  for (int round = 0; round < kRounds && config_.sources.way && reconsider(hypotheses, witnesses); ++round) {
    place_of_part = decide_by(hypotheses, witnesses);
  }
  return place_of_part;
}

}  // namespace

ClosedLoops close_loops(const MappingInput& input, const MappingConfig& config, const TourTrack& track,
                        const ImageLabels& labels, float threshold, const map::TopologicalMap* previous,
                        const OldPlaces* old) {
  const DistanceFunction distance = clustering_distance(input, config, labels, track);
  const SamePlaceScale scale = same_place_scale(input, track, config.sources.beside);
  ClosedLoops result;
  result.cluster_of = complete_linkage(near_lists(*input.pairs, distance), threshold);
  std::vector<int> marked;
  for (const MarkedImage& mark : input.marks) marked.push_back(mark.image);
  result.parts = subclusters(result.cluster_of, input.tour_of, marked, distance);
  const std::vector<Subcluster>& parts = result.parts;
  const auto similarity = [&](int a, int b) {
    return scale.similarity(input.pairs->distance(parts[at(a)].prototype, parts[at(b)].prototype));
  };
  result.hypotheses = formulate_hypotheses(parts, similarity, config.hypotheses);
  if (config.sources.across) {
    add_across_clusters(result.hypotheses, parts, input, track, threshold, similarity, config.hypotheses, old);
  }
  for (LoopHypothesis& hypothesis : result.hypotheses) {
    hypothesis.meets = std::ranges::any_of(parts[at(hypothesis.a)].images, [&](int x) {
      return std::ranges::any_of(parts[at(hypothesis.b)].images, [&](int y) {
        return input.pairs->relation(x, y).match_share >= config.least_meeting_share;
      });
    });
  }
  // What one place may not hold, whatever speaks for it: two marks, two stretches that follow each other on the tour,
  // images that look too different to be one place.
  const float widest = config.widest_place * threshold;
  const auto apart = [&](int a, int b) {
    const int old_parts = (is_old(old, parts[at(a)].prototype) ? 1 : 0) + (is_old(old, parts[at(b)].prototype) ? 1 : 0);
    if (old_parts == 2) return old->place(parts[at(a)].prototype) != old->place(parts[at(b)].prototype);
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
  result.place_of_part = Judgement(input, config, track, parts, previous, old, apart).decide(result.hypotheses);
  return result;
}

}  // namespace homeward::mapping
