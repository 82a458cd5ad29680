// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "exploration/explored_floor.hpp"
#include "exploration/reach.hpp"

namespace homeward::exploration {

struct ViewConfig {
  double covers_m = 1.5;       // a picture covers what is so near to it and in sight
  double looks_m = 3.0;        // from so far the edge of the known floor is worth looking at
  double edge_worth_m = 1.0;   // so deep the floor beyond it is taken to be
  double least_gain_m2 = 0.2;  // less is not worth a way
  double enough_m2 = 0.5;      // more than that makes no place better: what is near is finished first
  double kept = 1.3;           // so much better another place has to be than the one driven to
  double lattice_m = 0.2;      // from one pose that is considered to the next
  double setting_out_m = 1.0;  // what a way costs besides its length
};

/// Which cells of the floor pictures have covered, and which were looked at from near enough that what is unknown
/// beside them will stay so.
class Coverage {
 public:
  /// A picture was taken there.
  void add(const ExploredFloor& floor, const Eigen::Vector2d& at_m, const ViewConfig& config);
  void forget() { *this = Coverage(); }
  [[nodiscard]] bool covers(const Eigen::Vector2d& at_m) const;
  [[nodiscard]] bool covers(std::size_t cell) const { return (marks_[cell] & kCovered) != 0; }
  [[nodiscard]] bool looked_at(std::size_t cell) const { return (marks_[cell] & kLookedAt) != 0; }
  /// Cells are numbered as the floor numbers them now. Nothing is lost where the floor has grown.
  void follow(const FloorFrame& frame);

 private:
  static constexpr std::uint8_t kCovered = 1;
  static constexpr std::uint8_t kLookedAt = 2;
  FloorFrame frame_;
  std::vector<std::uint8_t> marks_;
};

/// Where to take a picture next.
struct NextView {
  std::size_t cell = 0;
  Eigen::Vector2d at_m = Eigen::Vector2d::Zero();
  double cost_m = 0.0;   // of the way there
  double gain_m2 = 0.0;  // floor that it would cover, and that it may find
};

/// The place from which most is gained for the way there; nothing where no gain is worth a way. `given_up`: cells that
/// could not be got to, or that nobody wants to be driven to.
/// What a picture there gains: floor that the body reaches and no picture covers yet, and floor that may lie beyond the
/// edge of what is known, where the body would fit through.
/// Gain over cost: González-Baños & Latombe, Navigation strategies for exploring indoor environments (IJRR 2002); that
/// floor counts by being covered, and the edge by the floor behind it, is ours.
std::optional<NextView> next_view(const ExploredFloor& floor, const Reach& reach, const Coverage& coverage,
                                  const std::vector<std::uint8_t>& given_up,
                                  const std::optional<Eigen::Vector2d>& driven_to_m, const ViewConfig& config);

}  // namespace homeward::exploration
