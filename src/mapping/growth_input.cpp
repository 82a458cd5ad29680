// SPDX-License-Identifier: Apache-2.0
#include "mapping/growth_input.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "map/lookup.hpp"
#include "mapping/candidates.hpp"

namespace homeward::mapping {
namespace {

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
  input.sweeps = std::move(tours.sweeps);
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
      if (!input.sweeps.empty()) input.sweeps.push_back(nullptr);
      input.place_of_anchor.push_back(static_cast<int>(p));
    }
  }
  return input;
}

Result<PairTable> compare_with_map(const GrowthInput& input, const CompareConfig& config, std::uint64_t seed,
                                   int threads, const std::function<void(double)>& progress,
                                   const std::stop_token& stop) {
  return compare_chosen(input.appearances, input.tour_of, config, seed, threads, progress, stop,
                        [&](PairLists pairs) { return without_anchor_pairs(std::move(pairs), input); });
}

}  // namespace homeward::mapping
