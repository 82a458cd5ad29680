// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "geometry/correspondence.hpp"

namespace homeward::geometry {

class EpipolarError;

/// Correspondences number by number instead of match by match, for loops that the processor's vector instructions run
/// (match_row_loops.hpp). The numbers that come out do not depend on the instructions.
/// The formulas are those of motion_fit.hpp (likelihood, MLESAC) and tilted_motion.hpp (Sampson errors).
class MatchRows {
 public:
  explicit MatchRows(std::span<const Correspondence> matches);

  [[nodiscard]] std::size_t size() const { return matches_.size(); }
  [[nodiscard]] std::span<const Correspondence> matches() const { return matches_; }

  /// Signed epipolar errors of all matches, as EpipolarError gives them.
  void errors(const EpipolarError& of, std::vector<double>& into) const;

  /// The same, and for each match five slopes, one after the other.
  void errors_and_slopes(const EpipolarError& of, std::vector<double>& errors, std::vector<double>& slopes) const;

  /// What one motion with its spread and share makes of the matches. The numbers of a motion's fit, see motion_fit.cpp.
  struct Gaze {
    Eigen::Vector3d direction_in_current;
    Eigen::Vector3d direction_in_target;
    double spread_rad = 0.0;
    double share = 0.0;  // of right matches
  };

  /// Of each match.
  struct Seen {
    std::vector<double> error_rad;
    std::vector<double> chance;    // share of turns that would explain it as well; set by the caller
    std::vector<double> possible;  // 1, or 0 where the error is hopeless; set by the caller
    std::vector<double> share;     // likelihood of being right before the motion is looked at
    std::vector<double> belief;    // ... and after
    std::vector<double> gain;      // logarithm of how much likelier it is with the motion
    std::vector<double> pull;      // weight of its residual over that of a normal distribution's
    std::vector<double> telling;   // 1 less the chance
  };

  /// Fills the rest of `seen`.
  void judge(const Gaze& gaze, Seen& seen) const;

  /// The share of the turns about the vertical of either bearing of a match that would bring it within `window_rad` of
  /// the epipolar constraint: how easily a wrong match at these elevations passes. 1 near the horizon of a planar
  /// motion, where every match does; never less than `least`.
  void chances(const EpipolarError& of, double window_rad, double least, std::vector<double>& into) const;

 private:
  std::span<const Correspondence> matches_;
  // Current x, y, z, target x, y, z, logarithm of the scale ratio, odds, whether sizes are known.
  std::array<std::vector<double>, 9> rows_;
};

}  // namespace homeward::geometry
