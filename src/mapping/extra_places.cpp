// SPDX-License-Identifier: Apache-2.0
#include "mapping/extra_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>

namespace homeward::mapping {
namespace {

constexpr int kMostCandidates = 12;  // images tried between two prototypes, evenly spread where there are more
constexpr int kMostDrives = 3;       // drives along one edge that are tried

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// Images that may stand between two prototypes, and how well they do.
struct Chain {
  std::vector<int> images;  // tour order
  int weak = 0;             // of its edges
  double weakest = 0.0;     // confidence
};

/// One drive from one place to the next.
struct Drive {
  Run before;
  Run after;
};

class Mender {
 public:
  Mender(Sights& sights, const MappingConfig& config) : sights_(sights), config_(config) {}

  [[nodiscard]] bool weak(int a, int b) { return sights_.confidence(a, b) < config_.weak_below_confidence; }

  /// The images between `from` and `to` that best join them, out of `free`.
  Chain chain(int from, int to, const std::vector<int>& free) {
    Chain found;
    found.images = between(from, to, free, config_.extra_place_depth);
    found.weakest = 1.0;
    int last = from;
    const auto add = [&](int image) {
      const double confidence = sights_.confidence(last, image);
      found.weak += confidence < config_.weak_below_confidence ? 1 : 0;
      found.weakest = std::min(found.weakest, confidence);
      last = image;
    };
    for (const int image : found.images) add(image);
    add(to);
    return found;
  }

 private:
  std::vector<int> between(int from, int to, const std::vector<int>& free, int depth) {
    if (depth <= 0 || free.empty()) return {};
    const std::vector<int> candidates = thinned(free);
    // Best seen by both; of equals the one in the middle, and of these the earlier.
    const double middle = (candidates.front() + candidates.back()) / 2.0;
    const auto key = [&](int image) {
      const double seen = std::min(sights_.confidence(from, image), sights_.confidence(image, to));
      return std::tuple(-seen, std::abs(image - middle), image);
    };
    int best = candidates.front();
    auto best_key = key(best);
    for (std::size_t i = 1; i < candidates.size(); ++i) {
      const auto candidate_key = key(candidates[i]);
      if (!(candidate_key < best_key)) continue;
      best = candidates[i];
      best_key = candidate_key;
    }
    std::vector<int> images;
    const auto split = std::ranges::lower_bound(free, best);
    if (weak(from, best)) images = between(from, best, {free.begin(), split}, depth - 1);
    images.push_back(best);
    if (weak(best, to)) {
      const std::vector<int> rest = between(best, to, {std::next(split), free.end()}, depth - 1);
      images.insert(images.end(), rest.begin(), rest.end());
    }
    return images;
  }

  static std::vector<int> thinned(const std::vector<int>& images) {
    if (images.size() <= kMostCandidates) return images;
    std::vector<int> kept;
    for (int i = 0; i < kMostCandidates; ++i) {
      kept.push_back(images[at(i) * (images.size() - 1) / (kMostCandidates - 1)]);
    }
    return kept;
  }

  Sights& sights_;
  const MappingConfig& config_;
};

/// The images strictly between the last pinned one of the first run and the first pinned one of the second. A run
/// without a pinned one stays whole.
std::vector<int> free_images(const Drive& drive, const std::vector<char>& pinned) {
  int low = drive.before.last;
  while (low >= drive.before.first && !pinned[at(low)]) --low;
  if (low < drive.before.first) low = drive.before.last;
  int high = drive.after.first;
  while (high <= drive.after.last && !pinned[at(high)]) ++high;
  if (high > drive.after.last) high = drive.after.first;
  std::vector<int> images;
  for (int image = low + 1; image < high; ++image) images.push_back(image);
  return images;
}

/// Moves the images of the drive that lie nearest to those of the chain into places of their own.
void insert(const MappingInput& input, const Drive& drive, const Chain& chain, std::vector<map::Place>& places,
            std::vector<int>& place_of_image) {
  const int first_new = static_cast<int>(places.size());
  for (const int prototype : chain.images) {
    map::Place place;
    place.id = PlaceId("new" + std::to_string(places.size()));
    place.prototype = input.images[at(prototype)].id;
    place.appearances.push_back(input.appearances[at(prototype)]);
    places.push_back(std::move(place));
  }
  const int first = std::min(chain.images.front(), drive.after.first);
  const int last = std::max(chain.images.back(), drive.before.last);
  for (int image = first; image <= last; ++image) {
    const auto nearest =
        std::ranges::min_element(chain.images, {}, [&](int prototype) { return std::abs(image - prototype); });
    std::erase(places[at(place_of_image[at(image)])].members, input.images[at(image)].id);
    place_of_image[at(image)] = first_new + static_cast<int>(nearest - chain.images.begin());
    places[at(place_of_image[at(image)])].members.push_back(input.images[at(image)].id);
  }
}

}  // namespace

ExtraPlaces insert_extra_places(const MappingInput& input, const MappingConfig& config, std::span<const int> pinned,
                                Sights& sights, std::vector<map::Place>& places, std::vector<int>& place_of_image) {
  const std::vector<int> prototype = prototype_images(input, places);
  std::vector<char> stays(input.images.size(), 0);
  for (const int image : pinned) stays[at(image)] = 1;
  for (const int image : prototype) stays[at(image)] = 1;

  std::map<PlacePair, std::vector<Drive>> drives;
  const std::vector<Run> stretches = runs(input, place_of_image);
  for (std::size_t r = 1; r < stretches.size(); ++r) {
    const Drive drive{stretches[r - 1], stretches[r]};
    if (drive.before.place == drive.after.place ||
        input.tour_of[at(drive.before.last)] != input.tour_of[at(drive.after.first)]) {
      continue;
    }
    drives[std::minmax(drive.before.place, drive.after.place)].push_back(drive);
  }
  ExtraPlaces extra;
  Mender mender(sights, config);
  for (const auto& [ends, along] : drives) {
    const double direct = sights.confidence(prototype[at(ends.first)], prototype[at(ends.second)]);
    if (direct >= config.weak_below_confidence) continue;
    ++extra.weak_before;
    const Drive* best_drive = nullptr;
    Chain best;
    for (const Drive& drive : std::span(along).first(std::min<std::size_t>(along.size(), kMostDrives))) {
      const Chain chain =
          mender.chain(prototype[at(drive.before.place)], prototype[at(drive.after.place)], free_images(drive, stays));
      const bool helps = !chain.images.empty() && (chain.weak == 0 || (chain.weak == 1 && chain.weakest > direct));
      const auto key = [](const Chain& c) { return std::tuple(c.weak, c.images.size(), -c.weakest); };
      if (!helps || (best_drive != nullptr && !(key(chain) < key(best)))) continue;
      best_drive = &drive;
      best = chain;
    }
    if (best_drive == nullptr) {
      ++extra.weak_after;
      continue;
    }
    extra.weak_after += best.weak;
    extra.bridged.insert(ends);
    extra.prototypes.insert(extra.prototypes.end(), best.images.begin(), best.images.end());
    insert(input, *best_drive, best, places, place_of_image);
  }
  return extra;
}

}  // namespace homeward::mapping
