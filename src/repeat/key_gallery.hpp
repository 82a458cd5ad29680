// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "camera/camera.hpp"
#include "geometry/two_view.hpp"
#include "matching/nearest.hpp"
#include "repeat/seen.hpp"
#include "tracking/image_pyramid.hpp"

namespace homeward::repeat {

struct RecognitionConfig {
  int most_features = 300;      // of a picture, the strongest
  double contrast = 0.01;       // of a feature, picture over 0..1
  double ratio = 0.85;          // to the second best match (Lowe 2004, §7.1)
  int most_compared = 40;       // key images that one picture is compared with
  int most_verified = 3;        // of those, by geometry
  int fewest_agreeing = 15;     // matches that agree with one motion
  double least_agreeing = 0.3;  // of the matches
  int vouching = 30;            // so many that agree also make up for landmarks that are not found
};
/// Empty when valid; lists all problems.
std::vector<std::string> problems(const RecognitionConfig& config);

/// Features of a picture that are found again from elsewhere.
struct DescribedPicture {
  std::vector<geometry::SeenPoint> seen;
  matching::ByteDescriptors descriptors;  // a row for each
};

/// Upright SIFT: the camera is level, and up stays up. Empty for a plain picture.
DescribedPicture describe(const tracking::ImagePyramid& picture, const camera::Camera& camera,
                          const RecognitionConfig& config);

/// Features of two pictures that look alike: which of the first, which of the second.
struct DescribedMatch {
  int first = 0;
  int second = 0;
  int distance = 0;  // squared, of their descriptors
};
/// Mutual nearest descriptors that pass the ratio test.
std::vector<DescribedMatch> matches_of(const DescribedPicture& first, const DescribedPicture& second, double ratio);

/// A key image that a picture shows the place of.
struct RecognisedKey {
  int key = 0;
  geometry::TwoViewEstimate estimate;  // `current` is the picture, `target` the key image
};

/// The key images of a path, for finding out without any expectation which of them a picture was taken near to. The
/// memory of one is some 30 kB.
class KeyGallery {
 public:
  void add(DescribedPicture key) { keys_.push_back(std::move(key)); }
  [[nodiscard]] int size() const { return static_cast<int>(keys_.size()); }

  /// Which of some key images a picture shows, the best first: mutual nearest descriptors that pass the ratio test,
  /// and one motion (five points: geometry::estimate_two_view) that enough of them agree with.
  [[nodiscard]] std::vector<RecognisedKey> recognise(const DescribedPicture& picture, std::span<const int> keys,
                                                     const RecognitionConfig& config,
                                                     const geometry::TwoViewConfig& geometry, std::uint64_t seed) const;

 private:
  std::vector<DescribedPicture> keys_;  // by number
};

}  // namespace homeward::repeat
