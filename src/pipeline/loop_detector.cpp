// SPDX-License-Identifier: Apache-2.0
#include "pipeline/loop_detector.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "features/aggregate.hpp"
#include "matching/match.hpp"
#include "matching/visual_distance.hpp"
#include "pipeline/eye.hpp"

namespace homeward::pipeline {
namespace {

constexpr std::size_t kLearnAgain = 4;    // times as many pictures
constexpr std::size_t kLearnFrom = 1000;  // pictures, at most
constexpr std::size_t kBeside = 2;        // pictures before and after the last match

}  // namespace

Result<LoopDetector> LoopDetector::create(const LoopConfig& config) {
  if (config.gap < 1 || config.shortlist < 1 || config.verified < 1) {
    return fail(ErrorCode::kInvalidInput, "A match is one picture older or more, and one or more are compared.",
                "loop_config");
  }
  LoopDetector detector(config);
  detector.learn_at_ = static_cast<std::size_t>(config.gap) + 1;
  return detector;
}

Status LoopDetector::learn() {
  std::vector<const features::FeatureSet*> sets;
  const std::size_t step = 1 + (seen_.size() - 1) / kLearnFrom;
  for (std::size_t i = 0; i < seen_.size(); i += step) sets.push_back(&seen_[i].sift);
  auto vocabulary = features::train_vocabulary(sets, matching::kRetrievalWords, config_.seed);
  if (!vocabulary) {
    if (vocabulary.error().code == ErrorCode::kTooFewFeatures) return {};  // again at the next picture
    return pass_on(vocabulary);
  }
  auto index = matching::RetrievalIndex::create(std::move(*vocabulary));
  if (!index) return pass_on(index);
  index_.emplace(std::move(*index));
  const std::size_t old_enough = seen_.size() - static_cast<std::size_t>(config_.gap);
  for (std::size_t i = 0; i + 1 < old_enough; ++i) {
    if (Status added = remember(i); !added) return added;
  }
  learn_at_ = seen_.size() < kLearnFrom ? kLearnAgain * seen_.size() : 0;
  return {};
}

Status LoopDetector::remember(std::size_t picture) {
  // A picture without features is like none.
  if (!index_ || seen_[picture].sift.size() == 0) return {};
  return index_->add(std::to_string(picture), seen_[picture].sift);
}

std::vector<std::size_t> LoopDetector::shortlist(std::size_t old_enough) const {
  std::vector<std::size_t> pictures;
  if (!index_) return pictures;
  for (const matching::Candidate& one : index_->query(seen_.back().sift, static_cast<std::size_t>(config_.shortlist))) {
    pictures.push_back(std::stoul(one.id));
  }
  if (last_) {
    const std::size_t first = last_->picture - std::min(last_->picture, kBeside);
    for (std::size_t i = first; i < std::min(old_enough, last_->picture + kBeside + 1); ++i) {
      if (std::ranges::find(pictures, i) == pictures.end()) pictures.push_back(i);
    }
  }
  return pictures;
}

Result<std::optional<Loop>> LoopDetector::see(features::Appearance appearance) {
  const Eigen::Index length = appearance.sift.size() > 0 ? appearance.sift.descriptors.cols() : 0;
  if (length != 0 && descriptor_length_ != 0 && length != descriptor_length_) {
    return fail(ErrorCode::kInvalidInput, "The picture's descriptors do not have the length of those before.");
  }
  if (length != 0) descriptor_length_ = length;
  seen_.push_back(std::move(appearance));
  judged_.clear();
  const auto gap = static_cast<std::size_t>(config_.gap);
  if (seen_.size() <= gap) return std::optional<Loop>();
  const std::size_t old_enough = seen_.size() - gap;
  if (learn_at_ != 0 && seen_.size() >= learn_at_) {
    if (Status learnt = learn(); !learnt) return pass_on(learnt);
  }
  if (Status added = remember(old_enough - 1); !added) return pass_on(added);

  const features::Appearance& here = seen_.back();
  std::vector<std::pair<std::size_t, std::size_t>> alike;  // matches, picture
  for (const std::size_t picture : shortlist(old_enough)) {
    alike.emplace_back(matching::match(here.sift, seen_[picture].sift, config_.verify.match).size(), picture);
  }
  std::ranges::sort(
      alike, [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  alike.resize(std::min(alike.size(), static_cast<std::size_t>(config_.verified)));
  std::optional<Loop> best;
  for (const auto& [matches, picture] : alike) {
    const auto compared = matching::compare(here, seen_[picture], config_.verify, config_.seed);
    if (!compared.pose) continue;
    Loop loop;
    loop.picture = picture;
    loop.matches = compared.matches;
    loop.inliers = compared.verified;
    loop.distance = compared.distance;
    loop.confidence = compared.pose->confidence;
    loop.parallax_rad = compared.pose->median_parallax_rad;
    loop.score = loop.confidence / (1.0 + compared.distance);
    judged_.push_back(loop);
    if (!best || loop.score > best->score) best = loop;
  }
  last_ = best;
  return best;
}

features::FeatureConfig loop_feature_config(const camera::Camera& camera) {
  features::FeatureConfig config = suited_feature_config(camera);
  config.panorama_width_px = config.panorama_width_px * 3 / 4;
  config.max_sift = 400;
  config.max_columns = 0;
  return config;
}

}  // namespace homeward::pipeline
