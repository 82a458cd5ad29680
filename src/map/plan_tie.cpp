// SPDX-License-Identifier: Apache-2.0
#include "map/plan_tie.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <unordered_map>

#include "core/angles.hpp"

namespace homeward::map {
namespace {

constexpr double kHeadingArm_m = 1.0;      // a heading weighs like a point so far ahead of the robot
constexpr double kLeastSpread_m = 0.5;     // between pins, on the plan and in the layout
constexpr double kMostScale = 10.0;        // of guessed lengths, and its inverse the least
constexpr double kMirrorResidual_m = 0.5;  // from where on pins are looked at as in a mirror
constexpr double kMirrorRatio = 3.0;       // by which the mirrored layout has to fit better

/// A pin with the pose that the layout has for its picture.
struct PinnedPose {
  std::size_t pin = 0;  // index into the pins
  std::size_t place = 0;
  Pose2 layout;
  Eigen::Vector2d position_m;
  std::optional<double> theta_rad;
};

/// plan = scale * turn * layout + shift
struct PlanFit {
  double turn_rad = 0.0;
  double scale = 1.0;
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();

  [[nodiscard]] Eigen::Vector2d turned(const Eigen::Vector2d& way) const {
    const double c = scale * std::cos(turn_rad);
    const double s = scale * std::sin(turn_rad);
    return {c * way.x() - s * way.y(), s * way.x() + c * way.y()};
  }
  [[nodiscard]] Eigen::Vector2d operator()(const Pose2& pose) const { return turned(position_m(pose)) + shift_m; }
};

/// The pins of one part of the layout.
struct PinnedPart {
  std::vector<PinnedPose> pins;
  bool measured = false;  // by odometry
};

const LaidOutImage* laid_out(const MetricLayout& layout, const ImageId& image) {
  const auto found = layout.find(image);
  return found == layout.end() ? nullptr : &found->second;
}

/// Index into map.places of the place that has a picture.
std::unordered_map<ImageId, std::size_t> places_by_image(const TopologicalMap& map) {
  std::unordered_map<ImageId, std::size_t> places;
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    places.emplace(map.places[i].prototype, i);
    for (const ImageId& member : map.places[i].members) places.emplace(member, i);
  }
  return places;
}

/// The pins whose pictures the map has, by the part of the layout in which they are.
std::map<int, PinnedPart> parts_of(const TopologicalMap& map, const MetricLayout& layout,
                                   const std::vector<PlanPin>& pins) {
  const auto places = places_by_image(map);
  std::map<int, PinnedPart> parts;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const auto place = places.find(pins[i].image);
    if (place == places.end()) continue;
    // A picture that is laid out nowhere was taken near its place's prototype.
    const LaidOutImage* found = laid_out(layout, pins[i].image);
    if (found == nullptr) found = laid_out(layout, map.places[place->second].prototype);
    if (found == nullptr) continue;
    PinnedPart& part = parts[found->component];
    part.pins.push_back({i, place->second, found->map_from_robot, pins[i].position_m, pins[i].theta_rad});
    part.measured = part.measured || found->metric;
  }
  return parts;
}

bool apart(const std::vector<PinnedPose>& pins) {
  bool on_plan = false;
  bool in_layout = false;
  for (const PinnedPose& a : pins) {
    for (const PinnedPose& b : pins) {
      on_plan = on_plan || (a.position_m - b.position_m).norm() >= kLeastSpread_m;
      in_layout = in_layout || (position_m(a.layout) - position_m(b.layout)).norm() >= kLeastSpread_m;
    }
  }
  return on_plan && in_layout;
}

bool has_heading(const std::vector<PinnedPose>& pins) {
  return std::any_of(pins.begin(), pins.end(), [](const PinnedPose& pin) { return pin.theta_rad.has_value(); });
}

/// Nothing where the pins do not say how it is turned.
std::optional<PlanFit> fitted(const PinnedPart& part) {
  const bool spread = apart(part.pins);
  if (!spread && !has_heading(part.pins)) return std::nullopt;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  Eigen::Vector2d to = Eigen::Vector2d::Zero();
  for (const PinnedPose& pin : part.pins) {
    from += position_m(pin.layout);
    to += pin.position_m;
  }
  from /= static_cast<double>(part.pins.size());
  to /= static_cast<double>(part.pins.size());
  double along = 0.0;
  double across = 0.0;
  double square = 0.0;
  for (const PinnedPose& pin : part.pins) {
    const Eigen::Vector2d p = position_m(pin.layout) - from;
    const Eigen::Vector2d q = pin.position_m - to;
    along += p.dot(q);
    across += p.x() * q.y() - p.y() * q.x();
    square += p.squaredNorm();
  }
  const double points = std::hypot(along, across);
  for (const PinnedPose& pin : part.pins) {
    if (!pin.theta_rad) continue;
    along += kHeadingArm_m * kHeadingArm_m * std::cos(*pin.theta_rad - pin.layout.theta_rad);
    across += kHeadingArm_m * kHeadingArm_m * std::sin(*pin.theta_rad - pin.layout.theta_rad);
  }
  if (std::hypot(along, across) < 1e-9) return std::nullopt;
  PlanFit fit;
  fit.turn_rad = std::atan2(across, along);
  if (!part.measured && spread) fit.scale = std::clamp(points / square, 1.0 / kMostScale, kMostScale);
  fit.shift_m = to - fit.turned(from);
  return fit;
}

double rms_m(const std::vector<PinnedPose>& pins, const PlanFit& fit) {
  double sum = 0.0;
  for (const PinnedPose& pin : pins) sum += (fit(pin.layout) - pin.position_m).squaredNorm();
  return std::sqrt(sum / static_cast<double>(pins.size()));
}

/// Whether the layout fits the pins far better as it looks in a mirror.
bool mirrored(const PinnedPart& part) {
  PinnedPart plain{part.pins, part.measured};
  for (PinnedPose& pin : plain.pins) pin.theta_rad = std::nullopt;
  PinnedPart image = plain;
  for (PinnedPose& pin : image.pins) pin.layout.y_m = -pin.layout.y_m;
  const auto fit = fitted(plain);
  const auto image_fit = fitted(image);
  if (!fit || !image_fit) return false;
  const double off_m = rms_m(plain.pins, *fit);
  return off_m > kMirrorResidual_m && off_m > kMirrorRatio * rms_m(image.pins, *image_fit);
}

/// The pose of a place by its own pin.
PlacedOnPlan by_pin(const Place& place, const LaidOutImage& prototype, const PinnedPose& pin, const PlanFit& fit) {
  const Eigen::Vector2d at = pin.position_m + fit.turned(position_m(prototype.map_from_robot) - position_m(pin.layout));
  const double turn_rad = pin.theta_rad ? *pin.theta_rad - pin.layout.theta_rad : fit.turn_rad;
  return {place.id,
          {at.x(), at.y(), wrap_angle(prototype.map_from_robot.theta_rad + turn_rad)},
          true,
          (fit(pin.layout) - pin.position_m).norm()};
}

PlacedOnPlan by_layout(const Place& place, const LaidOutImage& prototype, const PlanFit& fit) {
  const Eigen::Vector2d at = fit(prototype.map_from_robot);
  return {
      place.id, {at.x(), at.y(), wrap_angle(prototype.map_from_robot.theta_rad + fit.turn_rad)}, false, std::nullopt};
}

}  // namespace

MapOnPlan lay_on_plan(const TopologicalMap& map, const MetricLayout& layout, const std::vector<PlanPin>& pins) {
  MapOnPlan on_plan;
  const auto by_image = places_by_image(map);
  for (const PlanPin& pin : pins) {
    const auto place = by_image.find(pin.image);
    on_plan.pin_places.push_back(place == by_image.end() ? std::nullopt : std::optional(map.places[place->second].id));
  }
  std::map<int, PlanFit> fits;
  std::unordered_map<std::size_t, PinnedPose> pinned;  // by place; of several the first
  double squares = 0.0;
  std::size_t count = 0;
  for (const auto& [component, part] : parts_of(map, layout, pins)) {
    const auto fit = fitted(part);
    if (!fit) continue;
    fits.emplace(component, *fit);
    for (const PinnedPose& pin : part.pins) {
      pinned.emplace(pin.place, pin);
      squares += (fit->operator()(pin.layout) - pin.position_m).squaredNorm();
      ++count;
    }
  }
  if (count > 0) on_plan.rms_m = std::sqrt(squares / static_cast<double>(count));
  for (std::size_t i = 0; i < map.places.size(); ++i) {
    const LaidOutImage* prototype = laid_out(layout, map.places[i].prototype);
    const auto fit = prototype == nullptr ? fits.end() : fits.find(prototype->component);
    if (fit == fits.end()) {
      on_plan.unplaced.push_back(map.places[i].id);
      continue;
    }
    const auto pin = pinned.find(i);
    on_plan.places.push_back(pin == pinned.end() ? by_layout(map.places[i], *prototype, fit->second)
                                                 : by_pin(map.places[i], *prototype, pin->second, fit->second));
  }
  return on_plan;
}

Status check_pins(const TopologicalMap& map, const MetricLayout& layout, const std::vector<PlanPin>& pins,
                  const std::string& where) {
  const auto places = places_by_image(map);
  std::set<std::size_t> seen;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const std::string at = where + "/" + std::to_string(i);
    const auto place = places.find(pins[i].image);
    if (place == places.end()) {
      return fail(ErrorCode::kNotFound, "No place of the map has the picture " + pins[i].image.str() + ".", at);
    }
    if (!seen.insert(place->second).second) {
      return fail(ErrorCode::kInvalidInput, "The place " + map.places[place->second].id.str() + " has a pin already.",
                  at);
    }
  }
  if (seen.size() < 2) {
    return fail(ErrorCode::kInvalidInput, "Say of at least two places where they are on the plan.", where);
  }
  bool any = false;
  for (const auto& [component, part] : parts_of(map, layout, pins)) {
    any = any || fitted(part).has_value();
    if (mirrored(part)) {
      return fail(ErrorCode::kInvalidInput,
                  "The places lie on the plan as the map has them in a mirror: is the plan mirrored, or are two pins "
                  "swapped?",
                  where);
    }
  }
  if (!any) {
    return fail(ErrorCode::kInvalidInput,
                "Two pins have to be on one part of the map, whose places ways join, and at least half a metre apart.",
                where);
  }
  return {};
}

}  // namespace homeward::map
