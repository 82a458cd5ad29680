// SPDX-License-Identifier: Apache-2.0
#include "pipeline/loop_detector.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "features/aggregate.hpp"
#include "matching/match.hpp"
#include "matching/visual_distance.hpp"
#include "pipeline/eye.hpp"

namespace homeward::pipeline {
namespace {

constexpr std::size_t kLearnAgain = 4;    // times as many pictures
constexpr std::size_t kLearnFrom = 1000;  // pictures: with so many the words are final
constexpr std::size_t kBeside = 2;        // pictures before and after the last match

}  // namespace

LoopDetector::LoopDetector(const LoopConfig& config)
    : config_(config), learn_at_(static_cast<std::size_t>(config.gap) + 1) {}

Result<LoopDetector> LoopDetector::create(const LoopConfig& config) {
  if (config.gap < 1 || config.shortlist < 1 || config.verified < 1) {
    return fail(ErrorCode::kInvalidInput, "The gap and the numbers of pictures to compare are 1 or more.",
                "loop_config");
  }
  if (config.most_kept <= config.gap) {
    return fail(ErrorCode::kInvalidInput, "More pictures have to be kept than the gap is long.", "loop_config");
  }
  if (!(config.least_score >= 0.0 && config.least_score <= 1.0)) {
    return fail(ErrorCode::kInvalidInput, "The least score is not within 0 to 1.", "loop_config");
  }
  return LoopDetector(config);
}

Status LoopDetector::learn() {
  std::vector<const features::FeatureSet*> sets;
  for (const features::Appearance& picture : seen_) sets.push_back(&picture.sift);
  auto vocabulary = features::train_vocabulary(sets, matching::kRetrievalWords, config_.seed);
  if (!vocabulary) {
    if (vocabulary.error().code == ErrorCode::kTooFewFeatures) return {};  // tried again at the next picture
    return pass_on(vocabulary);
  }
  auto index = matching::RetrievalIndex::create(std::move(*vocabulary));
  if (!index) return pass_on(index);
  index_.emplace(std::move(*index));
  for (std::size_t i = forgotten_; i + 1 < old_enough_; ++i) {
    if (Status added = remember(i); !added) return added;
  }
  learn_at_ = count() < kLearnFrom ? kLearnAgain * count() : 0;
  return {};
}

Status LoopDetector::remember(std::size_t picture) {
  if (!index_ || seen(picture).sift.size() == 0) return {};
  return index_->add(std::to_string(picture), seen(picture).sift);
}

Status LoopDetector::forget_oldest() {
  const std::string id = std::to_string(forgotten_);
  if (index_ && index_->contains(id)) {
    if (Status removed = index_->remove(id); !removed) return removed;
  }
  seen_.pop_front();
  ++forgotten_;
  return {};
}

std::vector<std::size_t> LoopDetector::shortlist() const {
  std::vector<std::size_t> pictures;
  if (!index_) return pictures;
  for (const matching::Candidate& one : index_->query(seen_.back().sift, static_cast<std::size_t>(config_.shortlist))) {
    pictures.push_back(std::stoul(one.id));
  }
  if (last_) {
    const std::size_t first = std::max(forgotten_, last_->picture - std::min(last_->picture, kBeside));
    for (std::size_t i = first; i < std::min(old_enough_, last_->picture + kBeside + 1); ++i) {
      if (std::ranges::find(pictures, i) == pictures.end()) pictures.push_back(i);
    }
  }
  return pictures;
}

std::optional<Loop> LoopDetector::best_of(const std::vector<std::size_t>& pictures) const {
  const features::Appearance& here = seen_.back();
  std::vector<std::pair<std::size_t, std::size_t>> alike;  // matches, picture
  alike.reserve(pictures.size());
  for (const std::size_t picture : pictures) {
    alike.emplace_back(matching::match(here.sift, seen(picture).sift, config_.verify.match).size(), picture);
  }
  std::ranges::sort(
      alike, [](const auto& a, const auto& b) { return a.first != b.first ? a.first > b.first : a.second < b.second; });
  alike.resize(std::min(alike.size(), static_cast<std::size_t>(config_.verified)));
  std::optional<Loop> best;
  for (const auto& [matches, picture] : alike) {
    const auto compared = matching::compare(here, seen(picture), config_.verify, config_.seed);
    if (!compared.pose) continue;
    const double score = compared.pose->confidence / (1.0 + compared.distance);
    if (score >= config_.least_score && (!best || score > best->score)) best = Loop{picture, score};
  }
  return best;
}

Result<std::optional<Loop>> LoopDetector::see(features::Appearance appearance) {
  const Eigen::Index length = appearance.sift.size() > 0 ? appearance.sift.descriptors.cols() : descriptor_length_;
  if (descriptor_length_ != 0 && length != descriptor_length_) {
    return fail(ErrorCode::kInvalidInput, "The picture's descriptors do not have the length of those before.");
  }
  descriptor_length_ = length;
  seen_.push_back(std::move(appearance));
  if (seen_.size() > static_cast<std::size_t>(config_.most_kept)) {
    if (Status forgotten = forget_oldest(); !forgotten) return pass_on(forgotten);
  }
  const auto gap = static_cast<std::size_t>(config_.gap);
  if (count() <= gap) return std::optional<Loop>();
  old_enough_ = count() - gap;
  if (learn_at_ != 0 && count() >= learn_at_) {
    if (Status learnt = learn(); !learnt) return pass_on(learnt);
  }
  if (Status added = remember(old_enough_ - 1); !added) return pass_on(added);
  last_ = best_of(shortlist());
  return last_;
}

features::FeatureConfig loop_feature_config(const camera::Camera& camera) {
  features::FeatureConfig config = suited_feature_config(camera);
  config.panorama_width_px = config.panorama_width_px * 5 / 8;
  config.max_sift = 400;
  config.max_columns = 0;  // slow to find, and not needed to tell places
  return config;
}

}  // namespace homeward::pipeline
