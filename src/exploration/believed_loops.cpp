// SPDX-License-Identifier: Apache-2.0
#include "exploration/believed_loops.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace homeward::exploration {
namespace {

constexpr double kWrong = 8.0;  // spreads

std::vector<PoseLink> with_loops(const std::vector<PoseLink>& steps, const std::vector<PoseLink>& loops,
                                 const std::vector<std::uint8_t>& which) {
  std::vector<PoseLink> links = steps;
  for (std::size_t i = 0; i < loops.size(); ++i)
    if (which[i] != 0) links.push_back(loops[i]);
  return links;
}

/// Settles by the loops of `which`, and leaves those that do not fit.
SettledLoops settled(std::vector<Pose2> poses, const std::vector<PoseLink>& steps, const std::vector<PoseLink>& loops,
                     std::vector<std::uint8_t> which) {
  settle(poses, with_loops(steps, loops, which));
  bool any_wrong = false;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (which[i] == 0 || strain(poses, loops[i]) < kWrong) continue;
    which[i] = 0;
    any_wrong = true;
  }
  if (any_wrong) settle(poses, with_loops(steps, loops, which));
  return {std::move(poses), std::move(which)};
}

/// What `settle` makes least, of the steps and of these loops.
double cost(const std::vector<Pose2>& poses, const std::vector<PoseLink>& links) {
  double sum = 0.0;
  for (const PoseLink& link : links) {
    const double off = strain(poses, link);
    sum += link.loop ? std::log1p(off * off) : off * off;
  }
  return sum;
}

}  // namespace

SettledLoops settle_loops(std::vector<Pose2> poses, const std::vector<PoseLink>& steps,
                          const std::vector<PoseLink>& loops, std::vector<std::uint8_t> believed, int since) {
  constexpr int kLeastDisputed = 3;
  SettledLoops first = settled(std::move(poses), steps, loops, std::move(believed));
  std::vector<std::uint8_t> weighed = first.believed;
  int disputed = 0;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (weighed[i] != 0 || loops[i].b < since) continue;
    weighed[i] = 1;
    ++disputed;
  }
  if (disputed < kLeastDisputed) return first;
  const std::vector<PoseLink> all = with_loops(steps, loops, weighed);
  double looseness = 1.0;
  for (const PoseLink& link : all) looseness = std::max(looseness, strain(first.poses, link));
  constexpr double kLoosest = 1e6;  // a pose that is no number must not loosen for ever
  looseness = std::min(looseness, kLoosest);
  std::vector<Pose2> anew = first.poses;
  for (; looseness > 1.0; looseness /= 2.0) settle(anew, all, looseness);
  SettledLoops second = settled(std::move(anew), steps, loops, std::move(weighed));
  return cost(second.poses, all) < cost(first.poses, all) ? second : first;
}

}  // namespace homeward::exploration
