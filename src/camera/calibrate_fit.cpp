// SPDX-License-Identifier: Apache-2.0
#include "camera/calibrate_fit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "camera/models.hpp"
#include "core/median.hpp"

namespace homeward::camera {
namespace {

constexpr int kPoseSize = 6;
constexpr int kIntrinsicsSize = 4;
constexpr int kSteps = 200;
constexpr double kEnough = 1e-10;  // relative gain at which the fit is done
constexpr double kLargestXi = 10.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::optional<Eigen::Vector2d> project(const CameraModel& model, const Eigen::Vector3d& direction) {
  return std::visit(
      [&](const auto& own) -> std::optional<Eigen::Vector2d> {
        if constexpr (std::is_same_v<std::decay_t<decltype(own)>, Equirectangular>) {
          return std::nullopt;
        } else {
          return pixel_from_direction(own, direction.normalized());
        }
      },
      model);
}

std::optional<Eigen::Vector3d> look(const CameraModel& model, const Eigen::Vector2d& pixel_px) {
  return std::visit(
      [&](const auto& own) -> std::optional<Eigen::Vector3d> {
        if constexpr (std::is_same_v<std::decay_t<decltype(own)>, Equirectangular>) {
          return std::nullopt;
        } else {
          return direction_from_pixel(own, pixel_px);
        }
      },
      model);
}

/// The model of the same kind as `like` with these parameters; nothing when they are none of a camera.
std::optional<CameraModel> with_parameters(const CameraModel& like, const Eigen::VectorXd& p) {
  if (!p.allFinite() || !(p[0] > 0.0) || !(p[1] > 0.0)) return std::nullopt;
  const Intrinsics intrinsics{p[0], p[1], p[2], p[3]};
  if (std::holds_alternative<Pinhole>(like)) return Pinhole{intrinsics, {p[4], p[5], p[6], p[7], p[8]}};
  if (std::holds_alternative<Fisheye>(like)) return Fisheye{intrinsics, {p[4], p[5], p[6], p[7]}, {}};
  if (!(p[4] >= 0.0 && p[4] <= kLargestXi)) return std::nullopt;
  return Mei{intrinsics, p[4], {p[5], p[6], p[7], p[8]}, {}};
}

Eigen::Matrix3d turn(const Eigen::Vector3d& axis_times_angle) {
  const double angle_rad = axis_times_angle.norm();
  if (angle_rad == 0.0) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(angle_rad, axis_times_angle / angle_rad).toRotationMatrix();
}

BoardPose moved(const BoardPose& pose, const Eigen::Matrix<double, kPoseSize, 1>& step) {
  return {turn(step.head<3>()) * pose.rotation, pose.translation_m + step.tail<3>()};
}

std::optional<Eigen::VectorXd> predict(const CameraModel& model, const BoardPose& pose,
                                       const std::vector<Eigen::Vector2d>& board_m) {
  Eigen::VectorXd predicted(2 * static_cast<Eigen::Index>(board_m.size()));
  for (std::size_t i = 0; i < board_m.size(); ++i) {
    const Eigen::Vector3d at_m = pose.rotation.leftCols<2>() * board_m[i] + pose.translation_m;
    const auto pixel_px = project(model, at_m);
    if (!pixel_px) return std::nullopt;
    predicted.segment<2>(2 * static_cast<Eigen::Index>(i)) = *pixel_px;
  }
  return predicted;
}

Eigen::VectorXd stacked(const std::vector<Eigen::Vector2d>& pixels) {
  Eigen::VectorXd all(2 * static_cast<Eigen::Index>(pixels.size()));
  for (std::size_t i = 0; i < pixels.size(); ++i) all.segment<2>(2 * static_cast<Eigen::Index>(i)) = pixels[i];
  return all;
}

/// Central difference; from one side at the border of what the camera sees, nothing where neither side is seen.
Eigen::VectorXd slope(const Eigen::VectorXd& here, const std::optional<Eigen::VectorXd>& plus,
                      const std::optional<Eigen::VectorXd>& minus, double h) {
  const int sides = (plus ? 1 : 0) + (minus ? 1 : 0);
  if (sides == 0) return Eigen::VectorXd::Zero(here.size());
  return ((plus ? *plus : here) - (minus ? *minus : here)) / (sides * h);
}

/// State and normal equations of one fit.
class Fitter {
 public:
  Fitter(const CameraModel& start, const BoardGeometry& board, const std::vector<BoardView>& views)
      : model_(start), board_m_(corners_on_board_m(board)) {
    for (const BoardView& view : views) seen_px_.push_back(stacked(view.corners_px));
    for (const BoardView& view : views) {
      const auto pose = pose_of_board(start, board_m_, view.corners_px);
      if (pose) poses_.push_back(*pose);
    }
  }

  [[nodiscard]] bool posed() const { return poses_.size() == seen_px_.size() && sum_of(model_, poses_) < kInfinity; }

  /// Minimises over the first `free` parameters and all poses.
  void minimise(Eigen::Index free) {
    double damping = 1e-3;
    double sum = sum_of(model_, poses_);
    for (int step = 0; step < kSteps; ++step) {
      if (!linearise(free)) return;
      bool better = false;
      for (; damping < 1e12; damping *= 10.0) {
        std::vector<BoardPose> poses;
        const auto model = stepped(free, damping, poses);
        if (!model) continue;
        const double now = sum_of(*model, poses);
        if (!(now < sum)) continue;
        better = sum - now > kEnough * sum;
        model_ = *model;
        poses_ = std::move(poses);
        sum = now;
        damping = std::max(damping / 10.0, 1e-12);
        break;
      }
      if (!better) return;
    }
  }

  std::optional<CameraFit> result() {
    const Eigen::Index free = parameters_of(model_).size();
    if (!linearise(free)) return std::nullopt;
    CameraFit fit;
    fit.model = model_;
    fit.poses = poses_;
    double sum = 0.0;
    Eigen::Index numbers = 0;
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const auto predicted = predict(model_, poses_[i], board_m_);
      if (!predicted) return std::nullopt;
      const double own = (*predicted - seen_px_[i]).squaredNorm();
      sum += own;
      numbers += predicted->size();
      fit.view_rms_px.push_back(std::sqrt(2.0 * own / static_cast<double>(predicted->size())));
      std::vector<Eigen::Vector2d> pixels;
      for (Eigen::Index k = 0; k < predicted->size(); k += 2) pixels.emplace_back(predicted->segment<2>(k));
      fit.predicted_px.push_back(std::move(pixels));
    }
    fit.rms_px = std::sqrt(2.0 * sum / static_cast<double>(numbers));
    const Eigen::Index freedom = numbers - free - kPoseSize * static_cast<Eigen::Index>(poses_.size());
    fit.deviations = Eigen::VectorXd::Constant(free, kInfinity);
    fit.focal_deviation = kInfinity;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> split(scaled_information());
    if (freedom > 0 && split.eigenvalues()[0] > 1e-14 * split.eigenvalues()[free - 1]) {
      const Eigen::MatrixXd covariance =
          split.eigenvectors() * split.eigenvalues().cwiseInverse().asDiagonal() * split.eigenvectors().transpose();
      const double variance = sum / static_cast<double>(freedom);
      fit.focal_deviation = 0.0;
      for (Eigen::Index k = 0; k < 2; ++k) {
        // Relative change of f, or of f / (1 + xi): by itself f can grow with xi and hardly change a pixel.
        Eigen::VectorXd by = Eigen::VectorXd::Zero(free);
        const Eigen::VectorXd p = parameters_of(model_);
        by[k] = 1.0 / p[k];
        if (std::holds_alternative<Mei>(model_)) by[kIntrinsicsSize] = -1.0 / (1.0 + p[kIntrinsicsSize]);
        by = by.cwiseQuotient(scale_);
        fit.focal_deviation = std::max(fit.focal_deviation, std::sqrt(variance * by.dot(covariance * by)));
      }
      fit.deviations = (variance * covariance.diagonal()).cwiseSqrt().cwiseQuotient(scale_);
    }
    return fit;
  }

 private:
  using PoseBlock = Eigen::Matrix<double, kPoseSize, kPoseSize>;
  using PoseVector = Eigen::Matrix<double, kPoseSize, 1>;
  struct ViewBlocks {
    Eigen::MatrixXd camera_pose;
    PoseBlock pose;
    PoseVector gradient;
  };

  [[nodiscard]] double sum_of(const CameraModel& model, const std::vector<BoardPose>& poses) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const auto predicted = predict(model, poses[i], board_m_);
      if (!predicted) return kInfinity;
      sum += (*predicted - seen_px_[i]).squaredNorm();
    }
    return sum;
  }

  /// Central differences: the models stay the one place that says how a camera projects.
  bool linearise(Eigen::Index free) {
    const Eigen::VectorXd p = parameters_of(model_);
    camera_ = Eigen::MatrixXd::Zero(free, free);
    gradient_ = Eigen::VectorXd::Zero(free);
    blocks_.clear();
    for (std::size_t i = 0; i < poses_.size(); ++i) {
      const auto predicted = predict(model_, poses_[i], board_m_);
      if (!predicted) return false;
      const Eigen::VectorXd residual = seen_px_[i] - *predicted;
      Eigen::MatrixXd by_camera(residual.size(), free);
      for (Eigen::Index k = 0; k < free; ++k) {
        const double h = k < kIntrinsicsSize ? 1e-4 : 1e-6;
        Eigen::VectorXd up = p;
        Eigen::VectorXd down = p;
        up[k] += h;
        down[k] -= h;
        const auto high = with_parameters(model_, up);
        const auto low = with_parameters(model_, down);
        by_camera.col(k) = slope(*predicted, high ? predict(*high, poses_[i], board_m_) : std::nullopt,
                                 low ? predict(*low, poses_[i], board_m_) : std::nullopt, h);
      }
      Eigen::MatrixXd by_pose(residual.size(), kPoseSize);
      for (Eigen::Index k = 0; k < kPoseSize; ++k) {
        const double h = 1e-6;
        by_pose.col(k) = slope(*predicted, predict(model_, moved(poses_[i], h * PoseVector::Unit(k)), board_m_),
                               predict(model_, moved(poses_[i], -h * PoseVector::Unit(k)), board_m_), h);
      }
      camera_ += by_camera.transpose() * by_camera;
      gradient_ += by_camera.transpose() * residual;
      blocks_.push_back(
          {by_camera.transpose() * by_pose, by_pose.transpose() * by_pose, by_pose.transpose() * residual});
    }
    return camera_.allFinite();
  }

  std::optional<CameraModel> stepped(Eigen::Index free, double damping, std::vector<BoardPose>& poses) const {
    Eigen::MatrixXd reduced = camera_;
    reduced.diagonal() *= 1.0 + damping;
    Eigen::VectorXd right = gradient_;
    std::vector<PoseBlock> inverses;
    for (const ViewBlocks& view : blocks_) {
      PoseBlock block = view.pose;
      block.diagonal() *= 1.0 + damping;
      inverses.push_back(block.inverse());
      reduced -= view.camera_pose * inverses.back() * view.camera_pose.transpose();
      right -= view.camera_pose * inverses.back() * view.gradient;
    }
    const Eigen::VectorXd step = reduced.ldlt().solve(right);
    if (!step.allFinite()) return std::nullopt;
    for (std::size_t i = 0; i < blocks_.size(); ++i) {
      poses.push_back(
          moved(poses_[i], inverses[i] * (blocks_[i].gradient - blocks_[i].camera_pose.transpose() * step)));
    }
    Eigen::VectorXd p = parameters_of(model_);
    p.head(free) += step;
    return with_parameters(model_, p);
  }

  /// What the views say about the intrinsics alone, in units in which each parameter weighs the same.
  Eigen::MatrixXd scaled_information() {
    Eigen::MatrixXd information = camera_;
    for (const ViewBlocks& view : blocks_) {
      information -= view.camera_pose * view.pose.inverse() * view.camera_pose.transpose();
    }
    scale_ = camera_.diagonal().cwiseSqrt().cwiseMax(1e-12);
    const Eigen::VectorXd shrink = scale_.cwiseInverse();
    return shrink.asDiagonal() * information * shrink.asDiagonal();
  }

  CameraModel model_;
  std::vector<Eigen::Vector2d> board_m_;
  std::vector<Eigen::VectorXd> seen_px_;
  std::vector<BoardPose> poses_;
  Eigen::MatrixXd camera_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd scale_;
  std::vector<ViewBlocks> blocks_;
};

}  // namespace

Eigen::VectorXd parameters_of(const CameraModel& model) {
  std::vector<double> p;
  std::visit(
      [&p](const auto& own) {
        using Own = std::decay_t<decltype(own)>;
        if constexpr (!std::is_same_v<Own, Equirectangular>) {
          p = {own.intrinsics.fx_px, own.intrinsics.fy_px, own.intrinsics.cx_px, own.intrinsics.cy_px};
        }
        if constexpr (std::is_same_v<Own, Mei>) p.push_back(own.xi);
        if constexpr (std::is_same_v<Own, Mei> || std::is_same_v<Own, Fisheye> || std::is_same_v<Own, Pinhole>) {
          p.insert(p.end(), own.distortion.begin(), own.distortion.end());
        }
      },
      model);
  return Eigen::Map<const Eigen::VectorXd>(p.data(), static_cast<Eigen::Index>(p.size()));
}

std::vector<std::string> parameter_names(CalibratedModel model) {
  std::vector<std::string> names{"fx_px", "fy_px", "cx_px", "cy_px"};
  std::vector<std::string> rest{"k1", "k2", "p1", "p2", "k3"};
  if (model == CalibratedModel::kMei) rest = {"xi", "k1", "k2", "p1", "p2"};
  if (model == CalibratedModel::kFisheye) rest = {"k1", "k2", "k3", "k4"};
  names.insert(names.end(), rest.begin(), rest.end());
  return names;
}

std::optional<BoardPose> pose_of_board(const CameraModel& model, const std::vector<Eigen::Vector2d>& board_m,
                                       const std::vector<Eigen::Vector2d>& corners_px) {
  // Coordinates of about 1 around the board's middle keep the linear system well conditioned.
  const Eigen::Vector2d middle_m = 0.5 * (board_m.front() + board_m.back());
  const double size_m = (board_m.back() - middle_m).norm();
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  std::vector<Eigen::Vector3d> bearings;
  for (std::size_t i = 0; i < board_m.size(); ++i) {
    const auto bearing = look(model, corners_px[i]);
    if (!bearing) return std::nullopt;
    bearings.push_back(*bearing);
    const Eigen::Vector3d on_board = ((board_m[i] - middle_m) / size_m).homogeneous();
    Eigen::Matrix3d cross;
    cross << 0.0, -bearing->z(), bearing->y(), bearing->z(), 0.0, -bearing->x(), -bearing->y(), bearing->x(), 0.0;
    Eigen::Matrix<double, 3, 9> rows;
    for (Eigen::Index k = 0; k < 3; ++k) rows.middleCols<3>(3 * k) = on_board[k] * cross;
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> split(normal);
  Eigen::Matrix3d homography = Eigen::Map<const Eigen::Matrix3d>(split.eigenvectors().col(0).data());
  homography /= std::sqrt(homography.col(0).norm() * homography.col(1).norm());
  if (!homography.allFinite()) return std::nullopt;
  double ahead = 0.0;
  for (std::size_t i = 0; i < board_m.size(); ++i) {
    ahead += bearings[i].dot(homography * ((board_m[i] - middle_m) / size_m).homogeneous());
  }
  if (ahead < 0.0) homography = -homography;
  Eigen::Matrix3d axes;
  axes << homography.col(0), homography.col(1), homography.col(0).cross(homography.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  BoardPose pose;
  pose.rotation = svd.matrixU() * svd.matrixV().transpose();
  if (pose.rotation.determinant() < 0.5) return std::nullopt;
  pose.translation_m = size_m * homography.col(2) - pose.rotation.leftCols<2>() * middle_m;
  return pose;
}

std::optional<CameraModel> first_guess(const CalibrationInput& input, const std::vector<BoardView>& views) {
  const std::vector<Eigen::Vector2d> board_m = corners_on_board_m(input.board);
  const double size_px = std::max(input.camera.width_px, input.camera.height_px);
  std::optional<CameraModel> best;
  double best_px = kInfinity;
  constexpr double kGrowth = 1.12;
  for (double focal_px = 0.05 * size_px; focal_px < 6.0 * size_px; focal_px *= kGrowth) {
    const Intrinsics intrinsics{focal_px, focal_px, 0.5 * (input.camera.width_px - 1),
                                0.5 * (input.camera.height_px - 1)};
    CameraModel model = Pinhole{intrinsics, {}};
    if (input.model == CalibratedModel::kFisheye) model = Fisheye{intrinsics, {}, {}};
    if (input.model == CalibratedModel::kMei) model = Mei{intrinsics, 1.0, {}, {}};
    std::vector<double> residuals_px;
    for (const BoardView& view : views) {
      residuals_px.push_back(kInfinity);
      const auto pose = pose_of_board(model, board_m, view.corners_px);
      if (!pose) continue;
      const auto predicted = predict(model, *pose, board_m);
      if (predicted) residuals_px.back() = (*predicted - stacked(view.corners_px)).norm();
    }
    const double usual_px = median(std::move(residuals_px));
    if (usual_px < best_px) {
      best_px = usual_px;
      best = model;
    }
  }
  return best;
}

std::optional<CameraFit> fit_camera(const CameraModel& start, const BoardGeometry& board,
                                    const std::vector<BoardView>& views) {
  Fitter fitter(start, board, views);
  if (!fitter.posed()) return std::nullopt;
  const Eigen::Index all = parameters_of(start).size();
  fitter.minimise(kIntrinsicsSize);
  if (std::holds_alternative<Mei>(start)) fitter.minimise(kIntrinsicsSize + 1);
  fitter.minimise(all);
  return fitter.result();
}

}  // namespace homeward::camera
