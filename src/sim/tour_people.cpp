// SPDX-License-Identifier: Apache-2.0
#include "sim/tour_people.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/angles.hpp"

namespace homeward::sim {
namespace {

/// Whether a step would bring the robot near to somebody, or nearer still.
bool would_meet(const std::vector<Person>& people, const Pose2& here, const Pose2& next) {
  constexpr double kNearest_m = 0.65;  // bodies would touch at 0.59 m
  return std::ranges::any_of(people, [&](const Person& person) {
    const double then_m = std::hypot(person.x_m - next.x_m, person.y_m - next.y_m);
    return then_m < kNearest_m && then_m < std::hypot(person.x_m - here.x_m, person.y_m - here.y_m);
  });
}

/// Drives from one pose to the next while the walkers walk: seconds, waiting included; none when nobody makes room.
std::optional<double> drive_among(Walkers& walkers, const Pose2& from, const Pose2& to) {
  constexpr double kStep_s = 0.05;
  constexpr double kPatience_s = 60.0;
  const double whole_s = tour_seconds(from, to);
  const int steps = static_cast<int>(std::ceil(whole_s / kStep_s));
  const double step_s = whole_s / steps;
  const double turn_rad = wrap_angle(to.theta_rad - from.theta_rad);
  const auto after = [&](int step) {
    const double share = static_cast<double>(step) / steps;
    return Pose2{from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m),
                 from.theta_rad + share * turn_rad};
  };
  double waited_s = 0.0;
  for (int step = 0; step < steps;) {
    const Pose2 here = after(step);
    const Pose2 next = after(step + 1);
    const bool waits = would_meet(walkers.people(), here, next);
    walkers.advance(step_s, waits ? here : next);
    if (waits) {
      waited_s += step_s;
      if (waited_s > kPatience_s) return std::nullopt;
    } else {
      ++step;
    }
  }
  return whole_s + waited_s;
}

/// The moments of a tour among these walkers; none when somebody is cornered.
std::optional<std::vector<TourMoment>> drive_all(Walkers walkers, const std::vector<TourStop>& stops) {
  std::vector<TourMoment> moments;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    double seconds = 0.0;
    if (i > 0) {
      const auto took_s = drive_among(walkers, stops[i - 1].pose, stops[i].pose);
      if (!took_s) return std::nullopt;
      seconds = *took_s;
    }
    moments.push_back({seconds, walkers.people()});
  }
  return moments;
}

}  // namespace

double tour_seconds(const Pose2& from, const Pose2& to) {
  constexpr double kSpeed_mps = 0.5;
  constexpr double kTurn_radps = 0.8;
  const double seconds = std::max(std::hypot(to.x_m - from.x_m, to.y_m - from.y_m) / kSpeed_mps,
                                  std::abs(wrap_angle(to.theta_rad - from.theta_rad)) / kTurn_radps);
  return std::max(0.1, seconds);
}

Result<std::vector<TourMoment>> people_along(const World& world, const std::vector<TourStop>& stops, int count,
                                             std::uint64_t seed) {
  if (stops.empty()) return std::vector<TourMoment>{};
  constexpr std::uint64_t kDraws = 20;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    const std::uint64_t draw_seed = seed * 1'000'003 + draw;
    if (auto moments = drive_all(Walkers(world, count, draw_seed, stops.front().pose), stops)) {
      return std::move(*moments);
    }
  }
  return fail(
      ErrorCode::kConflict,
      "With " + std::to_string(count) +
          " people about, the tour is blocked by somebody who cannot make room. Ask for fewer, or for another seed.",
      world.name);
}

}  // namespace homeward::sim
