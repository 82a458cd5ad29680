// SPDX-License-Identifier: Apache-2.0
#include "features/column_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>

namespace homeward::features {
namespace {

constexpr double kSameEnd_px = 2.0;  // for each column that two neighbours are apart
// Nine of ten pairs of one segment in two pictures are nearer (chi squared of ten); of one picture, the more so.
constexpr float kSameInvariants2 = 16.0F;
constexpr int kMaxGap_px = 2;        // columns from one segment of a run to the next
constexpr int kMinMembers = 3;       // what one or two columns alone show does not come again in the next picture
constexpr double kWidest_rad = 0.5;  // a run wider than this says nothing about an azimuth

/// Where the candidates of each column begin.
std::vector<std::size_t> first_of_column(const std::vector<ColumnCandidate>& candidates, int width_px) {
  std::vector<std::size_t> first(static_cast<std::size_t>(width_px) + 1, candidates.size());
  for (std::size_t i = candidates.size(); i-- > 0;) first[static_cast<std::size_t>(candidates[i].segment.u_px)] = i;
  for (std::size_t u = first.size() - 1; u-- > 0;) first[u] = std::min(first[u], first[u + 1]);
  return first;
}

bool alike(const ColumnCandidate& a, const ColumnCandidate& b, int gap_px) {
  const double bound_px = kSameEnd_px * gap_px;
  return std::abs(a.segment.top_px - b.segment.top_px) <= bound_px &&
         std::abs(a.segment.bottom_px - b.segment.bottom_px) <= bound_px &&
         squared_column_distance(a.invariants, b.invariants) <= kSameInvariants2;
}

struct Link {
  std::size_t to;
  int right_px;  // columns from here to there
};

/// The links of all candidates in one stretch of memory.
class Links {
 public:
  /// The links of each candidate, in the order in which they were found.
  Links(const std::vector<std::pair<std::size_t, Link>>& found, std::size_t candidates)
      : first_(candidates + 1, 0), all_(found.size()) {
    for (const auto& [from, link] : found) ++first_[from + 1];
    for (std::size_t i = 0; i < candidates; ++i) first_[i + 1] += first_[i];
    std::vector<std::size_t> next(first_.begin(), first_.end());
    for (const auto& [from, link] : found) all_[next[from]++] = link;
  }

  [[nodiscard]] std::span<const Link> of(std::size_t candidate) const {
    return std::span(all_).subspan(first_[candidate], first_[candidate + 1] - first_[candidate]);
  }

 private:
  std::vector<std::size_t> first_;  // of each candidate in all_, and the end
  std::vector<Link> all_;
};

/// Candidates of neighbouring columns that are alike, each link from both of its ends.
Links links_between(const std::vector<ColumnCandidate>& candidates, int width_px) {
  const std::vector<std::size_t> first = first_of_column(candidates, width_px);
  std::vector<std::pair<std::size_t, Link>> found;
  found.reserve(candidates.size() * 2 * kMaxGap_px);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    for (int gap = 1; gap <= std::min(kMaxGap_px, width_px - 1); ++gap) {
      const auto u = static_cast<std::size_t>((candidates[i].segment.u_px + gap) % width_px);
      for (std::size_t j = first[u]; j < first[u + 1]; ++j) {
        if (!alike(candidates[i], candidates[j], gap)) continue;
        found.push_back({i, {j, gap}});
        found.push_back({j, {i, -gap}});
      }
    }
  }
  return {found, candidates.size()};
}

/// One member of a run and its place to the right of the run's first one met, whatever the seam does.
struct Member {
  std::size_t index;
  int right_px;
};

/// Everything that is linked to `start`.
std::vector<Member> run_of(std::size_t start, const Links& links, std::vector<bool>& taken) {
  std::vector<Member> run = {{start, 0}};
  taken[start] = true;
  for (std::size_t next = 0; next < run.size(); ++next) {
    const Member member = run[next];
    for (const Link& link : links.of(member.index)) {
      if (taken[link.to]) continue;
      taken[link.to] = true;
      run.push_back({link.to, member.right_px + link.right_px});
    }
  }
  return run;
}

/// The member with the least sum of squared distances to all: the one nearest to their mean.
std::size_t medoid(const std::vector<Member>& run, const std::vector<ColumnCandidate>& candidates,
                   double width_of_run_px) {
  std::array<double, kColumnInvariants> mean{};
  double mean_right_px = 0.0;
  const auto count = static_cast<double>(run.size());
  for (const Member& member : run) {
    mean_right_px += member.right_px / count;
    for (std::size_t k = 0; k < mean.size(); ++k) {
      mean[k] += static_cast<double>(candidates[member.index].invariants[k]) / count;
    }
  }
  const auto cost = [&](const Member& member) {
    const double aside = (member.right_px - mean_right_px) / (0.5 * width_of_run_px);
    double sum = aside * aside * kColumnInvariants;  // as much as all of the invariants, at the ends of the run
    for (std::size_t k = 0; k < mean.size(); ++k) {
      const double difference = (static_cast<double>(candidates[member.index].invariants[k]) - mean[k]) /
                                static_cast<double>(kColumnSpread[k]);
      sum += difference * difference;
    }
    return std::tuple(sum, member.right_px);
  };
  return std::ranges::min_element(run, {}, cost)->index;
}

}  // namespace

float squared_column_distance(const ColumnInvariants& a, const ColumnInvariants& b) {
  float sum = 0.0F;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const float difference = (a[k] - b[k]) / kColumnSpread[k];
    sum += difference * difference;
  }
  return sum;
}

std::vector<ColumnCandidate> one_of_each_run(const std::vector<ColumnCandidate>& candidates, int width_px) {
  const Links links = links_between(candidates, width_px);
  std::vector<ColumnCandidate> prototypes;
  std::vector<bool> taken(candidates.size(), false);
  const double widest_px = kWidest_rad * width_px / (2.0 * std::numbers::pi);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (taken[i]) continue;
    const std::vector<Member> run = run_of(i, links, taken);
    if (static_cast<int>(run.size()) < kMinMembers) continue;
    const auto [left, right] = std::ranges::minmax(run, {}, &Member::right_px);
    const int width_of_run_px = right.right_px - left.right_px + 1;
    if (width_of_run_px > widest_px) continue;
    prototypes.push_back(candidates[medoid(run, candidates, width_of_run_px)]);
  }
  return prototypes;
}

}  // namespace homeward::features
