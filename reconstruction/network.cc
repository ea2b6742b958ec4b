// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/old_network.h"

#include <ceres/solver.h>

#include <cmath>

#include "reconstruction/observation_costs.h"
#include "reconstruction/plane.h"

namespace insitu {
namespace {

constexpr double kOriginStep = 10;  // [m]

Eigen::Vector3d RoundedCentroid(const Survey& survey) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  int count = 0;
  for (const ControlPoint& point : survey.control_points) {
    if (point.role == ControlRole::kControl) mean += (point.position - mean) / ++count;
  }
  return (mean / kOriginStep).array().round() * kOriginStep;
}

NetworkPlane StartPlane(const PolygonOutline& polygon, const Network& network) {
  std::vector<Eigen::Vector3d> vertices;
  for (const std::string& name : polygon.vertices) vertices.push_back(network.points.at(name));
  Plane plane = FitPlane(vertices);
  if (plane.normal.dot(OutlineNormal(vertices)) < 0) plane.normal = -plane.normal;
  return {polygon.name, polygon.vertices, plane.normal, plane.point, 0};
}

std::optional<Eigen::Vector3d> StartDirection(const std::vector<DirectionPair>& pairs,
                                              const Network& network) {
  if (pairs.empty()) return std::nullopt;
  const auto step = [&](const DirectionPair& pair) -> Eigen::Vector3d {
    return network.points.at(pair.to) - network.points.at(pair.from);
  };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const DirectionPair& pair : pairs) sum += step(pair);
  for (const DirectionPair& pair : pairs) {
    if (step(pair).dot(sum) > 0) continue;
    throw InputError(pair.place.path, pair.place.line,
                     "the pair '" + pair.from + "' to '" + pair.to +
                         "' points away from the other pairs, expected two distinct points in the "
                         "order that the file's keys name");
  }
  return sum.normalized();
}

}  // namespace

Network MakeNetwork(const Survey& survey, const StartValues& start) {
  Network network;
  network.origin = RoundedCentroid(survey);
  for (const PosedCamera& posed : start.cameras) {
    network.poses.push_back({posed.photo, posed.camera, posed.cam_from_world.rotation,
                             Center(posed.cam_from_world) - network.origin});
  }
  for (const auto& [name, point] : start.points) {
    network.points[name] = point.position - network.origin;
  }
  for (const PolygonOutline& polygon : survey.polygons) {
    if (polygon.vertices.size() >= 4) network.planes.push_back(StartPlane(polygon, network));
  }
  network.sun = StartDirection(survey.sun_pairs, network);
  network.zenith = StartDirection(survey.zenith_pairs, network);
  return network;
}

AdjustmentProblem::AdjustmentProblem(const Survey& survey, const AdjustmentOptions& options,
                                     Network& network)
    : network_(network), problem_([] {
        ceres::Problem::Options problem_options;
        problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
        return problem_options;
      }()) {
  AddUnknowns();
  AddMarks(survey);
  AddControl(survey);
  AddPlanes(options.plane_sigma);
  if (network.sun) AddPairs(survey.sun_pairs, "sun", options.sun_sigma, &*network.sun);
  if (network.zenith) {
    AddPairs(survey.zenith_pairs, "zenith", options.zenith_sigma, &*network.zenith);
  }
}

void AdjustmentProblem::AddBlock(double* block, int size, ceres::Manifold* manifold,
                                 const Unknown& unknown) {
  problem_.AddParameterBlock(block, size, manifold);
  blocks_.push_back(block);
  column_of_block_[block] = static_cast<int>(unknown_of_column_.size());
  unknown_of_column_.resize(unknown_of_column_.size() + problem_.ParameterBlockTangentSize(block),
                            unknown);
  is_half_angle_.resize(unknown_of_column_.size(), manifold == &quaternion_manifold_);
}

void AdjustmentProblem::AddUnknowns() {
  using Kind = Unknown::Kind;
  for (NetworkPose& pose : network_.poses) {
    AddBlock(pose.cam_from_local.coeffs().data(), 4, &quaternion_manifold_,
             {Kind::kPhoto, pose.photo});
    AddBlock(pose.center.data(), 3, nullptr, {Kind::kPhoto, pose.photo});
  }
  for (auto& [name, point] : network_.points) {
    AddBlock(point.data(), 3, nullptr, {Kind::kPoint, name});
  }
  for (NetworkPlane& plane : network_.planes) {
    AddBlock(plane.normal.data(), 3, &sphere_manifold_, {Kind::kPolygon, plane.polygon});
    AddBlock(&plane.offset, 1, nullptr, {Kind::kPolygon, plane.polygon});
  }
  if (network_.sun) AddBlock(network_.sun->data(), 3, &sphere_manifold_, {Kind::kSun, "sun"});
  if (network_.zenith) {
    AddBlock(network_.zenith->data(), 3, &sphere_manifold_, {Kind::kZenith, "zenith"});
  }
}

void AdjustmentProblem::AddObservation(ceres::CostFunction* cost,
                                       const std::vector<double*>& blocks,
                                       const std::vector<ObservationResidual>& rows) {
  observations_.push_back(problem_.AddResidualBlock(cost, nullptr, blocks));
  rows_.insert(rows_.end(), rows.begin(), rows.end());
}

void AdjustmentProblem::AddMarks(const Survey& survey) {
  std::map<std::string, NetworkPose*> pose_of_photo;
  for (NetworkPose& pose : network_.poses) pose_of_photo[pose.photo] = &pose;
  for (const ImageObservation& mark : survey.observations) {
    NetworkPose& pose = *pose_of_photo.at(mark.photo);
    AddObservation(MarkCost::Create(pose.camera, mark.pixel, mark.sigma_px),
                   {pose.cam_from_local.coeffs().data(), pose.center.data(),
                    network_.points.at(mark.point).data()},
                   {{"image x", mark.photo, mark.point, mark.pixel.x(), 0, mark.sigma_px},
                    {"image y", mark.photo, mark.point, mark.pixel.y(), 0, mark.sigma_px}});
  }
}

void AdjustmentProblem::AddControl(const Survey& survey) {
  for (const ControlPoint& control : survey.control_points) {
    const auto point = network_.points.find(control.name);
    if (control.role != ControlRole::kControl || point == network_.points.end()) continue;
    std::vector<ObservationResidual> rows;
    for (int axis = 0; axis < 3; ++axis) {
      rows.push_back({std::string("control ") + "xyz"[axis], "", control.name,
                      control.position[axis], 0, control.sigma[axis]});
    }
    AddObservation(ControlCost::Create(control.position - network_.origin, control.sigma),
                   {point->second.data()}, rows);
  }
}

void AdjustmentProblem::AddPlanes(double sigma) {
  for (NetworkPlane& plane : network_.planes) {
    for (const std::string& vertex : plane.vertices) {
      AddObservation(PlaneCost::Create(plane.centroid, sigma),
                     {plane.normal.data(), &plane.offset, network_.points.at(vertex).data()},
                     {{"plane", "", plane.polygon + " " + vertex, 0, 0, sigma}});
    }
  }
}

void AdjustmentProblem::AddPairs(const std::vector<DirectionPair>& pairs, const std::string& group,
                                 double sigma, Eigen::Vector3d* direction) {
  for (const DirectionPair& pair : pairs) {
    const ObservationResidual row{group, "", pair.from + " " + pair.to, 0, 0, sigma};
    AddObservation(DirectionCost::Create(*direction, sigma),
                   {direction->data(), network_.points.at(pair.from).data(),
                    network_.points.at(pair.to).data()},
                   {row, row});
  }
}

AdjustmentProblem::Termination AdjustmentProblem::Solve() {
  ceres::Solver::Options options;
  options.logging_type = ceres::SILENT;
  options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // One thread and Eigen's own factorization: the same sums in the same order on every machine.
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-16;
  options.gradient_tolerance = 1e-16;
  options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  for (NetworkPose& pose : network_.poses) pose.cam_from_local.normalize();
  for (NetworkPlane& plane : network_.planes) plane.normal.normalize();
  if (network_.sun) network_.sun->normalize();
  if (network_.zenith) network_.zenith->normalize();
  return {summary.IsSolutionUsable(), summary.termination_type == ceres::CONVERGENCE,
          static_cast<int>(summary.iterations.size()) - 1};
}

AdjustmentProblem::Linearization AdjustmentProblem::Linearize() {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = blocks_;
  options.residual_blocks = observations_;
  std::vector<double> residuals;
  ceres::CRSMatrix crs;
  INSITU_CHECK(problem_.Evaluate(options, nullptr, &residuals, nullptr, &crs));
  Linearization result{
      rows_, Eigen::Map<Eigen::VectorXd>(residuals.data(), rows_.size()),
      Eigen::Map<const Jacobian>(crs.num_rows, crs.num_cols, crs.values.size(), crs.rows.data(),
                                 crs.cols.data(), crs.values.data())};
  for (int row = 0; row < crs.num_rows; ++row) {
    result.rows[row].residual = residuals[row] * rows_[row].sigma;
    for (Jacobian::InnerIterator entry(result.jacobian, row); entry; ++entry) {
      if (is_half_angle_[entry.col()]) entry.valueRef() /= 2;
    }
  }
  return result;
}

}  // namespace insitu
