// SPDX-License-Identifier: Apache-2.0
#include "repeat/key_gallery.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>

#include "core/index.hpp"
#include "features/descriptor_code.hpp"
#include "features/upright_sift.hpp"

namespace homeward::repeat {
namespace {

constexpr int kCodeLength = 32;

cv::Mat bytes_of(const tracking::GreyLevel& level) {
  cv::Mat grey(level.height_px, level.width_px, CV_8U);
  for (int v = 0; v < level.height_px; ++v) {
    const float* from = level.row(v);
    std::uint8_t* to = grey.ptr<std::uint8_t>(v);
    for (int u = 0; u < level.width_px; ++u) to[u] = cv::saturate_cast<std::uint8_t>(from[u]);
  }
  return grey;
}

std::vector<geometry::PointPair> pairs_of(const DescribedPicture& picture, const DescribedPicture& key, double ratio) {
  std::vector<geometry::PointPair> pairs;
  for (const DescribedMatch& match : matches_of(picture, key, ratio)) {
    pairs.push_back({picture.seen[at(match.first)], key.seen[at(match.second)]});
  }
  return pairs;
}

}  // namespace

std::vector<std::string> problems(const RecognitionConfig& config) {
  std::vector<std::string> found;
  const auto expect = [&](bool holds, const char* problem) {
    if (!holds) found.emplace_back(problem);
  };
  expect(config.most_features >= 1, "most_features is not positive");
  expect(config.contrast > 0.0, "contrast is not positive");
  expect(config.ratio > 0.0 && config.ratio <= 1.0, "ratio is not above 0, to 1");
  expect(config.most_compared >= 1, "most_compared is not positive");
  expect(config.most_verified >= 1, "most_verified is not positive");
  expect(config.fewest_agreeing >= 5, "fewest_agreeing is less than 5");
  expect(config.vouching >= config.fewest_agreeing, "vouching is less than fewest_agreeing");
  expect(config.least_agreeing >= 0.0 && config.least_agreeing <= 1.0, "least_agreeing is not 0 to 1");
  return found;
}

DescribedPicture describe(const tracking::ImagePyramid& picture, const camera::Camera& camera,
                          const RecognitionConfig& config) {
  DescribedPicture described;
  const cv::Mat grey = bytes_of(picture.levels().front());
  if (std::min(grey.cols, grey.rows) < 32) return described;
  const features::UprightSift sift(grey);
  std::vector<features::SiftPoint> points = sift.detect(config.contrast);
  std::ranges::stable_sort(points, std::ranges::greater{}, &features::SiftPoint::response);
  if (points.size() > at(config.most_features)) points.resize(at(config.most_features));
  described.descriptors.resize(static_cast<Eigen::Index>(points.size()), kCodeLength);
  std::array<float, features::UprightSift::kDescriptorLength> descriptor{};
  for (const features::SiftPoint& point : points) {
    const auto seen = seen_at(camera, {point.u_px, point.v_px});
    if (!seen) continue;
    sift.describe(point, descriptor.data());
    features::encode_sift(descriptor,
                          {described.descriptors.row(static_cast<Eigen::Index>(described.seen.size())).data(),
                           static_cast<std::size_t>(kCodeLength)});
    described.seen.push_back(*seen);
  }
  described.descriptors.conservativeResize(static_cast<Eigen::Index>(described.seen.size()), kCodeLength);
  return described;
}

std::vector<DescribedMatch> matches_of(const DescribedPicture& first, const DescribedPicture& second, double ratio) {
  std::vector<DescribedMatch> matches;
  if (first.seen.empty() || second.seen.empty()) return matches;
  const auto nearest = matching::find_nearest(first.descriptors, second.descriptors);
  for (std::size_t i = 0; i < first.seen.size(); ++i) {
    const std::int32_t j = nearest.of_current[i];
    if (nearest.of_target[at(j)] != static_cast<std::int32_t>(i)) continue;
    if (nearest.distance[i] >= ratio * ratio * nearest.second_distance[i]) continue;
    matches.push_back({static_cast<int>(i), static_cast<int>(j), static_cast<int>(nearest.distance[i])});
  }
  return matches;
}

std::vector<RecognisedKey> KeyGallery::recognise(const DescribedPicture& picture, std::span<const int> keys,
                                                 const RecognitionConfig& config,
                                                 const geometry::TwoViewConfig& geometry, std::uint64_t seed) const {
  struct Compared {
    int key = 0;
    std::vector<geometry::PointPair> pairs;
  };
  std::vector<Compared> compared;
  for (const int key : keys) {
    compared.push_back({key, pairs_of(picture, keys_[at(key)], config.ratio)});
  }
  std::ranges::stable_sort(compared, std::ranges::greater{}, [](const Compared& one) { return one.pairs.size(); });
  if (compared.size() > at(config.most_verified)) compared.resize(at(config.most_verified));
  std::vector<RecognisedKey> found;
  for (const Compared& one : compared) {
    if (one.pairs.size() < at(config.fewest_agreeing)) break;
    auto estimate = geometry::estimate_two_view(one.pairs, geometry, seed);
    if (!estimate) continue;
    const double least =
        std::max<double>(config.fewest_agreeing, config.least_agreeing * static_cast<double>(one.pairs.size()));
    if (static_cast<double>(estimate->inliers.size()) >= least) found.push_back({one.key, *std::move(estimate)});
  }
  std::ranges::stable_sort(found, std::ranges::greater{},
                           [](const RecognisedKey& one) { return one.estimate.inliers.size(); });
  return found;
}

}  // namespace homeward::repeat
