// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

namespace homeward::features {

/// A blob of a picture at its own scale.
struct SiftPoint {
  float u_px = 0.0F;
  float v_px = 0.0F;
  float sigma_px = 0.0F;  // of the Gaussian that fits the blob
  float response = 0.0F;  // absolute contrast of the difference of Gaussians, picture over 0..1
  int octave = 0;         // 0: the picture at twice its size
  int layer = 0;          // within the octave
};

/// Scale-invariant features (Lowe 2004) without their orientation: a camera that turns about the vertical alone keeps
/// up where it is (Ledwich & Williams 2004). The scale space is made once, for finding and describing.
class UprightSift {
 public:
  static constexpr int kDescriptorLength = 128;  // 4 rows x 4 columns of cells x 8 directions of the gradient

  /// `grey` is 8 bits, one channel. Costs the scale space: about 2/3 of all.
  explicit UprightSift(const cv::Mat& grey);
  /// The thread that it ends in keeps the memory for its next one.
  ~UprightSift();
  UprightSift(const UprightSift&) = delete;
  UprightSift& operator=(const UprightSift&) = delete;

  /// Extrema of the scale space of at least `contrast` (Lowe's threshold; picture over 0..1) that are no edges.
  /// Row by row, octave by octave; the same picture gives the same points in the same order.
  [[nodiscard]] std::vector<SiftPoint> detect(double contrast) const;

  /// Asks the processor for what describing the point will read, to be called before it does something else: the rows
  /// of a window lie pages apart, where it does not look ahead by itself.
  void fetch(const SiftPoint& point) const;

  /// Histogram of gradients about one point, `kDescriptorLength` numbers: square roots of shares (Arandjelović &
  /// Zisserman 2012), so its length is 1; all 0 where the picture is flat.
  void describe(const SiftPoint& point, float* descriptor) const;

  /// The same point with its surroundings to twice the distance, for `describe`; an octave coarser where there is one.
  [[nodiscard]] SiftPoint widened(SiftPoint point) const;

 private:
  [[nodiscard]] const cv::Mat& picture_of(const SiftPoint& point) const {
    return octaves_[static_cast<std::size_t>(point.octave)][static_cast<std::size_t>(point.layer)];
  }
  /// Adds one octave's extrema.
  void search(int octave, double contrast, std::vector<SiftPoint>& points) const;
  /// Follows the parabola's top from pixel to pixel until it is within half of one.
  [[nodiscard]] std::optional<SiftPoint> refined(int octave, int layer, int row, int column, double contrast) const;

  std::vector<std::vector<cv::Mat>> octaves_;  // each the picture at one size, blurred more and more
};

}  // namespace homeward::features
