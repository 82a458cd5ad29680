// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "localisation/metric_motion.hpp"
#include "localisation/motion_model.hpp"

namespace homeward::localisation {

/// How far between two updates a robot may come without driving.
struct MoveOdds {
  double jump_probability = 0.01;         // that it was carried somewhere else in the map,
  double rolled_jump_probability = 1e-4;  // and that although odometry says that it drove
  double leave_probability = 0.02;        // that it left the mapped part
};

/// Probabilities of all places and of "not in this map"; together they sum to 1. Nearly all places of a large map are
/// as good as equally improbable: they share one number, and only those that differ are kept singly. So every step
/// costs what the places that were looked at cost, however large the map is.
/// Bayes filter: Goedemé 2007 §5.1, eq. 10-12; Ferdaus 2008, eq. 3.5 and 3.6. To keep few of the numbers is ours.
class PlaceBelief {
 public:
  /// `motion` outlives the belief.
  PlaceBelief(const MotionModel& motion, const MoveOdds& odds);

  /// Every place and "not in this map" equally probable.
  void restart();

  /// Somebody says that the robot begins at one of these places, each named once: together they get `share`, evenly,
  /// and the rest is spread evenly over every place, these too, and "not in this map". All that was believed before is
  /// forgotten. As `restart` where `places` is empty.
  void start_at(std::span<const int> places, double share);

  /// The robot may have moved. That all places are equally probable stays so: the motion is taken to bring as much to a
  /// place as it takes away.
  void predict();

  /// The same when odometry knows how far it drove. What no way on the map explains is somewhere else, in the map or
  /// not.
  void predict(const MetricMotion& motion, double driven_m);

  /// Bayes' rule. `seen`: likelihood P(z | x) of the picture at the places that were compared, each once; every other
  /// place has `floor`, and being elsewhere has `elsewhere`. A likelihood below `floor` counts as `floor`. `news`: the
  /// power that all of them are raised to, of 0 to 1, for a picture that says only in part what others did not.
  void weigh(std::span<const PlaceShare> seen, double floor, double elsewhere, double news = 1.0);

  /// Somebody says that the robot is at one of these places, each named once: `odds` multiplies the odds of that, but
  /// makes it no more probable than `most`.
  void apply_odds(std::span<const int> places, double odds, double most);

  [[nodiscard]] double of(int place) const;
  [[nodiscard]] double elsewhere() const { return elsewhere_; }
  /// The most probable places, at most `count`, equals by index. With `distinct`, only places that are more probable
  /// than those that share one number.
  [[nodiscard]] std::vector<PlaceShare> largest(std::size_t count, bool distinct = false) const;
  /// Places that are kept singly.
  [[nodiscard]] std::size_t kept() const { return excess_.size(); }

 private:
  [[nodiscard]] double total() const;
  void move(std::vector<PlaceShare> driven, double unexplained, double jump_probability);
  void normalise();
  void forget_small();

  const MotionModel* motion_;
  MoveOdds odds_;
  double common_ = 0.0;             // of each place
  std::vector<PlaceShare> excess_;  // over that, by place; never negative
  double elsewhere_ = 0.0;
};

}  // namespace homeward::localisation
