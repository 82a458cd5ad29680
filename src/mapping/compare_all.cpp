// SPDX-License-Identifier: Apache-2.0
#include "mapping/compare_all.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "mapping/parallel.hpp"

namespace homeward::mapping {
namespace {

constexpr double kFirstRoundShare = 0.75;  // of the work, roughly

}  // namespace

PairRelation relate(const features::Appearance& a, const features::Appearance& b, const matching::VerifyConfig& config,
                    std::uint64_t seed) {
  PairRelation relation;
  const matching::PairComparison comparison = matching::compare(a, b, config, seed);
  if (!comparison.pose) return relation;
  relation.distance = static_cast<float>(comparison.distance);
  relation.inliers = comparison.verified;
  relation.match_share =
      static_cast<float>(comparison.verified) / static_cast<float>(std::max(1, std::min(a.size(), b.size())));
  relation.direction_rad = static_cast<float>(comparison.pose->motion.direction_rad);
  relation.turn_rad = static_cast<float>(comparison.pose->motion.turn_rad);
  relation.parallax_rad = static_cast<float>(comparison.pose->median_parallax_rad);
  relation.confidence = static_cast<float>(comparison.pose->confidence);
  return relation;
}

Result<PairTable> compare_all(std::span<const features::Appearance> appearances, std::span<const int> tour_of,
                              const CompareConfig& config, std::uint64_t seed, int threads,
                              const std::function<void(double)>& progress, const std::stop_token& stop) {
  return compare_chosen(appearances, tour_of, config, seed, threads, progress, stop,
                        [](PairLists pairs) { return pairs; });
}

Result<PairTable> compare_chosen(std::span<const features::Appearance> appearances, std::span<const int> tour_of,
                                 const CompareConfig& config, std::uint64_t seed, int threads,
                                 const std::function<void(double)>& progress, const std::stop_token& stop,
                                 const PairFilter& chosen) {
  const std::size_t images = appearances.size();
  PairTable table(static_cast<int>(images));
  /// False if it was cancelled.
  const auto compare = [&](const PairLists& pairs, double share_before, double share) {
    std::vector<std::vector<PairRelation>> relations(images);
    const auto compare_image = [&](std::size_t b) {
      relations[b].resize(pairs[b].size());
      for (std::size_t i = 0; i < pairs[b].size() && !stop.stop_requested(); ++i) {
        const auto a = static_cast<std::size_t>(pairs[b][i]);
        relations[b][i] = relate(appearances[a], appearances[b], config.verify, seed + a * images + b);
      }
    };
    const auto report = [&](std::size_t done) {
      if (progress) progress(share_before + share * static_cast<double>(done) / static_cast<double>(images));
    };
    const bool finished = parallel_for(images, threads, compare_image, report, stop);
    if (!finished || stop.stop_requested()) return false;
    for (std::size_t b = 0; b < images; ++b) {
      for (std::size_t i = 0; i < pairs[b].size(); ++i) {
        if (relations[b][i].verified()) table.set(pairs[b][i], static_cast<int>(b), relations[b][i]);
      }
    }
    return true;
  };
  const auto cancelled = [] { return fail(ErrorCode::kCancelled, "The build was cancelled."); };
  auto candidates = first_candidates(appearances, tour_of, config.candidates, seed, threads, stop);
  if (!candidates) return pass_on(candidates);
  const PairLists first = chosen(std::move(*candidates));
  if (!compare(first, 0.0, kFirstRoundShare)) return cancelled();
  const PairLists second = chosen(second_candidates(table, first, tour_of, config.candidates));
  if (!compare(second, kFirstRoundShare, 1.0 - kFirstRoundShare)) return cancelled();
  return table;
}

}  // namespace homeward::mapping
