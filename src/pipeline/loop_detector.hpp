// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "camera/camera.hpp"
#include "core/result.hpp"
#include "features/appearance.hpp"
#include "matching/retrieval_index.hpp"
#include "matching/verify.hpp"

namespace homeward::pipeline {

struct LoopConfig {
  int gap = 20;              // pictures by which a match is older, at least
  int shortlist = 8;         // pictures that look most alike as a whole: their features are matched
  int verified = 3;          // ... of these, with the most matches: held against one motion of the robot
  int most_kept = 20'000;    // pictures that a match may be among: the oldest are forgotten. 20 kB each
  double least_score = 0.3;  // below, nothing is said; 0 to 1
  matching::VerifyConfig verify{};
  std::uint64_t seed = 1;
};

/// An earlier picture that shows the same place.
struct Loop {
  std::size_t picture = 0;  // its number, the first picture's being 0
  double score = 0.0;       // 0 to 1, the surer and nearer the higher: not a probability
};

/// Finds, picture by picture as a robot drives, the earlier picture that shows the same place.
///
/// Pictures that are old enough are kept in a retrieval index whose visual words are learnt from the drive itself: when
/// the first picture is old enough, then each time when there are four times as many, up to a thousand. Of those that
/// look most alike as a whole, and of the neighbours of the picture that the last one was matched with, the ones with
/// the most matching features are verified by planar motion geometry. A candidate's score is
/// its confidence / (1 + D), with the visual distance D (Goedemé 2007 §4.2): pictures taken side by side share most of
/// their features, in nearly the same directions; from the other end of the same room they share few, far apart.
/// Earlier answers bring in candidates and do not change a score. Deterministic: the same pictures give the same loops.
/// The whole is ours: docs/experiments/online_loops.md.
class LoopDetector {
 public:
  /// Errors: kInvalidInput (a number below 1, no more pictures kept than the gap, a score not within 0 to 1).
  static Result<LoopDetector> create(const LoopConfig& config);

  /// The match of the next picture, if there is one. A picture without features is like none.
  /// Errors: kInvalidInput (descriptors of another length than those of the pictures before; nothing is changed).
  Result<std::optional<Loop>> see(features::Appearance appearance);

 private:
  explicit LoopDetector(const LoopConfig& config);
  Status learn();
  Status remember(std::size_t picture);
  Status forget_oldest();
  [[nodiscard]] std::size_t count() const { return forgotten_ + seen_.size(); }
  [[nodiscard]] const features::Appearance& seen(std::size_t picture) const { return seen_[picture - forgotten_]; }
  [[nodiscard]] std::vector<std::size_t> shortlist() const;
  [[nodiscard]] std::optional<Loop> best_of(const std::vector<std::size_t>& pictures) const;

  LoopConfig config_;
  std::deque<features::Appearance> seen_;          // that are kept
  std::size_t forgotten_ = 0;                      // before them
  std::size_t old_enough_ = 0;                     // so many of all, the first ones
  std::optional<matching::RetrievalIndex> index_;  // of those
  std::size_t learn_at_;                           // so many pictures seen; 0: never again
  Eigen::Index descriptor_length_ = 0;             // of the first picture with features; 0: none yet
  std::optional<Loop> last_;
};

/// Settings of features for a camera that are quick to find and enough for loops: SIFT alone, fewer of it, on a
/// panorama of five eighths of the usual width (docs/experiments/online_loops.md).
features::FeatureConfig loop_feature_config(const camera::Camera& camera);

}  // namespace homeward::pipeline
