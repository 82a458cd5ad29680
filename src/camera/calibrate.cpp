// SPDX-License-Identifier: Apache-2.0
#include "camera/calibrate.hpp"

#include <cmath>
#include <numeric>

#include "camera/calibrate_fit.hpp"
#include "core/angles.hpp"
#include "core/median.hpp"

namespace homeward::camera {
namespace {

constexpr std::size_t kViewsMin = 3;
constexpr double kFarLarger = 3.0;        // a view this many times worse than the middle one is left out
constexpr double kNeverLeftOut_px = 0.6;  // below this, residuals say nothing against a view
constexpr double kCornersApartMin_px = 0.5;
constexpr double kFocalDeviationMax = 0.02;
constexpr double kNormalsApartMin_rad = 0.2;
constexpr double kCoverageMin = 0.10;

std::string shown(double value, int digits) {
  std::string text(32, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.*f", digits, value)));
  return text;
}

/// Turns the picture over: (x, y, z) becomes (x, -y, z), and so do the distortion's terms.
void turn_over(Mei& mei) {
  mei.intrinsics.fy_px = -mei.intrinsics.fy_px;
  mei.distortion[2] = -mei.distortion[2];
}

Status check(const CalibrationInput& input, const std::vector<BoardView>& views) {
  const std::vector<std::string> wrong = problems(input.board);
  if (!wrong.empty()) return fail(ErrorCode::kInvalidInput, wrong.front());
  if (input.camera.width_px < 1 || input.camera.height_px < 1) {
    return fail(ErrorCode::kInvalidInput, "The pictures must have a size.");
  }
  if (input.mirror && input.model != CalibratedModel::kMei) {
    return fail(ErrorCode::kInvalidInput, "Of the models, only mei is one of a mirror.");
  }
  const auto corners = static_cast<std::size_t>(input.board.cols) * static_cast<std::size_t>(input.board.rows);
  for (const BoardView& view : views) {
    const bool finite = std::ranges::all_of(view.corners_px, [](const Eigen::Vector2d& at) { return at.allFinite(); });
    if (view.corners_px.size() != corners || !finite) {
      return fail(ErrorCode::kInvalidInput, "A view must have one finite pixel for each corner of the board.",
                  view.name);
    }
    for (std::size_t i = 1; i < view.corners_px.size(); ++i) {
      if ((view.corners_px[i] - view.corners_px[i - 1]).norm() < kCornersApartMin_px) {
        return fail(ErrorCode::kInvalidInput, "The corners of a view must lie apart.", view.name);
      }
    }
  }
  return {};
}

tl::unexpected<Error> too_few(std::size_t usable) {
  return fail(ErrorCode::kInvalidInput, "Only " + std::to_string(usable) +
                                            " views of the board are usable; a calibration needs at least " +
                                            std::to_string(kViewsMin) + ".");
}

std::vector<BoardView> chosen(const std::vector<BoardView>& views, const std::vector<std::size_t>& indices) {
  std::vector<BoardView> own;
  own.reserve(indices.size());
  for (const std::size_t index : indices) own.push_back(views[index]);
  return own;
}

/// The largest angle between two boards' normals. A board has no front here, so at most a right angle.
double normals_apart_rad(const std::vector<BoardPose>& poses) {
  double apart_rad = 0.0;
  for (const BoardPose& one : poses) {
    for (const BoardPose& other : poses) {
      const double cosine = std::abs(one.rotation.col(2).dot(other.rotation.col(2)));
      apart_rad = std::max(apart_rad, std::acos(std::min(1.0, cosine)));
    }
  }
  return apart_rad;
}

/// Area of the convex hull of all corners (Andrew's monotone chain, 1979), as a share of the picture.
double coverage(const std::vector<BoardView>& views, const CameraConfig& camera) {
  std::vector<Eigen::Vector2d> points;
  for (const BoardView& view : views) points.insert(points.end(), view.corners_px.begin(), view.corners_px.end());
  std::ranges::sort(points, [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  });
  const auto turn = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    const Eigen::Vector2d ab = b - a;
    const Eigen::Vector2d ac = c - a;
    return ab.x() * ac.y() - ab.y() * ac.x();
  };
  double twice_area = 0.0;
  for (int side = 0; side < 2; ++side) {
    std::vector<Eigen::Vector2d> chain;
    for (const Eigen::Vector2d& point : points) {
      while (chain.size() >= 2 && turn(chain[chain.size() - 2], chain.back(), point) <= 0.0) chain.pop_back();
      chain.push_back(point);
    }
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
      twice_area += chain[i].x() * chain[i + 1].y() - chain[i + 1].x() * chain[i].y();
    }
    std::ranges::reverse(points);
  }
  return 0.5 * std::abs(twice_area) / (static_cast<double>(camera.width_px) * camera.height_px);
}

std::vector<std::string> warnings_of(const CameraFit& fit, const CalibrationInput& input,
                                     const std::vector<BoardView>& views) {
  std::vector<std::string> warnings;
  const double deviation = fit.focal_deviation;
  if (!(deviation <= kFocalDeviationMax)) {
    warnings.push_back(std::isfinite(deviation)
                           ? "The focal length is known to " + shown(100.0 * deviation, 1) +
                                 " % only: take more views, tilted in different ways and close to the camera."
                           : "The views do not determine the focal length: tilt the board in different ways.");
  }
  const double apart_rad = normals_apart_rad(fit.poses);
  if (apart_rad < kNormalsApartMin_rad) {
    warnings.push_back("All boards are nearly parallel (at most " + shown(degrees(apart_rad), 1) +
                       " degrees apart): tilt the board in different ways.");
  }
  const double covered = coverage(views, input.camera);
  if (covered < kCoverageMin) {
    warnings.push_back("The corners cover only " + shown(100.0 * covered, 0) +
                       " % of the picture: show the board in all parts of it.");
  }
  return warnings;
}

/// The view that fits far worse than the others, if there is one.
std::optional<std::size_t> misfit(const CameraFit& fit) {
  const auto worst = std::ranges::max_element(fit.view_rms_px);
  if (*worst <= std::max(kNeverLeftOut_px, kFarLarger * median(fit.view_rms_px))) return std::nullopt;
  return static_cast<std::size_t>(worst - fit.view_rms_px.begin());
}

}  // namespace

Result<CalibrationResult> calibrate(const CalibrationInput& input, const std::vector<BoardView>& views) {
  if (const Status checked = check(input, views); !checked) return pass_on(checked);
  if (views.size() < kViewsMin) return too_few(views.size());
  const auto no_fit = [] {
    return fail(ErrorCode::kInvalidInput, "No camera of this model fits the views; is the board's size right?");
  };
  const auto start = first_guess(input, views);
  if (!start) return no_fit();
  CalibrationResult result;
  std::vector<std::size_t> used;
  const std::vector<Eigen::Vector2d> board_m = corners_on_board_m(input.board);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (pose_of_board(*start, board_m, views[i].corners_px)) {
      used.push_back(i);
    } else {
      result.left_out.push_back({i, "The board cannot be placed in front of the camera."});
    }
  }
  std::optional<CameraFit> fit;
  while (true) {
    if (used.size() < kViewsMin) return too_few(used.size());
    fit = fit_camera(*start, input.board, chosen(views, used));
    if (!fit) return no_fit();
    const auto worst = misfit(*fit);
    if (!worst) break;
    result.left_out.push_back({used[*worst], "Its corners lie " + shown(fit->view_rms_px[*worst], 1) +
                                                 " px off, far more than those of the other views."});
    used.erase(used.begin() + static_cast<std::ptrdiff_t>(*worst));
  }
  result.config = input.camera;
  result.config.model = fit->model;
  if (input.mirror) turn_over(std::get<Mei>(result.config.model));
  result.rms_px = fit->rms_px;
  for (std::size_t i = 0; i < used.size(); ++i) {
    result.used.push_back({used[i], fit->view_rms_px[i], std::move(fit->predicted_px[i])});
  }
  const Eigen::VectorXd p = parameters_of(result.config.model);
  const std::vector<std::string> names = parameter_names(input.model);
  for (Eigen::Index k = 0; k < p.size(); ++k) {
    result.parameters.push_back({names[static_cast<std::size_t>(k)], p[k], fit->deviations[k]});
  }
  result.warnings = warnings_of(*fit, input, chosen(views, used));
  return result;
}

}  // namespace homeward::camera
