// SPDX-License-Identifier: Apache-2.0
#include "mapping/growth_input.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "map/lookup.hpp"
#include "mapping/candidates.hpp"
#include "mapping/parallel.hpp"

namespace homeward::mapping {
namespace {

constexpr double kFirstRoundShare = 0.75;  // of the work, roughly

/// Pairs of anchors say nothing new: the map has decided what they are.
PairLists without_anchor_pairs(PairLists pairs, const GrowthInput& input) {
  for (std::size_t b = static_cast<std::size_t>(input.new_images); b < pairs.size(); ++b) {
    std::erase_if(pairs[b], [&](int a) { return input.is_anchor(a); });
  }
  return pairs;
}

}  // namespace

Result<GrowthInput> growth_input(const map::TopologicalMap& old, NewTours tours) {
  const auto old_images = map::image_indices(old);
  std::unordered_set<ImageId> ids;
  for (const map::MapImage& image : tours.images) {
    const std::string& id = image.id.str();
    if (old_images.contains(image.id)) {
      return fail(ErrorCode::kInvalidInput,
                  "The image " + id +
                      " is in the map already. A tour is added once; another tour needs a folder of another name.",
                  id);
    }
    if (!ids.insert(image.id).second) return fail(ErrorCode::kInvalidInput, "The image " + id + " occurs twice.", id);
  }
  GrowthInput input;
  input.new_images = static_cast<int>(tours.images.size());
  input.images = std::move(tours.images);
  input.tour_of = std::move(tours.tour_of);
  input.appearances = std::move(tours.appearances);
  input.marks = std::move(tours.marks);
  int tour = input.tour_of.empty() ? 0 : input.tour_of.back() + 1;
  for (std::size_t p = 0; p < old.places.size(); ++p) {
    const map::Place& place = old.places[p];
    for (const features::Appearance& appearance : place.appearances) {
      const auto prototype = old_images.find(place.prototype);
      input.images.push_back(prototype == old_images.end() ? map::MapImage{place.prototype, {}, {}}
                                                           : old.images[static_cast<std::size_t>(prototype->second)]);
      input.tour_of.push_back(tour++);
      input.appearances.push_back(appearance);
      input.appearances.back().sift.document_frequency.clear();  // what grows is counted anew
      input.place_of_anchor.push_back(static_cast<int>(p));
    }
  }
  return input;
}

Result<PairTable> compare_with_map(const GrowthInput& input, const CompareConfig& config, std::uint64_t seed,
                                   int threads, const std::function<void(double)>& progress,
                                   const std::stop_token& stop) {
  const std::size_t images = input.images.size();
  PairTable table(static_cast<int>(images));
  /// False if it was cancelled.
  const auto compare = [&](const PairLists& pairs, double share_before, double share) {
    std::vector<std::vector<PairRelation>> relations(images);
    const auto compare_image = [&](std::size_t b) {
      for (std::size_t i = 0; i < pairs[b].size() && !stop.stop_requested(); ++i) {
        const auto a = static_cast<std::size_t>(pairs[b][i]);
        relations[b].push_back(
            relate(input.appearances[a], input.appearances[b], config.verify, seed + a * images + b));
      }
    };
    const auto report = [&](std::size_t done) {
      if (progress) progress(share_before + share * static_cast<double>(done) / static_cast<double>(images));
    };
    if (!parallel_for(images, threads, compare_image, report, stop) || stop.stop_requested()) return false;
    for (std::size_t b = 0; b < images; ++b) {
      for (std::size_t i = 0; i < pairs[b].size(); ++i) {
        if (relations[b][i].verified()) table.set(pairs[b][i], static_cast<int>(b), relations[b][i]);
      }
    }
    return true;
  };
  const auto cancelled = [] { return fail(ErrorCode::kCancelled, "The build was cancelled."); };
  auto first = first_candidates(input.appearances, input.tour_of, config.candidates, seed, threads, stop);
  if (!first) return pass_on(first);
  const PairLists compared = without_anchor_pairs(std::move(*first), input);
  if (!compare(compared, 0.0, kFirstRoundShare)) return cancelled();
  const PairLists second =
      without_anchor_pairs(second_candidates(table, compared, input.tour_of, config.candidates), input);
  if (!compare(second, kFirstRoundShare, 1.0 - kFirstRoundShare)) return cancelled();
  return table;
}

}  // namespace homeward::mapping
