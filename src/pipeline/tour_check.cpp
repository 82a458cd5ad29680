// SPDX-License-Identifier: Apache-2.0
#include "pipeline/tour_check.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

#include "mapping/compare_all.hpp"

namespace homeward::pipeline {
namespace {

std::string size_text(const PictureSize& size) {
  return std::to_string(size.width_px) + " x " + std::to_string(size.height_px);
}

std::string name_of(const map::MapImage& image) { return image.id.str().substr(image.id.str().rfind('/') + 1); }

// Two pictures show one view from one point when most of the smaller one's features are in the other and hardly moved.
constexpr float kSameShare = 0.5F;
constexpr float kSameParallax_rad = 0.006F;

bool same_view(const features::Appearance& a, const features::Appearance& b, std::uint64_t seed) {
  const mapping::PairRelation relation = mapping::relate(a, b, mapping::CompareConfig{}.verify, seed);
  return relation.verified() && relation.match_share >= kSameShare && relation.parallax_rad <= kSameParallax_rad;
}

// Figures: docs/experiments/tours_out_of_order.md.
constexpr float kFarther = 12.0F;      // times as far as a relative elsewhere: a step to a stranger
constexpr float kAsNear = 1.2F;        // a relative elsewhere is as near as the neighbour on the other side
constexpr int kSideBySide = 2;         // pictures between relatives of a way that is driven again
constexpr double kMostJumps = 0.35;    // share of the steps from which on a tour is no tour
constexpr std::size_t kMostNamed = 8;  // pictures that a warning names

struct Relative {
  int image = -1;
  float distance = std::numeric_limits<float>::infinity();
};

/// The picture most like this one in its tour that is neither it nor beside it.
Relative elsewhere(const mapping::PairTable& pairs, std::span<const int> tour_of, int image) {
  Relative best;
  for (const int other : pairs.partners(image)) {
    if (std::abs(other - image) < 2 ||
        tour_of[static_cast<std::size_t>(other)] != tour_of[static_cast<std::size_t>(image)])
      continue;
    const float distance = pairs.distance(image, other);
    if (distance < best.distance) best = {other, distance};
  }
  return best;
}

/// Whether the way between a picture and the next is driven again where `here` and `there`, which show the same two
/// spots, are: side by side, or where the camera goes back from a spot at which it has stood or turned. Of the pictures
/// from there, chance says which is nearest to the first.
bool driven_again(const mapping::PairTable& pairs, std::span<const int> tour_of, int image, int here, int there) {
  if (std::abs(here - there) <= kSideBySide) return true;
  const float still = pairs.distance(image, image + 1) / kFarther;
  if (!std::isfinite(still)) return false;  // they have nothing in common
  const auto stands = [&](int from) {
    return from >= 0 && from + 1 < pairs.images() &&
           tour_of[static_cast<std::size_t>(from)] == tour_of[static_cast<std::size_t>(from) + 1] &&
           pairs.distance(from, from + 1) < still;
  };
  int last = image + 1;
  while (stands(last)) ++last;
  int first = image;
  while (stands(first - 1)) --first;
  const bool back = last > image + 1 && here > last && here <= last + kSideBySide;
  const bool came = first < image && there < first && there >= first - kSideBySide;
  return back || came;
}

/// Is the step from `image` to the next one a jump?
bool jumps(const mapping::PairTable& pairs, std::span<const int> tour_of, int image) {
  const int next = image + 1;
  const Relative here = elsewhere(pairs, tour_of, image);
  const Relative there = elsewhere(pairs, tour_of, next);
  if (here.image < 0 || there.image < 0 || driven_again(pairs, tour_of, image, here.image, there.image)) return false;
  if (pairs.distance(image, next) <= kFarther * std::max(here.distance, there.distance)) return false;
  const auto beside = [&](int of, int other) {
    const bool there_is = other >= 0 && other < pairs.images() &&
                          tour_of[static_cast<std::size_t>(other)] == tour_of[static_cast<std::size_t>(of)];
    return there_is ? pairs.distance(of, other) : std::numeric_limits<float>::infinity();
  };
  return here.distance <= kAsNear * beside(image, image - 1) && there.distance <= kAsNear * beside(next, next + 1);
}

}  // namespace

Status check_sizes(std::span<const map::MapImage> images, std::span<const PictureSize> sizes,
                   const camera::CameraConfig& camera) {
  std::size_t read = 0;
  std::size_t wrong = 0;
  std::size_t first = sizes.size();
  bool right_after_wrong = false;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i].width_px == 0) continue;
    ++read;
    if (sizes[i].width_px == camera.width_px && sizes[i].height_px == camera.height_px) {
      right_after_wrong = right_after_wrong || wrong > 0;
    } else if (wrong++ == 0) {
      first = i;
    }
  }
  if (wrong == 0) return {};
  const std::string its = size_text(sizes[first]) + " pixels";
  const std::string camera_s = size_text({camera.width_px, camera.height_px});
  std::string message;
  if (wrong == read) {
    message = "The pictures have " + its + ", the camera has " + camera_s + ": is this camera.json of another camera?";
  } else {
    const std::string how_many = " (" + std::to_string(wrong) + " of " + std::to_string(read) + " pictures)";
    message = right_after_wrong || wrong == 1
                  ? "The picture has " + its + ", the camera has " + camera_s + how_many
                  : "From this picture on they have " + its + ", the camera has " + camera_s + how_many;
    message += ": a map is made of one camera's pictures; take out those of the other.";
  }
  return fail(ErrorCode::kWrongImageSize, message, images[first].id.str());
}

Status check_left(std::span<const Error> skipped, std::size_t left) {
  if (left >= kFewestImages || skipped.empty()) return {};
  const std::string count = std::to_string(skipped.size() + left);
  const Error& first = skipped.front();
  if (left == 0) {
    return fail(first.code, "None of the " + count + " pictures can be read. The first: " + first.message, first.where);
  }
  return fail(ErrorCode::kTooFewImages,
              "Only " + std::to_string(left) + " of the " + count + " pictures can be read; a map needs at least " +
                  std::to_string(kFewestImages) + ". The first that cannot: " + first.message,
              first.where);
}

Status check_motion(std::span<const map::MapImage> images, std::span<const features::Appearance> appearances,
                    std::uint64_t seed) {
  // Far ones first: of a tour that moves, the first look ends this.
  for (std::size_t i = appearances.size() / 2; i < appearances.size(); ++i) {
    if (!same_view(appearances.front(), appearances[i], seed)) return {};
  }
  for (std::size_t i = 1; i < appearances.size() / 2; ++i) {
    if (!same_view(appearances.front(), appearances[i], seed)) return {};
  }
  return fail(ErrorCode::kTooFewImages,
              "All " + std::to_string(images.size()) +
                  " pictures show the same view: the camera stood still, or one picture was kept again and again. "
                  "A map needs pictures from along a way; drive the tour with the camera running.",
              images.front().id.str());
}

namespace {

std::string out_of_order(std::size_t jumps, std::size_t steps, bool against_times) {
  return "The pictures are out of order: at " + std::to_string(jumps) + " of " + std::to_string(steps) +
         " steps the next picture does not resemble the one before, but others do." +
         (against_times ? " Their times say another order than their names, too." : "") +
         " Name them in the order of the drive (00001.jpg, 00002.jpg, ...).";
}

}  // namespace

Result<std::vector<map::TourWarning>> check_order(std::span<const map::MapImage> images, std::span<const int> tour_of,
                                                  const mapping::PairTable& pairs) {
  std::vector<map::TourWarning> warnings;
  for (std::size_t begin = 0; begin < images.size();) {
    std::size_t end = begin + 1;
    while (end < images.size() && tour_of[end] == tour_of[begin]) ++end;
    std::vector<std::size_t> jump_after;
    std::size_t back_in_time = end;
    for (std::size_t i = begin; i + 1 < end; ++i) {
      if (jumps(pairs, tour_of, static_cast<int>(i))) jump_after.push_back(i);
      const bool older = images[i].t_us && images[i + 1].t_us && *images[i + 1].t_us < *images[i].t_us;
      if (older && back_in_time == end) back_in_time = i + 1;
    }
    const std::size_t steps = end - begin - 1;
    if (!jump_after.empty()) {
      const ImageId& first = images[jump_after.front() + 1].id;
      if (static_cast<double>(jump_after.size()) > kMostJumps * static_cast<double>(steps)) {
        return fail(ErrorCode::kInvalidInput, out_of_order(jump_after.size(), steps, back_in_time != end), first.str());
      }
      map::TourWarning warning{
          map::TourWarning::Kind::kJumps, first, jump_after.size(), steps, {}, back_in_time != end};
      for (std::size_t i = 0; i < std::min(kMostNamed, jump_after.size()); ++i) {
        warning.first.push_back({name_of(images[jump_after[i]]), name_of(images[jump_after[i] + 1])});
      }
      warnings.push_back(std::move(warning));
    } else if (back_in_time != end) {
      warnings.push_back({map::TourWarning::Kind::kPictureOlder, images[back_in_time].id});
    }
    begin = end;
  }
  return warnings;
}

}  // namespace homeward::pipeline
