// SPDX-License-Identifier: Apache-2.0
#include "features/extract.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

#include "core/angles.hpp"
#include "features/colour.hpp"
#include "features/columns.hpp"

namespace homeward::features {
namespace {

constexpr int kSeamPadding_px = 48;  // columns repeated beyond both ends, so that the seam looks like any other place
constexpr int kDescriptorBytes = 128;
constexpr double kPatchRadiusPerSize = 1.5;  // of a keypoint's diameter, for colour and for the distance to the border

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

/// One keypoint per place and size, whatever orientations the detector found; inside the panorama and off its border.
std::vector<cv::KeyPoint> upright(std::vector<cv::KeyPoint> found, const cv::Mat& border_distance_px, int width_px) {
  const auto key = [](const cv::KeyPoint& point) { return std::tuple(point.pt.x, point.pt.y, point.size); };
  std::sort(found.begin(), found.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  found.erase(std::unique(found.begin(), found.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); }),
              found.end());
  std::erase_if(found, [&](const cv::KeyPoint& point) {
    const float u_px = point.pt.x - kSeamPadding_px;
    if (u_px < -0.5F || u_px >= static_cast<float>(width_px) - 0.5F) return true;
    const float clear_px = border_distance_px.at<float>(static_cast<int>(std::lround(point.pt.y)),
                                                        static_cast<int>(std::lround(point.pt.x)));
    return clear_px < static_cast<float>(kPatchRadiusPerSize) * point.size * 0.5F + 1.0F;
  });
  for (cv::KeyPoint& point : found) point.angle = 0.0F;
  return found;
}

/// The strongest of each sector of azimuth in turn, so that no single poster takes the whole budget.
std::vector<cv::KeyPoint> spread_over_azimuth(std::vector<cv::KeyPoint> points, int width_px, int budget) {
  constexpr int kSectors = 24;
  std::stable_sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.response > b.response; });
  std::vector<std::vector<cv::KeyPoint>> sectors(kSectors);
  for (const cv::KeyPoint& point : points) {
    const int sector =
        static_cast<int>((point.pt.x - kSeamPadding_px + 0.5F) * kSectors / static_cast<float>(width_px));
    sectors[static_cast<std::size_t>(std::clamp(sector, 0, kSectors - 1))].push_back(point);
  }
  std::vector<cv::KeyPoint> kept;
  for (std::size_t rank = 0; static_cast<int>(kept.size()) < budget; ++rank) {
    const std::size_t before = kept.size();
    for (const auto& sector : sectors) {
      if (rank < sector.size() && static_cast<int>(kept.size()) < budget) kept.push_back(sector[rank]);
    }
    if (kept.size() == before) break;
  }
  return kept;
}

/// Square root of the descriptor of sum 1, in 8 bits; its length is then 512 up to rounding.
void root_to_bytes(const float* descriptor, std::uint8_t* bytes) {
  float sum = 1e-6F;
  for (int d = 0; d < kDescriptorBytes; ++d) sum += descriptor[d];
  for (int d = 0; d < kDescriptorBytes; ++d) {
    bytes[d] = cv::saturate_cast<std::uint8_t>(512.0F * std::sqrt(descriptor[d] / sum));
  }
}

FeatureSet sift_features(const camera::Panorama& panorama, const FeatureConfig& config) {
  const int width_px = panorama.rgb.width_px;
  const cv::Mat grey = padded_grey(panorama.rgb);
  constexpr int kOctaveLayers = 3;
  constexpr double kEdgeThreshold = 10.0;
  constexpr double kSigma = 1.6;
  const auto sift = cv::SIFT::create(0, kOctaveLayers, config.sift_contrast_threshold, kEdgeThreshold, kSigma);
  std::vector<cv::KeyPoint> points;
  sift->detect(grey, points);
  points = spread_over_azimuth(upright(std::move(points), distance_to_border(panorama), width_px), width_px,
                               config.max_sift);
  cv::Mat descriptors;
  sift->compute(grey, points, descriptors);

  FeatureSet set;
  const auto count = static_cast<Eigen::Index>(points.size());
  set.bearings.resize(count, 3);
  set.scales_rad.resize(count);
  set.descriptors.resize(count, kDescriptorBytes);
  set.colours.resize(count, 3);
  const double px_to_rad = 2.0 * kPi / width_px;
  for (Eigen::Index i = 0; i < count; ++i) {
    const cv::KeyPoint& point = points[static_cast<std::size_t>(i)];
    const Eigen::Vector2d pixel_px(static_cast<double>(point.pt.x) - kSeamPadding_px, static_cast<double>(point.pt.y));
    set.bearings.row(i) = panorama.geometry.bearing(pixel_px).cast<float>();
    set.scales_rad[i] = static_cast<float>(static_cast<double>(point.size) * px_to_rad);
    root_to_bytes(descriptors.ptr<float>(static_cast<int>(i)), set.descriptors.row(i).data());
    const auto colour = colour_invariants(panorama.rgb, pixel_px.x(), pixel_px.y(),
                                          std::max(2.0, kPatchRadiusPerSize * static_cast<double>(point.size) * 0.5));
    set.colours.row(i) << colour[0], colour[1], colour[2];
  }
  return set;
}

}  // namespace

std::string feature_config_id(const FeatureConfig& config) {
  char text[128];
  std::snprintf(text, sizeof text, "hw1-w%d-e%.4f_%.4f-s%d-t%.4f-c%d", config.panorama_width_px,
                config.elevation_max_rad, config.elevation_min_rad, config.max_sift, config.sift_contrast_threshold,
                config.max_columns);
  return text;
}

Appearance extract(const camera::Panorama& panorama, const FeatureConfig& config) {
  Appearance appearance;
  appearance.sift = sift_features(panorama, config);
  appearance.columns.bearings.resize(0, 3);
  appearance.columns.colours.resize(0, 3);
  if (config.max_columns > 0) appearance.columns = extract_columns(panorama, config);
  appearance.colour_moments = colour_moments(panorama);
  return appearance;
}

}  // namespace homeward::features
