// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "core/range_sweep.hpp"
#include "core/result.hpp"
#include "core/time.hpp"

namespace homeward {

/// What a tour says about one of its pictures.
struct TourImage {
  ImageId id;  // "tour/file"
  std::optional<TimeUs> t_us;
  std::optional<Pose2> odometry;                   // tour frame
  std::optional<RangeSweep> sweep = std::nullopt;  // of a range sensor, taken with it
};

/// A mark of tour.json: this picture is its own prototype and a destination.
struct TourMark {
  std::string image;  // file name within the tour
  std::string label;
};

/// Pictures of one guided tour in driving order; implemented by folders (command line, agent) and the server's store.
class TourSource {
 public:
  virtual ~TourSource() = default;
  [[nodiscard]] virtual const std::vector<TourImage>& images() const = 0;
  [[nodiscard]] virtual const std::vector<TourMark>& marks() const = 0;
  /// Reads and decodes picture `index`; may be called from several threads.
  /// Errors: kUnsupportedImage, kTruncatedImage, kImageTooLarge, kIo, each naming the picture.
  [[nodiscard]] virtual Result<Image> read(std::size_t index) const = 0;
};

}  // namespace homeward
