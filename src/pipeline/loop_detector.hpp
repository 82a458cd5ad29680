// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "camera/camera.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"
#include "matching/retrieval_index.hpp"
#include "matching/verify.hpp"

namespace homeward::pipeline {

struct LoopConfig {
  int gap = 20;        // pictures by which a match is older, at least; 1 or more
  int shortlist = 16;  // pictures that look most alike as a whole: their features are matched
  int verified = 4;    // ... of these, with the most matches: held against one motion
  matching::VerifyConfig verify;
  std::uint64_t seed = 1;
};

/// An earlier picture that shows the same place.
struct Loop {
  std::size_t picture = 0;  // by its number, the first being 0
  double score = 0.0;
  int matches = 0;
  int inliers = 0;
  double distance = 0.0;
  double confidence = 0.0;
  double parallax_rad = 0.0;
  double log_scale = 0.0;
  double similarity = 0.0;
};

class LoopDetector {
 public:
  static Result<LoopDetector> create(const LoopConfig& config);

  Result<std::optional<Loop>> see(features::Appearance appearance);
  [[nodiscard]] const std::vector<Loop>& judged() const { return judged_; }

 private:
  explicit LoopDetector(const LoopConfig& config) : config_(config) {}
  Status learn();
  Status remember(std::size_t picture);
  [[nodiscard]] std::vector<std::size_t> shortlist(std::size_t old_enough) const;

  LoopConfig config_;
  std::vector<features::Appearance> seen_;
  std::optional<matching::RetrievalIndex> index_;  // of the pictures that are old enough
  std::size_t learn_at_ = 0;                       // pictures seen
  Eigen::Index descriptor_length_ = 0;             // of the first picture with features; 0: none yet
  std::optional<Loop> last_;
  std::vector<Loop> judged_;
};

/// Settings of features that are quick to find and enough for recognition.
features::FeatureConfig loop_feature_config(const camera::Camera& camera);

}  // namespace homeward::pipeline
