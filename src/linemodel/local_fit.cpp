// SPDX-License-Identifier: Apache-2.0
#include "linemodel/local_fit.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/angles.hpp"

namespace homeward::linemodel {
namespace {

/// Judges poses by one picture, with one tolerance.
class PoseJudge {
 public:
  PoseJudge(PlanTracker& tracker, double tolerance_rad, double doubted_lines)
      : tracker_(tracker),
        lines_(tracker.picture_lines(), tracker.expectation().space(), with(tolerance_rad)),
        doubted_lines_(doubted_lines) {}

  [[nodiscard]] LocalFit of(const Pose2& pose) const {
    const ExpectedView view = tracker_.expected(pose);
    const auto count = static_cast<double>(view.lines.size());
    return {pose, count * lines_.log_odds(view) / (count + doubted_lines_), 0.0};
  }

 private:
  static MeasureConfig with(double tolerance_rad) {
    MeasureConfig config;
    config.tolerance_rad = tolerance_rad;
    config.around_rad = std::max(config.around_rad, 2.0 * tolerance_rad);
    return config;
  }

  PlanTracker& tracker_;
  PictureLines lines_;
  double doubted_lines_;
};

void keep_best(std::vector<LocalFit>& fits, std::size_t count) {
  std::ranges::stable_sort(fits, [](const LocalFit& a, const LocalFit& b) { return a.log_odds > b.log_odds; });
  if (fits.size() > count) fits.resize(count);
}

std::vector<LocalFit> coarse_fits(PlanTracker& tracker, const Pose2& middle, double reach_m, double reach_rad,
                                  const LocalFitConfig& config) {
  const PoseJudge judge(tracker, config.coarse_rad, config.doubted_lines);
  const int steps = static_cast<int>(std::ceil(reach_m / config.step_m));
  const int turns = static_cast<int>(std::ceil(std::min(reach_rad, kPi) / config.step_rad));
  std::vector<LocalFit> fits;
  for (int i = -steps; i <= steps; ++i) {
    for (int j = -steps; j <= steps; ++j) {
      const Eigen::Vector2d off_m(i * config.step_m, j * config.step_m);
      if (off_m.norm() > reach_m || !tracker.floor().free(position_m(middle) + off_m)) continue;
      for (int k = -turns; k <= turns; ++k) {
        const double theta_rad = wrap_angle(middle.theta_rad + k * std::min(reach_rad, kPi) / std::max(1, turns));
        fits.push_back(judge.of({middle.x_m + off_m.x(), middle.y_m + off_m.y(), theta_rad}));
      }
    }
  }
  return fits;
}

}  // namespace

LocalFit best_fit_near(PlanTracker& tracker, const Pose2& middle, double reach_m, double reach_rad,
                       const LocalFitConfig& config) {
  std::vector<LocalFit> fits = coarse_fits(tracker, middle, reach_m, reach_rad, config);
  if (fits.empty()) return {middle};
  double scale = 1.0;
  for (int halving = 0; halving < config.halvings; ++halving) {
    keep_best(fits, config.best);
    scale *= 0.5;
    const PoseJudge judge(tracker, std::max(MeasureConfig{}.tolerance_rad, scale * config.coarse_rad),
                          config.doubted_lines);
    std::vector<LocalFit> finer;
    for (const LocalFit& around : fits) {
      for (int n = 0; n < 27; ++n) {
        const int along_x = n % 3 - 1;
        const int along_y = n / 3 % 3 - 1;
        const int turns = n / 9 - 1;
        const Pose2 pose{around.pose.x_m + along_x * scale * config.step_m,
                         around.pose.y_m + along_y * scale * config.step_m,
                         wrap_angle(around.pose.theta_rad + turns * scale * config.step_rad)};
        if (n == 13 || tracker.floor().free(position_m(pose))) finer.push_back(judge.of(pose));
      }
    }
    fits = std::move(finer);
  }
  keep_best(fits, config.best);
  const auto seen = static_cast<double>(tracker.lines_above());
  for (LocalFit& fit : fits) fit.explained = seen * tracker.explained(fit.pose) / (seen + config.doubted_lines);
  return *std::ranges::max_element(fits, {}, [](const LocalFit& fit) { return fit.agreement(); });
}

}  // namespace homeward::linemodel
