// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network_problem.h"

#include <ceres/dynamic_autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "calibration/error.h"
#include "reconstruction/observation_costs.h"

namespace insitu {
namespace {

using Kind = Unknown::Kind;

template <int kResiduals, int... kSizes, typename Cost>
ceres::CostFunction* AutoDiff(const Cost& cost) {
  return new ceres::AutoDiffCostFunction<Cost, kResiduals, kSizes...>(new Cost(cost));
}

std::vector<double> List(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

bool IsAdjusted(const NetworkCamera& camera) {
  return std::find(camera.is_free.begin(), camera.is_free.end(), true) != camera.is_free.end();
}

ceres::Problem::Options ProblemOptions() {
  ceres::Problem::Options options;
  options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.disable_all_safety_checks = true;  // ours are stricter, and it is linear in the marks
  return options;
}

Eigen::Vector3d UnitOf(const Network& network, const UnitReference& reference) {
  if (const auto* plane = std::get_if<PlaneNormal>(&reference)) {
    return network.planes[plane->plane].normal;
  }
  if (const auto* direction = std::get_if<DirectionUnit>(&reference)) {
    return network.directions[direction->direction].unit;
  }
  const auto& edge = std::get<EdgeUnit>(reference);
  return (network.points[edge.to].position - network.points[edge.from].position).normalized();
}

}  // namespace

NetworkProblem::NetworkProblem(Network* network) : network_(*network), problem_(ProblemOptions()) {
  AddUnknowns();
  AddObservations();
}

int NetworkProblem::AddBlock(double* block, int size, ceres::Manifold* manifold,
                             const Unknown& unknown) {
  problem_.AddParameterBlock(block, size, manifold);
  blocks_.push_back(block);
  const int column = columns_.count;
  columns_.count += problem_.ParameterBlockTangentSize(block);
  columns_.unknowns.resize(columns_.count, unknown);
  return column;
}

void NetworkProblem::AddUnknowns() {
  AddCameras();
  columns_.rotation.resize(network_.photos.size());
  columns_.center.resize(network_.photos.size());
  columns_.point.resize(network_.points.size());
  for (int i = 0; i < static_cast<int>(network_.photos.size()); ++i) {
    columns_.rotation[i] = AddBlock(Rotation(i), 4, &quaternion_manifold_, {Kind::kPhoto, i});
    if (network_.photos[i].is_center_fixed) {
      problem_.AddParameterBlock(Center(i), 3);
      problem_.SetParameterBlockConstant(Center(i));
    } else {
      columns_.center[i] = AddBlock(Center(i), 3, nullptr, {Kind::kPhoto, i});
    }
  }
  for (int i = 0; i < static_cast<int>(network_.points.size()); ++i) {
    if (network_.points[i].is_fixed) {
      problem_.AddParameterBlock(Point(i), 3);
      problem_.SetParameterBlockConstant(Point(i));
    } else {
      columns_.point[i] = AddBlock(Point(i), 3, nullptr, {Kind::kPoint, i});
    }
  }
  for (int i = 0; i < static_cast<int>(network_.planes.size()); ++i) {
    NetworkPlane& plane = network_.planes[i];
    columns_.plane.emplace_back(
        AddBlock(plane.normal.data(), 3, &sphere_manifold_, {Kind::kPlane, i}));
    AddBlock(&plane.offset, 1, nullptr, {Kind::kPlane, i});
  }
  for (int i = 0; i < static_cast<int>(network_.directions.size()); ++i) {
    double* unit = network_.directions[i].unit.data();
    columns_.direction.emplace_back();
    if (network_.directions[i].is_fixed) {
      problem_.AddParameterBlock(unit, 3);
      problem_.SetParameterBlockConstant(unit);
    } else {
      columns_.direction[i] = AddBlock(unit, 3, &sphere_manifold_, {Kind::kDirection, i});
    }
  }
}

void NetworkProblem::AddCameras() {
  columns_.camera.resize(network_.cameras.size());
  for (const NetworkCamera& camera : network_.cameras) {
    lens_parameters_.push_back(LensParameters(camera.lens));
  }
  for (int i = 0; i < static_cast<int>(network_.cameras.size()); ++i) {
    const NetworkCamera& camera = network_.cameras[i];
    if (!IsAdjusted(camera)) continue;
    const int size = static_cast<int>(lens_parameters_[i].size());
    INSITU_CHECK(static_cast<int>(camera.is_free.size()) == size);
    std::vector<int> held;
    for (int k = 0; k < size; ++k) {
      if (!camera.is_free[k]) held.push_back(k);
    }
    ceres::Manifold* manifold = nullptr;
    if (!held.empty()) manifold = &lens_manifolds_.emplace_back(size, held);
    columns_.camera[i] = AddBlock(lens_parameters_[i].data(), size, manifold, {Kind::kCamera, i});
  }
}

double* NetworkProblem::Rotation(int photo) {
  return network_.photos[photo].cam_from_local.coeffs().data();
}
double* NetworkProblem::Center(int photo) { return network_.photos[photo].center.data(); }
double* NetworkProblem::Point(int point) { return network_.points[point].position.data(); }

double* NetworkProblem::Unit(const UnitReference& reference) {
  if (const auto* plane = std::get_if<PlaneNormal>(&reference)) {
    return network_.planes[plane->plane].normal.data();
  }
  return network_.directions[std::get<DirectionUnit>(reference).direction].unit.data();
}

void NetworkProblem::AddResidual(ObservationKind kind, int index, ceres::CostFunction* cost,
                                 const std::vector<double*>& blocks,
                                 const std::vector<double>& sigmas) {
  residual_blocks_.push_back(problem_.AddResidualBlock(cost, nullptr, blocks));
  for (int component = 0; component < static_cast<int>(sigmas.size()); ++component) {
    INSITU_CHECK(sigmas[component] > 0);
    rows_.push_back({kind, index, component});
    sigmas_.push_back(sigmas[component]);
  }
}

void NetworkProblem::AddObservations() {
  AddMarks();
  AddEdges();
  AddPositions();
  AddPlanesAndDirections();
  AddConstraints();
}

void NetworkProblem::AddMarks() {
  for (int i = 0; i < static_cast<int>(network_.marks.size()); ++i) {
    const MarkObservation& mark = network_.marks[i];
    const int camera = network_.photos[mark.photo].camera;
    std::vector<double*> blocks = {Rotation(mark.photo), Center(mark.photo), Point(mark.point)};
    const bool is_adjusted = columns_.camera[camera].has_value();
    if (is_adjusted) blocks.push_back(lens_parameters_[camera].data());
    AddResidual(
        ObservationKind::kMark, i,
        new MarkCost(network_.cameras[camera].lens,
                     is_adjusted ? nullptr : &lens_parameters_[camera], mark.pixel, mark.sigma_px),
        blocks, {mark.sigma_px, mark.sigma_px});
  }
}

void NetworkProblem::AddEdges() {
  for (int i = 0; i < static_cast<int>(network_.edges.size()); ++i) {
    const EdgeObservation& edge = network_.edges[i];
    const int camera = network_.photos[edge.photo].camera;
    const auto* lens = std::get_if<Camera>(&network_.cameras[camera].lens);
    INSITU_CHECK(lens != nullptr);
    std::vector<double*> blocks = {Rotation(edge.photo), Center(edge.photo), Point(edge.from),
                                   Point(edge.to)};
    const bool is_adjusted = columns_.camera[camera].has_value();
    if (is_adjusted) blocks.push_back(lens_parameters_[camera].data());
    AddResidual(ObservationKind::kEdge, i,
                new EdgeCost(*lens, is_adjusted ? nullptr : &lens_parameters_[camera], edge.pixel,
                             edge.sigma_px),
                blocks, {edge.sigma_px});
  }
}

void NetworkProblem::AddPositions() {
  for (int i = 0; i < static_cast<int>(network_.control.size()); ++i) {
    const ControlObservation& control = network_.control[i];
    AddResidual(ObservationKind::kControl, i,
                AutoDiff<3, 3>(PositionCost{control.position, control.sigma}),
                {Point(control.point)}, List(control.sigma));
  }
  for (int i = 0; i < static_cast<int>(network_.centers.size()); ++i) {
    const CenterObservation& center = network_.centers[i];
    AddResidual(ObservationKind::kCenter, i,
                AutoDiff<3, 3>(PositionCost{center.position, center.sigma}), {Center(center.photo)},
                List(center.sigma));
  }
}

void NetworkProblem::AddPlanesAndDirections() {
  for (int i = 0; i < static_cast<int>(network_.on_planes.size()); ++i) {
    const PlaneObservation& on_plane = network_.on_planes[i];
    NetworkPlane& plane = network_.planes[on_plane.plane];
    AddResidual(ObservationKind::kPlane, i,
                AutoDiff<1, 3, 1, 3>(PlaneCost{plane.centroid, on_plane.distance, on_plane.sigma}),
                {plane.normal.data(), &plane.offset, Point(on_plane.point)}, {on_plane.sigma});
  }
  for (int i = 0; i < static_cast<int>(network_.along_directions.size()); ++i) {
    const DirectionObservation& pair = network_.along_directions[i];
    Eigen::Vector3d& unit = network_.directions[pair.direction].unit;
    AddResidual(ObservationKind::kDirection, i,
                AutoDiff<2, 3, 3, 3>(DirectionCost{AxesAcross(unit), pair.across, pair.sigma}),
                {unit.data(), Point(pair.from), Point(pair.to)}, {pair.sigma, pair.sigma});
  }
}

void NetworkProblem::AddConstraints() {
  for (int i = 0; i < static_cast<int>(network_.distances.size()); ++i) {
    const DistanceObservation& d = network_.distances[i];
    AddResidual(ObservationKind::kDistance, i, AutoDiff<1, 3, 3>(DistanceCost{d.distance, d.sigma}),
                {Point(d.from), Point(d.to)}, {d.sigma});
  }
  for (int i = 0; i < static_cast<int>(network_.heights.size()); ++i) {
    const HeightObservation& h = network_.heights[i];
    AddResidual(ObservationKind::kHeight, i, AutoDiff<1, 3, 3, 3>(HeightCost{h.height, h.sigma}),
                {network_.directions[h.direction].unit.data(), Point(h.from), Point(h.to)},
                {h.sigma});
  }
  for (int i = 0; i < static_cast<int>(network_.angles.size()); ++i) AddAngle(i);
}

void NetworkProblem::AddAngle(int index) {
  const AngleObservation& angle = network_.angles[index];
  AngleCost cost;
  cost.is_edge_first = std::holds_alternative<EdgeUnit>(angle.first);
  cost.is_edge_second = std::holds_alternative<EdgeUnit>(angle.second);
  cost.is_parallel = angle.is_parallel;
  cost.axes = AxesAcross(UnitOf(network_, angle.first));
  cost.observed = angle.departure;
  cost.sigma = angle.sigma;
  auto function =
      std::make_unique<ceres::DynamicAutoDiffCostFunction<AngleCost>>(new AngleCost(cost));
  std::vector<double*> blocks;
  for (const UnitReference* reference : {&angle.first, &angle.second}) {
    if (const auto* edge = std::get_if<EdgeUnit>(reference)) {
      blocks.insert(blocks.end(), {Point(edge->from), Point(edge->to)});
    } else {
      blocks.push_back(Unit(*reference));
    }
  }
  for (size_t i = 0; i < blocks.size(); ++i) function->AddParameterBlock(3);
  const int components = angle.is_parallel ? 2 : 1;
  function->SetNumResiduals(components);
  AddResidual(ObservationKind::kAngle, index, function.release(), blocks,
              std::vector<double>(components, angle.sigma));
}

void NetworkProblem::HoldDistance(int from, int to) {
  const double distance = (network_.points[to].position - network_.points[from].position).norm();
  problem_.AddResidualBlock(AutoDiff<1, 3, 3>(DistanceCost{distance, 1e-6 * distance}), nullptr,
                            Point(from), Point(to));
}

ceres::Solver::Summary NetworkProblem::Solve(const SolveOptions& options) {
  ceres::Solver::Options ceres_options;
  ceres_options.logging_type = ceres::SILENT;
  ceres_options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  // One thread and Eigen's own factorization: the same sums in the same order on every machine.
  ceres_options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  ceres_options.num_threads = 1;
  ceres_options.max_num_iterations = options.max_iterations;
  ceres_options.function_tolerance = 1e-16;
  ceres_options.gradient_tolerance = 1e-16;
  ceres_options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(ceres_options, &problem_, &summary);
  for (NetworkPhoto& photo : network_.photos) photo.cam_from_local.normalize();
  for (NetworkPlane& plane : network_.planes) plane.normal.normalize();
  for (NetworkDirection& direction : network_.directions) direction.unit.normalize();
  for (size_t i = 0; i < network_.cameras.size(); ++i) {
    if (!columns_.camera[i]) continue;
    network_.cameras[i].lens = WithParameters(network_.cameras[i].lens, lens_parameters_[i]);
  }
  return summary;
}

NetworkProblem::Linearization NetworkProblem::Linearize() {
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = blocks_;
  options.residual_blocks = residual_blocks_;
  std::vector<double> residuals;
  ceres::CRSMatrix crs;
  INSITU_CHECK(problem_.Evaluate(options, nullptr, &residuals, nullptr, &crs));
  Linearization result{
      Eigen::Map<Eigen::VectorXd>(residuals.data(), static_cast<Eigen::Index>(residuals.size())),
      Eigen::Map<const Jacobian>(crs.num_rows, crs.num_cols,
                                 static_cast<Eigen::Index>(crs.values.size()), crs.rows.data(),
                                 crs.cols.data(), crs.values.data())};
  std::vector<bool> is_half_angle(columns_.count, false);
  for (const auto& column : columns_.rotation) {
    for (int k = 0; k < 3; ++k) is_half_angle[*column + k] = true;
  }
  for (int row = 0; row < crs.num_rows; ++row) {
    for (Jacobian::InnerIterator entry(result.jacobian, row); entry; ++entry) {
      if (is_half_angle[entry.col()]) entry.valueRef() /= 2;
    }
  }
  return result;
}

}  // namespace insitu
