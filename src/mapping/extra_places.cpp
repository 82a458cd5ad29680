// SPDX-License-Identifier: Apache-2.0
#include "mapping/extra_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>

#include "core/index.hpp"
#include "mapping/new_places.hpp"

namespace homeward::mapping {
namespace {

constexpr int kMostCandidates = 12;  // images tried between two prototypes, evenly spread where there are more
constexpr int kMostDrives = 3;       // drives along one edge that are tried

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

  /// The images between `from` and `to` that best join them, out of `free`; none where none helps.
  Chain chain(int from, int to, std::span<const int> free, int depth) {
    Chain direct{{}, 0, sights_.confidence(from, to)};
    direct.weak = direct.weakest < config_.weak_below_confidence ? 1 : 0;
    if (direct.weak == 0 || depth <= 0 || free.empty()) return direct;
    const int middle = best_between(from, to, free);
    const auto split = static_cast<std::size_t>(std::ranges::lower_bound(free, middle) - free.begin());
    Chain joined = chain(from, middle, free.first(split), depth - 1);
    const Chain rest = chain(middle, to, free.subspan(split + 1), depth - 1);
    joined.images.push_back(middle);
    joined.images.insert(joined.images.end(), rest.images.begin(), rest.images.end());
    joined.weak += rest.weak;
    joined.weakest = std::min(joined.weakest, rest.weakest);
    const bool helps = joined.weak == 0 || (joined.weak == 1 && joined.weakest > direct.weakest);
    return helps ? joined : direct;
  }

 private:
  /// The image that both see best; of equals the one in the middle, and of these the earlier.
  int best_between(int from, int to, std::span<const int> free) {
    const double middle = (free.front() + free.back()) / 2.0;
    const auto key = [&](int image) {
      const double seen = std::min(sights_.confidence(from, image), sights_.confidence(image, to));
      return std::tuple(-seen, std::abs(image - middle), image);
    };
    return std::ranges::min(thinned(free), {}, key);
  }

  static std::vector<int> thinned(std::span<const int> images) {
    if (images.size() <= kMostCandidates) return {images.begin(), images.end()};
    std::vector<int> kept;
    kept.reserve(kMostCandidates);
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

/// Gives the images of a chain places of their own. Returns the index of the first.
int add_places(const MappingInput& input, const Chain& chain, std::vector<map::Place>& places) {
  const int first_new = static_cast<int>(places.size());
  for (const int prototype : chain.images) {
    places.push_back(new_place(input, prototype, places.size()));
  }
  return first_new;
}

/// Moves images of a drive into the places of a chain: from the border of the two places outwards, as long as an image
/// looks more like one of the chain than like its own place; on the drive that the chain comes from (`own`) all between
/// the chain and the border.
void draw_in(const MappingInput& input, const Drive& drive, const std::vector<int>& free, const Chain& chain, bool own,
             int first_new, const std::vector<int>& prototype, std::vector<int>& place_of_image) {
  const auto nearest = [&](int image) {
    return std::ranges::min_element(
        chain.images, {}, [&](int new_one) { return std::pair(input.pairs->distance(image, new_one), new_one); });
  };
  const auto take = [&](int image, bool certainly) {
    const auto best = nearest(image);
    const int present = prototype[at(place_of_image[at(image)])];
    if (!certainly && !(input.pairs->distance(image, *best) < input.pairs->distance(image, present))) return false;
    place_of_image[at(image)] = first_new + static_cast<int>(best - chain.images.begin());
    return true;
  };
  for (int image = drive.before.last; !free.empty() && image >= free.front(); --image) {
    if (!take(image, own && image >= chain.images.front())) break;
  }
  for (int image = drive.after.first; !free.empty() && image <= free.back(); ++image) {
    if (!take(image, own && image <= chain.images.back())) break;
  }
}

}  // namespace

std::vector<int> pinned_images(const MappingInput& input, std::span<const Subcluster> parts) {
  std::vector<int> pinned;
  for (const MarkedImage& mark : input.marks) pinned.push_back(mark.image);
  for (const Subcluster& part : parts) pinned.push_back(part.prototype);
  return pinned;
}

ExtraPlaces insert_extra_places(const MappingInput& input, const MappingConfig& config, std::span<const int> pinned,
                                Sights& sights, std::vector<map::Place>& places, std::vector<int>& place_of_image,
                                const std::function<bool(int, int)>& settled) {
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
    if (settled && settled(ends.first, ends.second)) continue;
    const double direct = sights.confidence(prototype[at(ends.first)], prototype[at(ends.second)]);
    if (direct >= config.weak_below_confidence) continue;
    ++extra.weak_before;
    const Drive* best_drive = nullptr;
    Chain best;
    for (const Drive& drive : std::span(along).first(std::min<std::size_t>(along.size(), kMostDrives))) {
      const Chain chain = mender.chain(prototype[at(drive.before.place)], prototype[at(drive.after.place)],
                                       free_images(drive, stays), config.extra_place_depth);
      const auto key = [](const Chain& c) { return std::tuple(c.weak, c.images.size(), -c.weakest); };
      if (chain.images.empty() || (best_drive != nullptr && !(key(chain) < key(best)))) continue;
      best_drive = &drive;
      best = chain;
    }
    if (best_drive == nullptr) {
      ++extra.weak_after;
      continue;
    }
    extra.weak_after += best.weak;
    extra.prototypes.insert(extra.prototypes.end(), best.images.begin(), best.images.end());
    const int first_new = add_places(input, best, places);
    for (const Drive& drive : along) {
      draw_in(input, drive, free_images(drive, stays), best, &drive == best_drive, first_new, prototype,
              place_of_image);
    }
  }
  if (extra.prototypes.empty()) return extra;
  for (map::Place& place : places) place.members.clear();
  for (std::size_t i = 0; i < input.images.size(); ++i) {
    places[at(place_of_image[i])].members.push_back(input.images[i].id);
  }
  return extra;
}

}  // namespace homeward::mapping
