// SPDX-License-Identifier: Apache-2.0
#include "pipeline/picture_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

namespace homeward::pipeline {
namespace {

constexpr int kGrid_px = 8;
constexpr std::size_t kFewestBlind = 100;  // grid points; under that a frame says too little
constexpr std::size_t kCandidates = 32;    // pictures that may become the reference
constexpr double kStill = 8.0;             // grey levels that a blind area changes within a tour
constexpr double kOther = 30.0;            // and by which another camera's picture differs from it
constexpr std::size_t kFewestStill = 3;    // pictures with one blind area that make a reference
constexpr std::size_t kFewestOdd = 3;      // pictures with black corners that make another camera
constexpr double kBlack = 40.0;            // mean grey of a black corner
constexpr double kPlain = 10.0;            // and its spread
constexpr double kBrighter = 30.0;         // how much brighter the middle is

int grey(const Image& picture, int u, int v) {
  const std::uint8_t* pixel = picture.at(u, v);
  if (picture.channels < 3) return pixel[0];
  return (299 * pixel[0] + 587 * pixel[1] + 114 * pixel[2]) / 1000;
}

struct Patch {
  double mean = 0.0;
  double spread = 0.0;
};

/// Grey values of a part of the picture, given in shares of its sides.
Patch patch(const Image& picture, double left, double top, double share) {
  const int u0 = static_cast<int>(left * picture.width_px);
  const int v0 = static_cast<int>(top * picture.height_px);
  const int width = std::max(1, static_cast<int>(share * picture.width_px));
  const int height = std::max(1, static_cast<int>(share * picture.height_px));
  double sum = 0.0;
  double squares = 0.0;
  for (int v = v0; v < v0 + height; ++v) {
    for (int u = u0; u < u0 + width; ++u) {
      const double value = grey(picture, u, v);
      sum += value;
      squares += value * value;
    }
  }
  const double count = static_cast<double>(width) * height;
  const double mean = sum / count;
  return {mean, std::sqrt(std::max(0.0, squares / count - mean * mean))};
}

bool has_black_corners(const Image& picture) {
  constexpr double kSide = 0.06;
  double brightest = 0.0;
  for (const double left : {0.0, 1.0 - kSide}) {
    for (const double top : {0.0, 1.0 - kSide}) {
      const Patch corner = patch(picture, left, top, kSide);
      if (corner.mean > kBlack || corner.spread > kPlain) return false;
      brightest = std::max(brightest, corner.mean);
    }
  }
  constexpr double kMiddle = 0.5;
  return patch(picture, (1.0 - kMiddle) / 2.0, (1.0 - kMiddle) / 2.0, kMiddle).mean > brightest + kBrighter;
}

double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(static_cast<int>(a[i]) - static_cast<int>(b[i]));
  return sum / static_cast<double>(a.size());
}

/// The picture whose blind area most others have too, of a sample; none when it is hardly shared.
std::optional<std::size_t> most_shared(std::span<const PictureFrame* const> frames) {
  const std::size_t step = 1 + frames.size() / kCandidates;
  std::size_t best = 0;
  std::size_t best_shared = 0;
  for (std::size_t i = 0; i < frames.size(); i += step) {
    const auto shared = static_cast<std::size_t>(std::ranges::count_if(
        frames, [&](const PictureFrame* other) { return difference(frames[i]->blind, other->blind) < kStill; }));
    if (shared > best_shared) {
      best = i;
      best_shared = shared;
    }
  }
  return best_shared >= kFewestStill ? std::optional(best) : std::nullopt;
}

/// Of each picture: is it of the other camera? By what the blind area looks like.
std::vector<bool> odd_by_blind_area(std::span<const PictureFrame* const> frames) {
  std::vector<bool> odd(frames.size(), false);
  if (frames.empty() || frames.front()->blind.size() < kFewestBlind) return odd;
  const auto shared = most_shared(frames);
  if (!shared) return odd;
  const std::vector<std::uint8_t>& reference = frames[*shared]->blind;
  for (std::size_t i = 0; i < frames.size(); ++i) odd[i] = difference(frames[i]->blind, reference) > kOther;
  return odd;
}

/// By black corners, where the camera itself has none.
std::vector<bool> odd_by_corners(std::span<const PictureFrame* const> frames) {
  std::vector<bool> odd(frames.size(), false);
  if (frames.empty() || !frames.front()->blind.empty()) return odd;
  for (std::size_t i = 0; i < frames.size(); ++i) odd[i] = frames[i]->black_corners;
  const auto count = static_cast<std::size_t>(std::ranges::count(odd, true));
  if (count < kFewestOdd || odd.size() - count < kFewestOdd) odd.assign(odd.size(), false);
  return odd;
}

}  // namespace

FrameSampler::FrameSampler(const camera::Camera& camera) {
  const int width_px = camera.config().width_px;
  const int height_px = camera.config().height_px;
  // A point is blind with all around it: the ring's own edge moves with the mirror's shaking.
  const auto blind = [&](int u, int v) { return !camera.bearing({static_cast<double>(u), static_cast<double>(v)}); };
  for (int v = kGrid_px / 2; v < height_px; v += kGrid_px) {
    for (int u = kGrid_px / 2; u < width_px; u += kGrid_px) {
      if (!blind(u, v)) continue;
      const bool around = blind(std::max(0, u - kGrid_px), v) && blind(std::min(width_px - 1, u + kGrid_px), v) &&
                          blind(u, std::max(0, v - kGrid_px)) && blind(u, std::min(height_px - 1, v + kGrid_px));
      if (around) blind_px_.emplace_back(u, v);
    }
  }
}

PictureFrame FrameSampler::sample(const Image& picture) const {
  PictureFrame frame;
  frame.read = true;
  frame.blind.reserve(blind_px_.size());
  for (const Eigen::Vector2i& pixel : blind_px_) {
    frame.blind.push_back(static_cast<std::uint8_t>(grey(picture, pixel.x(), pixel.y())));
  }
  frame.black_corners = has_black_corners(picture);
  return frame;
}

Status check_one_camera(std::span<const map::MapImage> images, std::span<const PictureFrame> frames) {
  std::vector<const PictureFrame*> read;
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].read) continue;
    read.push_back(&frames[i]);
    at.push_back(i);
  }
  std::vector<bool> odd = odd_by_blind_area(read);
  if (std::ranges::count(odd, true) == 0) odd = odd_by_corners(read);
  const auto others = std::ranges::count(odd, true);
  if (others == 0) return {};
  const auto change = std::ranges::adjacent_find(odd, std::ranges::not_equal_to{}) - odd.begin();
  // All odd against a camera that is not among them: nothing to say here.
  if (change == std::ssize(odd)) return {};
  const auto first = static_cast<std::size_t>(change) + 1;
  const bool for_good =
      std::ranges::adjacent_find(odd.begin() + change + 1, odd.end(), std::ranges::not_equal_to{}) == odd.end();
  const auto of_this = std::ranges::count(odd, static_cast<bool>(odd[first]));
  return fail(ErrorCode::kInvalidInput,
              std::string(for_good ? "From this picture on they are" : "This picture is") +
                  " of another camera than the pictures before: what a mirror or lens leaves black is not the same (" +
                  std::to_string(of_this) + " of " + std::to_string(odd.size()) +
                  " pictures). A map is made of one camera's pictures; take out those of the other.",
              images[at[first]].id.str());
}

}  // namespace homeward::pipeline
