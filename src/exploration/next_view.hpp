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
  double covers_m = 1.5;        // a picture covers what is so near to it and in sight
  double looks_m = 3.0;         // from so far the edge of the known floor is worth looking at
  double edge_worth_m = 1.0;    // so deep the floor beyond it is taken to be
  double least_gain_m2 = 0.2;   // less is not worth a way
  double enough_m2 = 2.0;       // more than that makes no view better
  double setting_out_m = 3.0;   // what the way to a view costs besides its length
  double lattice_m = 0.4;       // from one pose that is considered to the next
  double within_m = 14.0;       // of the nearest view that gains anything: farther views are left for later
  std::size_t most_views = 14;  // so many are put into an order
  double kept_m = 0.5;          // so much shorter an order has to be than the best that begins with the place driven to
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
  double cost_m = 0.0;     // of the way there
  double gain_m2 = 0.0;    // floor that it would cover, and that it may find
  bool overrules = false;  // the place driven to would still have gained something
};

/// The place that the robot drives to.
struct DrivenTo {
  Eigen::Vector2d at_m;
  int changes = 0;  // so often in a row it has been overruled by another
};

/// The first of a short way past views that gain the most together; nothing where no gain is worth a way. `given_up`:
/// cells that could not be got to, or that nobody wants to be driven to. `driven_to`: kept, where it still gains
/// anything and no other order is clearly shorter.
/// What a picture there gains: floor that the body reaches and no picture covers yet, and floor that may lie beyond the
/// edge of what is known, where the body would fit through.
/// Gain over cost: González-Baños & Latombe, Navigation strategies for exploring indoor environments (IJRR 2002); that
/// floor counts by being covered, the edge by the floor behind it, and that several views are put into an order, is
/// ours: docs/experiments/exploration.md.
std::optional<NextView> next_view(const ExploredFloor& floor, const Reach& reach, const Coverage& coverage,
                                  const std::vector<std::uint8_t>& given_up, const std::optional<DrivenTo>& driven_to,
                                  const ViewConfig& config);

}  // namespace homeward::exploration
