// SPDX-License-Identifier: Apache-2.0
#include "features/extract.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "core/angles.hpp"
#include "features/colour.hpp"
#include "features/descriptor_code.hpp"
#include "features/upright_sift.hpp"

namespace homeward::features {
namespace {

constexpr int kSeamPadding_px = 48;  // columns repeated beyond both ends, so that the seam looks like any other place
constexpr float kPatchRadiusPerSigma = 1.5F;  // of a blob, for colour and for the distance to the border

/// Grey with its dark half stretched: shadows by night keep corners above the detector's threshold.
cv::Mat padded_grey(const Image& rgb) {
  const cv::Mat colour(rgb.height_px, rgb.width_px, CV_8UC3, const_cast<std::uint8_t*>(rgb.data.data()));
  cv::Mat grey;
  cv::cvtColor(colour, grey, cv::COLOR_RGB2GRAY);
  cv::Mat curve(1, 256, CV_8U);
  for (int level = 0; level < 256; ++level) {
    curve.at<std::uint8_t>(level) = cv::saturate_cast<std::uint8_t>(255.0 * std::sqrt(level / 255.0));
  }
  cv::LUT(grey, curve, grey);
  cv::Mat padded;
  cv::copyMakeBorder(grey, padded, 0, 0, kSeamPadding_px, kSeamPadding_px, cv::BORDER_WRAP);
  return padded;
}

/// Distance of each pixel of the padded panorama to the nearest one that the camera does not see, pixels.
cv::Mat distance_to_border(const camera::Panorama& panorama) {
  const cv::Mat valid(panorama.rgb.height_px, panorama.rgb.width_px, CV_8UC1,
                      const_cast<std::uint8_t*>(panorama.valid.data()));
  cv::Mat padded;
  cv::copyMakeBorder(valid, padded, 0, 0, kSeamPadding_px, kSeamPadding_px, cv::BORDER_WRAP);
  cv::copyMakeBorder(padded, padded, 1, 1, 0, 0, cv::BORDER_CONSTANT, cv::Scalar(0));  // above and below: not seen
  cv::Mat distance;
  cv::distanceTransform(padded, distance, cv::DIST_L2, 3);
  return distance.rowRange(1, distance.rows - 1);
}

/// Inside the panorama and off its border.
std::vector<SiftPoint> clear_of_border(std::vector<SiftPoint> found, const cv::Mat& border_distance_px, int width_px) {
  std::erase_if(found, [&](const SiftPoint& point) {
    const float u_px = point.u_px - kSeamPadding_px;
    if (u_px < -0.5F || u_px >= static_cast<float>(width_px) - 0.5F) return true;
    const float clear_px = border_distance_px.at<float>(static_cast<int>(std::lround(point.v_px)),
                                                        static_cast<int>(std::lround(point.u_px)));
    return clear_px < kPatchRadiusPerSigma * point.sigma_px + 1.0F;
  });
  return found;
}

/// The strongest of each sector of azimuth in turn, so that no single poster takes the whole budget. Larger blobs are
/// seen again from farther away: the root of the size counts too (docs/benchmarks.md has the comparison).
std::vector<SiftPoint> spread_over_azimuth(std::vector<SiftPoint> points, int width_px, int budget) {
  constexpr int kSectors = 24;
  const auto rank = [](const SiftPoint& point) { return point.response * std::sqrt(point.sigma_px); };
  std::ranges::stable_sort(points, std::greater<>(), rank);
  std::vector<std::vector<SiftPoint>> sectors(kSectors);
  for (const SiftPoint& point : points) {
    const int sector =
        static_cast<int>((point.u_px - kSeamPadding_px + 0.5F) * kSectors / static_cast<float>(width_px));
    sectors[static_cast<std::size_t>(std::clamp(sector, 0, kSectors - 1))].push_back(point);
  }
  std::vector<SiftPoint> kept;
  for (std::size_t turn = 0; static_cast<int>(kept.size()) < budget; ++turn) {
    const std::size_t before = kept.size();
    for (const auto& sector : sectors) {
      if (turn < sector.size() && static_cast<int>(kept.size()) < budget) kept.push_back(sector[turn]);
    }
    if (kept.size() == before) break;
  }
  return kept;
}

FeatureSet sift_features(const camera::Panorama& panorama, const FeatureConfig& config) {
  const int width_px = panorama.rgb.width_px;
  const UprightSift sift(padded_grey(panorama.rgb));
  const auto points = spread_over_azimuth(
      clear_of_border(sift.detect(config.sift_contrast_threshold), distance_to_border(panorama), width_px), width_px,
      config.max_sift);
  FeatureSet set;
  const auto count = static_cast<Eigen::Index>(points.size());
  set.bearings.resize(count, 3);
  set.scales_rad.resize(count);
  set.descriptors.resize(count, config.sift_code_length);
  set.colours.resize(count, 3);
  const double px_to_rad = 2.0 * kPi / width_px;
  for (Eigen::Index i = 0; i < count; ++i) {
    const SiftPoint& point = points[static_cast<std::size_t>(i)];
    const Eigen::Vector2d pixel_px(static_cast<double>(point.u_px) - kSeamPadding_px, static_cast<double>(point.v_px));
    set.bearings.row(i) = panorama.geometry.bearing(pixel_px).cast<float>();
    set.scales_rad[i] = static_cast<float>(2.0 * static_cast<double>(point.sigma_px) * px_to_rad);
    std::array<float, UprightSift::kDescriptorLength> descriptor;
    sift.describe(point, descriptor.data());
    encode_sift(descriptor, {set.descriptors.row(i).data(), static_cast<std::size_t>(config.sift_code_length)});
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
  return text;
}

Appearance extract(const camera::Panorama& panorama, const FeatureConfig& config) {
  Appearance appearance;
  appearance.sift = sift_features(panorama, config);
  appearance.columns.bearings.resize(0, 3);
  appearance.columns.colours.resize(0, 3);
  appearance.colour_moments = colour_moments(panorama);
  return appearance;
}

}  // namespace homeward::features
