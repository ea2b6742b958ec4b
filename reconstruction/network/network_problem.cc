// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/network/network_problem.h"

#include <ceres/dynamic_autodiff_cost_function.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "calibration/files/error.h"
#include "reconstruction/network/observation_costs.h"

namespace insitu {
namespace {

using Kind = Unknown::Kind;

constexpr int kMaxIterations = 100;

template <int kResiduals, int... kSizes, typename Cost>
ceres::CostFunction* AutoDiff(const Cost& cost) {
  return new ceres::AutoDiffCostFunction<Cost, kResiduals, kSizes...>(new Cost(cost));
}

std::vector<double> List(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

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

NetworkProblem::NetworkProblem(Network* network)
    : network_(*network), values_(network), problem_(ProblemOptions()) {
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

void NetworkProblem::AddCameras() {
  columns_.camera.resize(network_.cameras.size());
  for (int i = 0; i < static_cast<int>(network_.cameras.size()); ++i) {
    const NetworkCamera& camera = network_.cameras[i];
    if (!IsAdjusted(camera)) continue;
    const int size = static_cast<int>(values_.Lens(i).size());
    INSITU_CHECK(static_cast<int>(camera.is_free.size()) == size);
    std::vector<int> held;
    for (int k = 0; k < size; ++k) {
      if (!camera.is_free[k]) held.push_back(k);
    }
    ceres::Manifold* manifold = nullptr;
    if (!held.empty()) manifold = &lens_manifolds_.emplace_back(size, held);
    columns_.camera[i] = AddBlock(values_.Lens(i).data(), size, manifold, {Kind::kCamera, i});
  }
}

void NetworkProblem::AddUnknowns() {
  AddCameras();
  columns_.rotation.resize(network_.photos.size());
  columns_.center.resize(network_.photos.size());
  columns_.point.resize(network_.points.size());
  for (int i = 0; i < static_cast<int>(network_.photos.size()); ++i) {
    columns_.rotation[i] =
        AddBlock(values_.Rotation(i), 4, &quaternion_manifold_, {Kind::kPhoto, i});
    if (network_.photos[i].is_center_fixed) {
      problem_.AddParameterBlock(values_.Center(i), 3);
      problem_.SetParameterBlockConstant(values_.Center(i));
    } else {
      columns_.center[i] = AddBlock(values_.Center(i), 3, nullptr, {Kind::kPhoto, i});
    }
  }
  for (int i = 0; i < static_cast<int>(network_.points.size()); ++i) {
    if (network_.points[i].is_fixed) {
      problem_.AddParameterBlock(values_.Point(i), 3);
      problem_.SetParameterBlockConstant(values_.Point(i));
    } else {
      columns_.point[i] = AddBlock(values_.Point(i), 3, nullptr, {Kind::kPoint, i});
    }
  }
  for (int i = 0; i < static_cast<int>(network_.planes.size()); ++i) {
    columns_.plane.emplace_back(
        AddBlock(values_.Normal(i), 3, &sphere_manifold_, {Kind::kPlane, i}));
    AddBlock(values_.Offset(i), 1, nullptr, {Kind::kPlane, i});
  }
  for (int i = 0; i < static_cast<int>(network_.directions.size()); ++i) {
    double* unit = values_.Unit(i);
    columns_.direction.emplace_back();
    if (network_.directions[i].is_fixed) {
      problem_.AddParameterBlock(unit, 3);
      problem_.SetParameterBlockConstant(unit);
    } else {
      columns_.direction[i] = AddBlock(unit, 3, &sphere_manifold_, {Kind::kDirection, i});
    }
  }
}

void NetworkProblem::AddResidual(ObservationRow::Kind kind, int index, ceres::CostFunction* cost,
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
  AddLenses();
  AddPlanesAndDirections();
  AddConstraints();
}

void NetworkProblem::AddMarks() {
  const double tie_factor = std::sqrt(network_.tie_mark_inflation.value_or(1));
  for (int i = 0; i < static_cast<int>(network_.marks.size()); ++i) {
    const MarkObservation& mark = network_.marks[i];
    const int camera = network_.photos[mark.photo].camera;
    std::vector<double*> blocks = {values_.Rotation(mark.photo), values_.Center(mark.photo),
                                   values_.Point(mark.point)};
    const bool is_adjusted = columns_.camera[camera].has_value();
    if (is_adjusted) blocks.push_back(values_.Lens(camera).data());
    const double sigma_px =
        mark.sigma_px * (network_.points[mark.point].is_tie_point ? tie_factor : 1);
    AddResidual(ObservationRow::Kind::kMark, i,
                new MarkCost(network_.cameras[camera].lens,
                             is_adjusted ? nullptr : &values_.Lens(camera), mark.pixel, sigma_px),
                blocks, {sigma_px, sigma_px});
  }
}

void NetworkProblem::AddEdges() {
  for (int i = 0; i < static_cast<int>(network_.edges.size()); ++i) {
    const EdgeObservation& edge = network_.edges[i];
    const int camera = network_.photos[edge.photo].camera;
    const auto* lens = std::get_if<Camera>(&network_.cameras[camera].lens);
    INSITU_CHECK(lens != nullptr);
    std::vector<double*> blocks = {values_.Rotation(edge.photo), values_.Center(edge.photo),
                                   values_.Point(edge.from), values_.Point(edge.to)};
    const bool is_adjusted = columns_.camera[camera].has_value();
    if (is_adjusted) blocks.push_back(values_.Lens(camera).data());
    AddResidual(ObservationRow::Kind::kEdge, i,
                new EdgeCost(*lens, is_adjusted ? nullptr : &values_.Lens(camera), edge.pixel,
                             edge.sigma_px),
                blocks, {edge.sigma_px});
  }
}

void NetworkProblem::AddPositions() {
  for (int i = 0; i < static_cast<int>(network_.control.size()); ++i) {
    const ControlObservation& control = network_.control[i];
    AddResidual(ObservationRow::Kind::kControl, i,
                AutoDiff<3, 3>(PositionCost{control.position, control.sigma}),
                {values_.Point(control.point)}, List(control.sigma));
  }
  for (int i = 0; i < static_cast<int>(network_.centers.size()); ++i) {
    const CenterObservation& center = network_.centers[i];
    if (!center.arm.isZero()) {
      AddResidual(ObservationRow::Kind::kCenter, i,
                  AutoDiff<3, 4, 3>(AntennaCost{{center.position, center.sigma}, center.arm}),
                  {values_.Rotation(center.photo), values_.Center(center.photo)},
                  List(center.sigma));
      continue;
    }
    AddResidual(ObservationRow::Kind::kCenter, i,
                AutoDiff<3, 3>(PositionCost{center.position, center.sigma}),
                {values_.Center(center.photo)}, List(center.sigma));
  }
}

void NetworkProblem::AddLenses() {
  for (int i = 0; i < static_cast<int>(network_.lenses.size()); ++i) {
    const LensObservation& lens = network_.lenses[i];
    if (!columns_.camera[lens.camera]) continue;
    ceres::CostFunction* cost = LensCost(lens, network_.cameras[lens.camera].is_free);
    AddResidual(ObservationRow::Kind::kLens, i, cost, {values_.Lens(lens.camera).data()},
                std::vector<double>(static_cast<size_t>(cost->num_residuals()), 1.0));
  }
}

void NetworkProblem::AddPlanesAndDirections() {
  for (int i = 0; i < static_cast<int>(network_.on_planes.size()); ++i) {
    const PlaneObservation& on_plane = network_.on_planes[i];
    const NetworkPlane& plane = network_.planes[on_plane.plane];
    AddResidual(ObservationRow::Kind::kPlane, i,
                AutoDiff<1, 3, 1, 3>(PlaneCost{plane.centroid, on_plane.distance, on_plane.sigma}),
                {values_.Normal(on_plane.plane), values_.Offset(on_plane.plane),
                 values_.Point(on_plane.point)},
                {on_plane.sigma});
  }
  for (int i = 0; i < static_cast<int>(network_.along_directions.size()); ++i) {
    const DirectionObservation& pair = network_.along_directions[i];
    const Eigen::Vector3d& unit = network_.directions[pair.direction].unit;
    AddResidual(ObservationRow::Kind::kDirection, i,
                AutoDiff<2, 3, 3, 3>(DirectionCost{AxesAcross(unit), pair.across, pair.sigma}),
                {values_.Unit(pair.direction), values_.Point(pair.from), values_.Point(pair.to)},
                {pair.sigma, pair.sigma});
  }
}

void NetworkProblem::AddConstraints() {
  for (int i = 0; i < static_cast<int>(network_.distances.size()); ++i) {
    const DistanceObservation& d = network_.distances[i];
    AddResidual(ObservationRow::Kind::kDistance, i,
                AutoDiff<1, 3, 3>(DistanceCost{d.distance, d.sigma}),
                {values_.Point(d.from), values_.Point(d.to)}, {d.sigma});
  }
  for (int i = 0; i < static_cast<int>(network_.heights.size()); ++i) {
    const HeightObservation& h = network_.heights[i];
    AddResidual(ObservationRow::Kind::kHeight, i,
                AutoDiff<1, 3, 3, 3>(HeightCost{h.height, h.sigma}),
                {values_.Unit(h.direction), values_.Point(h.from), values_.Point(h.to)}, {h.sigma});
  }
  for (int i = 0; i < static_cast<int>(network_.angles.size()); ++i) AddAngle(i);
}

void NetworkProblem::AddAngle(int index) {
  const AngleObservation& angle = network_.angles[index];
  std::vector<double*> blocks;
  AngleCost cost;
  const auto add = [&](double* block) {  // Ceres wants a shared corner but once
    const auto place = std::find(blocks.begin(), blocks.end(), block);
    cost.places.push_back(static_cast<int>(place - blocks.begin()));
    if (place == blocks.end()) blocks.push_back(block);
  };
  for (const UnitReference* reference : {&angle.first, &angle.second}) {
    if (const auto* edge = std::get_if<EdgeUnit>(reference)) {
      add(values_.Point(edge->from));
      add(values_.Point(edge->to));
    } else {
      add(values_.Unit(*reference));
    }
  }
  cost.is_edge_first = std::holds_alternative<EdgeUnit>(angle.first);
  cost.is_edge_second = std::holds_alternative<EdgeUnit>(angle.second);
  cost.is_parallel = angle.is_parallel;
  cost.axes = AxesAcross(UnitOf(network_, angle.first));
  cost.observed = angle.departure;
  cost.sigma = angle.sigma;
  auto function =
      std::make_unique<ceres::DynamicAutoDiffCostFunction<AngleCost>>(new AngleCost(cost));
  for (size_t i = 0; i < blocks.size(); ++i) function->AddParameterBlock(3);
  const int components = angle.is_parallel ? 2 : 1;
  function->SetNumResiduals(components);
  AddResidual(ObservationRow::Kind::kAngle, index, function.release(), blocks,
              std::vector<double>(components, angle.sigma));
}

void NetworkProblem::HoldPhotos(const std::vector<int>& columns,
                                const std::vector<double>& weights) {
  for (size_t i = 0; i < columns.size(); ++i) {
    const Unknown& unknown = columns_.unknowns[columns[i]];
    INSITU_CHECK(unknown.kind == Kind::kPhoto);
    const NetworkPhoto& photo = network_.photos[unknown.index];
    const double weight = std::sqrt(weights[i]);
    const int turn = columns[i] - *columns_.rotation[unknown.index];
    if (turn < 3) {
      problem_.AddResidualBlock(AutoDiff<1, 4>(TurnCost{turn, photo.cam_from_local, weight}),
                                nullptr, values_.Rotation(unknown.index));
    } else {
      const int axis = columns[i] - *columns_.center[unknown.index];
      problem_.AddResidualBlock(AutoDiff<1, 3>(CoordinateCost{axis, photo.center[axis], weight}),
                                nullptr, values_.Center(unknown.index));
    }
  }
}

// Points of which nothing but marks and control speaks are eliminated first: they do not meet.
std::shared_ptr<ceres::ParameterBlockOrdering> NetworkProblem::Ordering() {
  std::vector<bool> is_linked(network_.points.size(), false);
  const auto link = [&](const auto& observations) {
    for (const auto& o : observations) is_linked[o.from] = is_linked[o.to] = true;
  };
  link(network_.edges);
  link(network_.along_directions);
  link(network_.distances);
  link(network_.heights);
  for (const AngleObservation& angle : network_.angles) {
    for (const UnitReference* reference : {&angle.first, &angle.second}) {
      if (const auto* edge = std::get_if<EdgeUnit>(reference)) {
        is_linked[edge->from] = is_linked[edge->to] = true;
      }
    }
  }
  auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
  for (double* block : blocks_) ordering->AddElementToGroup(block, 1);
  for (size_t i = 0; i < network_.points.size(); ++i) {
    if (columns_.point[i] && !is_linked[i]) {
      ordering->AddElementToGroup(values_.Point(static_cast<int>(i)), 0);
    }
  }
  return ordering->GroupSize(0) > 0 ? ordering : nullptr;
}

ceres::Solver::Summary NetworkProblem::Solve() {
  values_.Load();
  ceres::Solver::Options ceres_options;
  ceres_options.logging_type = ceres::SILENT;
  ceres_options.linear_solver_ordering = Ordering();
  ceres_options.linear_solver_type =
      ceres_options.linear_solver_ordering ? ceres::SPARSE_SCHUR : ceres::SPARSE_NORMAL_CHOLESKY;
  // One thread and Eigen's own factorization: the same sums in the same order on every machine.
  ceres_options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  ceres_options.num_threads = 1;
  ceres_options.max_num_iterations = kMaxIterations;
  // A step then moves no unknown by 1e-4 of its sigma; below, rounding decides.
  ceres_options.function_tolerance = 1e-12;
  ceres_options.gradient_tolerance = 1e-16;
  ceres_options.parameter_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(ceres_options, &problem_, &summary);
  values_.Store();
  return summary;
}

void NetworkProblem::ThrowNoValue() const {
  size_t block = 0;
  for (const ObservationRow& row : rows_) {
    if (row.component != 0) continue;
    const ceres::ResidualBlockId id = residual_blocks_[block++];
    std::vector<double> residuals(
        static_cast<size_t>(problem_.GetCostFunctionForResidualBlock(id)->num_residuals()));
    if (!problem_.EvaluateResidualBlock(id, false, nullptr, residuals.data(), nullptr)) {
      throw NoSolution("an observation has no value at the start values", row);
    }
  }
  throw NoSolution("an observation has no derivative at the start values");
}

NetworkProblem::Linearization NetworkProblem::Linearize() {
  values_.Load();
  ceres::Problem::EvaluateOptions options;
  options.parameter_blocks = blocks_;
  options.residual_blocks = residual_blocks_;
  std::vector<double> residuals;
  ceres::CRSMatrix crs;
  if (!problem_.Evaluate(options, nullptr, &residuals, nullptr, &crs)) ThrowNoValue();
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
