// SPDX-License-Identifier: Apache-2.0
#include "features/extract.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/angles.hpp"
#include "features/azimuth_spread.hpp"
#include "features/colour.hpp"
#include "features/columns.hpp"
#include "features/descriptor_code.hpp"
#include "features/upright_sift.hpp"

namespace homeward::features {
namespace {

constexpr int kSeamPadding_px = 48;  // columns repeated beyond both ends, so that the seam looks like any other place
constexpr float kPatchRadiusPerSigma = 1.5F;  // of a blob, for colour and for the distance to the border

/// Consecutive columns of the panorama, wrapping: what is searched for features.
struct Strip {
  int first_px = 0;
  int width_px = 0;

  [[nodiscard]] double to_panorama_px(double u_px, int panorama_width_px) const {
    const double u = std::fmod(u_px + first_px + 0.5, panorama_width_px);
    return (u < 0.0 ? u + panorama_width_px : u) - 0.5;
  }
};

/// The whole circle with its seam overlapping, or, for a camera that sees a part of the horizon, the columns around it:
/// all but the longest run of columns in which nothing is seen.
Strip seen_strip(const camera::Panorama& panorama) {
  const int width_px = panorama.rgb.width_px;
  const int height_px = panorama.rgb.height_px;
  std::vector<bool> seen(static_cast<std::size_t>(width_px), false);
  for (int v = 0; v < height_px; ++v) {
    const std::uint8_t* row = panorama.valid.data() + static_cast<std::ptrdiff_t>(v) * width_px;
    for (int u = 0; u < width_px; ++u) {
      if (row[u] != 0) seen[static_cast<std::size_t>(u)] = true;
    }
  }
  int longest_px = 0;
  int ends_px = 0;
  int run_px = 0;
  for (int u = 0; u < 2 * width_px; ++u) {
    run_px = seen[static_cast<std::size_t>(u % width_px)] ? 0 : std::min(run_px + 1, width_px);
    if (run_px > longest_px) {
      longest_px = run_px;
      ends_px = (u + 1) % width_px;
    }
  }
  constexpr int kMargin_px = 8;
  if (longest_px <= 2 * (kSeamPadding_px + kMargin_px)) return {-kSeamPadding_px, width_px + 2 * kSeamPadding_px};
  return {ends_px - kMargin_px, width_px - longest_px + 2 * kMargin_px};
}

/// The strip's columns of a picture as wide as the panorama.
cv::Mat cut(const cv::Mat& picture, const Strip& strip) {
  cv::Mat out(picture.rows, strip.width_px, picture.type());
  for (int u = 0; u < strip.width_px;) {
    const int from_px = ((strip.first_px + u) % picture.cols + picture.cols) % picture.cols;
    const int count_px = std::min(strip.width_px - u, picture.cols - from_px);
    picture.colRange(from_px, from_px + count_px).copyTo(out.colRange(u, u + count_px));
    u += count_px;
  }
  return out;
}

/// Grey with its dark half stretched: shadows by night keep corners above the detector's threshold.
cv::Mat stretched_grey(const Image& rgb) {
  const cv::Mat colour(rgb.height_px, rgb.width_px, CV_8UC3, const_cast<std::uint8_t*>(rgb.data.data()));
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_RGB2GRAY);
  cv::Mat curve(1, 256, CV_8U);
  for (int level = 0; level < 256; ++level) {
    curve.at<std::uint8_t>(level) = cv::saturate_cast<std::uint8_t>(255.0 * std::sqrt(level / 255.0));
  }
  cv::LUT(grey, curve, grey);
  return grey;
}

/// Distance of each pixel of the strip to the nearest one that the camera does not see, pixels.
cv::Mat distance_to_border(const camera::Panorama& panorama, const Strip& strip) {
  const cv::Mat valid(panorama.rgb.height_px, panorama.rgb.width_px, CV_8UC1,
                      const_cast<std::uint8_t*>(panorama.valid.data()));
  cv::Mat framed;
  cv::copyMakeBorder(cut(valid, strip), framed, 1, 1, 0, 0, cv::BORDER_CONSTANT, cv::Scalar(0));  // not seen
  cv::Mat distance;
  cv::distanceTransform(framed, distance, cv::DIST_L2, 3);
  return distance.rowRange(1, distance.rows - 1);
}

/// What follows from which pixels the camera sees: the same for all pictures of a camera.
struct Sight {
  std::vector<std::uint8_t> valid;
  int width_px = 0;
  Strip strip;
  cv::Mat border_distance_px;
};

/// Of this thread's last camera.
const Sight& sight_of(const camera::Panorama& panorama) {
  thread_local Sight last;
  if (last.width_px != panorama.rgb.width_px || last.valid != panorama.valid) {
    const Strip strip = seen_strip(panorama);
    last = {panorama.valid, panorama.rgb.width_px, strip, distance_to_border(panorama, strip)};
  }
  return last;
}

/// Off the border, and once each: not on the overlap of the seam.
std::vector<SiftPoint> clear_of_border(std::vector<SiftPoint> found, const cv::Mat& border_distance_px,
                                       const Strip& strip, int panorama_width_px) {
  const bool whole_circle = strip.width_px > panorama_width_px;
  std::erase_if(found, [&](const SiftPoint& point) {
    const float u_px = point.u_px - kSeamPadding_px;
    if (whole_circle && (u_px < -0.5F || u_px >= static_cast<float>(panorama_width_px) - 0.5F)) return true;
    const float clear_px = border_distance_px.at<float>(static_cast<int>(std::lround(point.v_px)),
                                                        static_cast<int>(std::lround(point.u_px)));
    return clear_px < kPatchRadiusPerSigma * point.sigma_px + 1.0F;
  });
  return found;
}

/// Which blobs to keep. Larger ones are seen again from farther away: the root of the size counts too
/// (docs/experiments/appearance_bytes.md).
std::vector<SiftPoint> strongest(const std::vector<SiftPoint>& points, const Strip& strip, int budget) {
  std::vector<RankedFeature> ranked;
  ranked.reserve(points.size());
  for (const SiftPoint& point : points) {
    ranked.push_back({static_cast<double>(point.response * std::sqrt(point.sigma_px)),
                      static_cast<int>((point.u_px + 0.5F) * kAzimuthSectors / static_cast<float>(strip.width_px))});
  }
  std::vector<SiftPoint> kept;
  for (const int i : spread_over_azimuth(ranked, budget)) kept.push_back(points[static_cast<std::size_t>(i)]);
  return kept;
}

FeatureSet sift_features(const camera::Panorama& panorama, const FeatureConfig& config, Unrounded* unrounded) {
  const int width_px = panorama.rgb.width_px;
  const Sight& sight = sight_of(panorama);
  const Strip& strip = sight.strip;
  const UprightSift sift(cut(stretched_grey(panorama.rgb), strip));
  const auto points =
      strongest(clear_of_border(sift.detect(config.sift_contrast_threshold), sight.border_distance_px, strip, width_px),
                strip, config.max_sift);
  FeatureSet set;
  const auto count = static_cast<Eigen::Index>(points.size());
  set.bearings.resize(count, 3);
  set.scales_rad.resize(count);
  set.descriptors.resize(count, static_cast<Eigen::Index>(config.sift_code_length) * config.sift_windows);
  set.colours.resize(count, 3);
  if (unrounded != nullptr) unrounded->sift.resize(count, UprightSift::kDescriptorLength);
  const double px_to_rad = 2.0 * kPi / width_px;
  for (Eigen::Index i = 0; i < count; ++i) {
    const SiftPoint& point = points[static_cast<std::size_t>(i)];
    if (i + 1 < count) sift.fetch(points[static_cast<std::size_t>(i + 1)]);
    const Eigen::Vector2d pixel_px(strip.to_panorama_px(static_cast<double>(point.u_px), width_px),
                                   static_cast<double>(point.v_px));
    set.bearings.row(i) = panorama.geometry.bearing(pixel_px).cast<float>();
    set.scales_rad[i] = static_cast<float>(2.0 * static_cast<double>(point.sigma_px) * px_to_rad);
    SiftPoint window = point;
    for (int k = 0; k < config.sift_windows; ++k) {
      std::array<float, UprightSift::kDescriptorLength> descriptor;
      sift.describe(window, descriptor.data());
      encode_sift(descriptor, {set.descriptors.row(i).data() + static_cast<std::ptrdiff_t>(k) * config.sift_code_length,
                               static_cast<std::size_t>(config.sift_code_length)});
      if (unrounded != nullptr && k == 0) std::ranges::copy(descriptor, unrounded->sift.row(i).data());
      window = sift.widened(window);
    }
    const auto colour = colour_invariants(panorama.rgb, pixel_px.x(), pixel_px.y(),
                                          std::max(2.0, static_cast<double>(kPatchRadiusPerSigma * point.sigma_px)));
    set.colours.row(i) << colour[0], colour[1], colour[2];
  }
  return set;
}

}  // namespace

std::string feature_config_id(const FeatureConfig& config) {
  char text[128];
  std::snprintf(text, sizeof text, "hw2-w%d-e%.4f_%.4f-s%d-t%.4f-l%d-c%d", config.panorama_width_px,
                config.elevation_max_rad, config.elevation_min_rad, config.max_sift, config.sift_contrast_threshold,
                config.sift_code_length, config.max_columns);
  // One window is what maps were made with before there could be more.
  return config.sift_windows == 1 ? text : text + ("-x" + std::to_string(config.sift_windows));
}

Appearance extract(const camera::Panorama& panorama, const FeatureConfig& config, Unrounded* unrounded) {
  Appearance appearance;
  appearance.sift = sift_features(panorama, config, unrounded);
  appearance.columns.bearings.resize(0, 3);
  appearance.columns.colours.resize(0, 3);
  if (unrounded != nullptr) unrounded->columns.resize(0, kColumnInvariants);
  if (config.max_columns > 0) {
    appearance.columns = extract_columns(panorama, config, unrounded != nullptr ? &unrounded->columns : nullptr);
  }
  appearance.colour_moments = colour_moments(panorama);
  if (is_monochrome(panorama)) {
    appearance.sift.colours.setConstant(kNoColour);
    appearance.columns.colours.setConstant(kNoColour);
  }
  return appearance;
}

}  // namespace homeward::features
