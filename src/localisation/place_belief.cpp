// SPDX-License-Identifier: Apache-2.0
#include "localisation/place_belief.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace homeward::localisation {
namespace {

constexpr std::size_t kMostKept = 512;
constexpr double kTooSmall = 1e-9;  // no decision hangs on so little

bool more_probable(const PlaceShare& a, const PlaceShare& b) {
  return a.probability != b.probability ? a.probability > b.probability : a.place < b.place;
}

double sum_of(std::span<const PlaceShare> shares) {
  double sum = 0.0;
  for (const PlaceShare& share : shares) sum += share.probability;
  return sum;
}

}  // namespace

PlaceBelief::PlaceBelief(const MotionModel& motion, const MoveOdds& odds) : motion_(&motion), odds_(odds) { restart(); }

void PlaceBelief::restart() {
  excess_.clear();
  common_ = elsewhere_ = 1.0 / (motion_->places() + 1);
}

void PlaceBelief::start_at(std::span<const int> places, double share) {
  restart();
  if (places.empty()) return;
  common_ *= 1.0 - share;
  elsewhere_ *= 1.0 - share;
  for (const int place : places) excess_.push_back({place, share / static_cast<double>(places.size())});
  std::ranges::sort(excess_, {}, &PlaceShare::place);
}

double PlaceBelief::total() const { return sum_of(excess_) + common_ * motion_->places() + elsewhere_; }

double PlaceBelief::of(int place) const {
  const auto found = std::ranges::lower_bound(excess_, place, {}, &PlaceShare::place);
  return common_ + (found != excess_.end() && found->place == place ? found->probability : 0.0);
}

void PlaceBelief::predict() {
  if (motion_->places() > 0) move(motion_->predict(excess_), 0.0, odds_.jump_probability);
}

void PlaceBelief::predict(const MetricMotion& motion, double driven_m) {
  if (motion_->places() == 0) return;
  DrivenBelief driven = motion.predict(excess_, driven_m);
  const double jump = driven_m > 0.0 ? odds_.rolled_jump_probability : odds_.jump_probability;
  move(std::move(driven.shares), driven.unexplained, jump);
}

void PlaceBelief::move(std::vector<PlaceShare> driven, double unexplained, double jump_probability) {
  const double inside = 1.0 - elsewhere_;
  const double drove = 1.0 - jump_probability - odds_.leave_probability;
  const double without_way = 0.5 * drove * unexplained;  // half of it left the mapped part
  const double evenly = jump_probability * inside + odds_.leave_probability * elsewhere_ + without_way;
  excess_ = std::move(driven);
  for (PlaceShare& share : excess_) share.probability *= drove;
  common_ = common_ * drove + evenly / motion_->places();
  elsewhere_ = elsewhere_ * (1.0 - odds_.leave_probability) + inside * odds_.leave_probability + without_way;
  forget_small();
}

void PlaceBelief::weigh(std::span<const PlaceShare> seen, double floor, double elsewhere, double news) {
  std::vector<PlaceShare> likelihoods(seen.begin(), seen.end());
  if (news < 1.0) {
    for (PlaceShare& share : likelihoods) share.probability = std::pow(std::max(floor, share.probability), news);
    floor = std::pow(floor, news);
    elsewhere = std::pow(elsewhere, news);
  }
  std::ranges::sort(likelihoods, {}, &PlaceShare::place);
  std::vector<PlaceShare> weighed;
  auto next = excess_.begin();
  const auto keep_before = [&](int place) {
    for (; next != excess_.end() && next->place < place; ++next)
      weighed.push_back({next->place, next->probability * floor});
  };
  for (const PlaceShare& likelihood : likelihoods) {
    keep_before(likelihood.place);
    double before = common_;
    if (next != excess_.end() && next->place == likelihood.place) before += (next++)->probability;
    const double after = before * std::max(floor, likelihood.probability);
    weighed.push_back({likelihood.place, after - common_ * floor});
  }
  keep_before(motion_->places());
  excess_ = std::move(weighed);
  common_ *= floor;
  elsewhere_ *= elsewhere;
  normalise();
  forget_small();
}

void PlaceBelief::apply_odds(std::span<const int> places, double odds, double most) {
  double there = 0.0;
  for (const int place : places) there += of(place);
  if (there <= 0.0 || there >= most || most >= 1.0) return;
  const double times = std::min(odds, most / (1.0 - most) * (1.0 - there) / there);
  if (times <= 1.0) return;
  for (const int place : places) {
    const double more = of(place) * (times - 1.0);
    const auto found = std::ranges::lower_bound(excess_, place, {}, &PlaceShare::place);
    if (found != excess_.end() && found->place == place) {
      found->probability += more;
    } else {
      excess_.insert(found, {place, more});
    }
  }
  normalise();
  forget_small();
}

void PlaceBelief::normalise() {
  const double sum = total();
  for (PlaceShare& share : excess_) share.probability /= sum;
  common_ /= sum;
  elsewhere_ /= sum;
}

void PlaceBelief::forget_small() {
  double least = kTooSmall;
  if (excess_.size() > kMostKept) {
    std::vector<PlaceShare> order = excess_;
    std::ranges::nth_element(order, order.begin() + kMostKept, more_probable);
    least = std::max(least, order[kMostKept].probability);
  }
  const double before = sum_of(excess_);
  std::erase_if(excess_, [&](const PlaceShare& share) { return share.probability <= least; });
  if (motion_->places() > 0) common_ += (before - sum_of(excess_)) / motion_->places();
}

std::vector<PlaceShare> PlaceBelief::largest(std::size_t count, bool distinct) const {
  std::vector<PlaceShare> result = excess_;
  for (PlaceShare& share : result) share.probability += common_;
  std::ranges::sort(result, more_probable);
  if (result.size() > count) result.resize(count);
  if (distinct) return result;
  for (int place = 0; result.size() < count && place < motion_->places(); ++place) {
    const auto found = std::ranges::lower_bound(excess_, place, {}, &PlaceShare::place);
    if (found == excess_.end() || found->place != place) result.push_back({place, common_});
  }
  return result;
}

}  // namespace homeward::localisation
