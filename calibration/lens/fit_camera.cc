// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/lens/fit_camera.h"

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <cmath>
#include <vector>

#include "calibration/algebra/decompositions.h"
#include "calibration/files/error.h"

namespace insitu {
namespace {

constexpr int kFitColumns = 33, kFitRows = 25;      // nodes of the fit
constexpr int kCheckColumns = 65, kCheckRows = 49;  // and of the deviation
const double kNarrowestCosine = std::cos(80 * M_PI / 180);

struct Sight {
  Eigen::Vector2d pixel;
  Eigen::Vector3d direction;
};

std::optional<std::vector<Sight>> Sights(const SightOfPixel& sight_of_pixel,
                                         const Eigen::Quaterniond& turn, int width, int height,
                                         int columns, int rows) {
  std::vector<Sight> sights;
  for (int i = 0; i < columns * rows; ++i) {
    const int column = i % columns, row = i / columns;
    const Eigen::Vector2d pixel(width * (column / (columns - 1.0)) - 0.5,
                                height * (row / (rows - 1.0)) - 0.5);
    const auto direction = sight_of_pixel(pixel);
    if (!direction || !direction->allFinite()) return std::nullopt;
    const Eigen::Vector3d turned = turn * direction->normalized();
    if (!(turned.z() > kNarrowestCosine)) return std::nullopt;
    sights.push_back({pixel, turned});
  }
  return sights;
}

// Parameters: intrinsics of `camera`, then a small turn of the axes as a rotation vector.
class ProjectionCost : public ceres::CostFunction {
 public:
  ProjectionCost(const Camera& camera, const Sight& sight) : camera_(camera), sight_(sight) {
    set_num_residuals(2);
    mutable_parameter_block_sizes()->push_back(static_cast<int>(camera.intrinsics().size()));
    mutable_parameter_block_sizes()->push_back(3);
  }
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override {
    using Jet = ceres::Jet<double, 3>;
    const Jet turn[3] = {{parameters[1][0], 0}, {parameters[1][1], 1}, {parameters[1][2], 2}};
    const Jet direction[3] = {Jet(sight_.direction[0]), Jet(sight_.direction[1]),
                              Jet(sight_.direction[2])};
    Jet turned[3];
    ceres::AngleAxisRotatePoint(turn, direction, turned);
    Eigen::Matrix<double, 2, 3> by_point;
    const auto pixel = camera_.ProjectWith(parameters[0], {turned[0].a, turned[1].a, turned[2].a},
                                           &by_point, jacobians ? jacobians[0] : nullptr);
    if (!pixel) return false;
    Eigen::Map<Eigen::Vector2d>(residuals, 2) = *pixel - sight_.pixel;
    if (jacobians && jacobians[1]) {
      Eigen::Matrix3d point_by_turn;
      for (int i = 0; i < 3; ++i) point_by_turn.row(i) = turned[i].v;
      Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> by_turn(jacobians[1]);
      by_turn = by_point * point_by_turn;
    }
    return true;
  }

 private:
  const Camera& camera_;
  const Sight& sight_;
};

// fx fy cx cy of the pinhole nearest to the lens: a straight line through pixels against tangents.
std::vector<double> StartIntrinsics(const std::vector<Sight>& sights) {
  std::vector<double> start(4);
  for (const int axis : {0, 1}) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const Sight& sight : sights) {
      const Eigen::Vector2d row(sight.direction[axis] / sight.direction.z(), 1);
      normal += row * row.transpose();
      right += row * sight.pixel[axis];
    }
    const Eigen::Vector2d line = SolveSymmetric(normal, right);
    start[axis] = line[0];
    start[2 + axis] = line[1];
  }
  return start;
}

void Deviate(const std::vector<Sight>& sights, CameraFit* fit) {
  const Eigen::Quaterniond& turn = fit->fit_from_lens;
  double sum = 0;
  for (const Sight& sight : sights) {
    const auto pixel = fit->camera.Project(turn * sight.direction);
    const double deviation =
        pixel ? (*pixel - sight.pixel).norm() : std::numeric_limits<double>::infinity();
    fit->largest_deviation_px = std::max(fit->largest_deviation_px, deviation);
    sum += deviation * deviation;
  }
  fit->rms_deviation_px = std::sqrt(sum / static_cast<double>(sights.size()));
}

// Least squares from where `intrinsics` and `turn` stand; false: no usable solution.
bool Solve(const std::string& lens_model, const std::vector<Sight>& sights, int width, int height,
           bool turn_axes, std::vector<double>* intrinsics, Eigen::Vector3d* turn) {
  intrinsics->resize(Camera::IntrinsicsCount(lens_model), 0);
  const Camera start(lens_model, *intrinsics, width, height);
  ceres::Problem problem;
  for (const Sight& sight : sights) {
    problem.AddResidualBlock(new ProjectionCost(start, sight), nullptr, intrinsics->data(),
                             turn->data());
  }
  if (!turn_axes) problem.SetParameterBlockConstant(turn->data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_QR;
  solver.max_num_iterations = 100;
  solver.function_tolerance = 1e-12;
  solver.parameter_tolerance = 1e-12;
  solver.gradient_tolerance = 1e-16;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  return summary.IsSolutionUsable() && (*intrinsics)[0] > 0 && (*intrinsics)[1] > 0;
}

// A rational polynomial finds its way best from the polynomial below it.
std::vector<std::string> Stages(const std::string& lens_model) {
  if (lens_model != "LENSMODEL_OPENCV8") return {lens_model};
  return {"LENSMODEL_OPENCV4", "LENSMODEL_OPENCV5", lens_model};
}

}  // namespace

std::optional<CameraFit> FitCamera(const SightOfPixel& sight_of_pixel, int width, int height,
                                   const FitCameraOptions& options) {
  INSITU_CHECK(width > 0 && height > 0);
  const auto sights =
      Sights(sight_of_pixel, options.start_fit_from_lens, width, height, kFitColumns, kFitRows);
  const auto checks =
      Sights(sight_of_pixel, options.start_fit_from_lens, width, height, kCheckColumns, kCheckRows);
  if (!sights || !checks) return std::nullopt;
  std::vector<double> intrinsics = StartIntrinsics(*sights);
  if (!(intrinsics[0] > 0 && intrinsics[1] > 0)) return std::nullopt;  // a mirror image
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  std::optional<CameraFit> best;
  for (const std::string& stage : Stages(options.lens_model)) {
    if (!Solve(stage, *sights, width, height, options.turn_axes, &intrinsics, &turn)) break;
    std::vector<double> padded = intrinsics;
    padded.resize(Camera::IntrinsicsCount(options.lens_model), 0);
    CameraFit fit{Camera(options.lens_model, padded, width, height)};
    if (turn.norm() > 0) fit.fit_from_lens = Eigen::AngleAxisd(turn.norm(), turn.normalized());
    Deviate(*checks, &fit);
    fit.fit_from_lens = fit.fit_from_lens * options.start_fit_from_lens;
    if (!best || fit.rms_deviation_px < best->rms_deviation_px) best = fit;
  }
  return best;
}

}  // namespace insitu
