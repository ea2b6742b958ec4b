// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/plane_effect.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "calibration/algebra/decompositions.h"
#include "reconstruction/network/statistics.h"

namespace insitu {
namespace {

constexpr double kNegligibleVariance = 1e-14;  // [m^2], of a shift that planes cannot cause

// Whether control or two photos determine a point whatever planes say.
std::vector<bool> HeldPoints(const Network& network) {
  std::vector<std::set<int>> photos(network.points.size());
  for (const MarkObservation& mark : network.marks) photos[mark.point].insert(mark.photo);
  std::vector<bool> is_held(network.points.size());
  for (size_t i = 0; i < is_held.size(); ++i) {
    is_held[i] = network.points[i].is_fixed || photos[i].size() >= 2;
  }
  for (const ControlObservation& control : network.control) is_held[control.point] = true;
  return is_held;
}

bool IsUsable(const UnitReference& unit, const std::vector<bool>& is_held) {
  if (const auto* edge = std::get_if<EdgeUnit>(&unit)) {
    return is_held[edge->from] && is_held[edge->to];
  }
  return std::holds_alternative<DirectionUnit>(unit);
}

// A direction that no pair observes any more would be undetermined.
void FixDirectionsWithoutPairs(Network* network) {
  std::vector<bool> has_pairs(network->directions.size());
  for (const DirectionObservation& pair : network->along_directions) {
    has_pairs[pair.direction] = true;
  }
  for (size_t i = 0; i < has_pairs.size(); ++i) {
    if (!has_pairs[i]) network->directions[i].is_fixed = true;
  }
}

// What only planes held stays where it is, without observations; indices stay as they are.
Network WithoutPlanes(Network network, const std::vector<bool>& is_held) {
  network.planes.clear();
  network.on_planes.clear();
  for (size_t i = 0; i < is_held.size(); ++i) {
    if (!is_held[i]) network.points[i].is_fixed = true;
  }
  const auto is_loose = [&](const auto& each) { return !is_held[each.from] || !is_held[each.to]; };
  std::erase_if(network.marks, [&](const auto& mark) { return !is_held[mark.point]; });
  std::erase_if(network.edges, is_loose);
  std::erase_if(network.along_directions, is_loose);
  std::erase_if(network.distances, is_loose);
  std::erase_if(network.heights, is_loose);
  std::erase_if(network.angles, [&](const AngleObservation& angle) {
    return !IsUsable(angle.first, is_held) || !IsUsable(angle.second, is_held);
  });
  FixDirectionsWithoutPairs(&network);
  return network;
}

// `cofactor`: of the shift. Its test is along the axis that the planes hold most.
PlaneEffect::Shift TestedShift(const std::string& name, const Eigen::Vector3d& shift,
                               const Eigen::Matrix3d& cofactor) {
  const SymmetricEigen<3> axes = EigenOfSymmetric(cofactor);
  PlaneEffect::Shift tested{name, shift, std::nullopt, std::nullopt};
  const double variance = axes.values[2];
  if (variance < kNegligibleVariance) return tested;
  tested.sigma = std::sqrt(variance);
  tested.w = shift.dot(axes.vectors.col(2)) / *tested.sigma;
  return tested;
}

Eigen::Matrix3d CofactorOf(const NetworkSolution& solution, int column) {
  return solution.cofactor.Block(column, 3, column, 3);
}

void AddShifts(const Network& with, const NetworkSolution& with_solution, const Network& without,
               const NetworkSolution& without_solution, PlaneEffect* effect) {
  for (size_t i = 0; i < with.photos.size(); ++i) {
    const auto column = without_solution.columns.center[i];
    if (!column) continue;
    effect->shifts.push_back(TestedShift(
        "photo " + with.photos[i].name, with.photos[i].center - without.photos[i].center,
        CofactorOf(without_solution, *column) -
            CofactorOf(with_solution, *with_solution.columns.center[i])));
  }
  for (size_t i = 0; i < with.points.size(); ++i) {
    const auto column = without_solution.columns.point[i];
    if (!column || with.points[i].is_tie_point) continue;
    effect->shifts.push_back(
        TestedShift(with.points[i].name, with.points[i].position - without.points[i].position,
                    CofactorOf(without_solution, *column) -
                        CofactorOf(with_solution, *with_solution.columns.point[i])));
  }
}

}  // namespace

PlaneEffect FindPlaneEffect(const SurveyNetwork& survey_network, const NetworkSolution& solution) {
  const Network& with = survey_network.network;
  PlaneEffect effect;
  if (with.planes.empty()) {
    effect.unknown_because = "there are no planes";
    return effect;
  }
  if (solution.datum.defect() > 0) {
    effect.unknown_because = "the datum is free, which moves everything";
    return effect;
  }
  const std::vector<bool> is_held = HeldPoints(with);
  for (size_t i = 0; i < is_held.size(); ++i) {
    if (!is_held[i]) effect.held_by_planes.push_back(with.points[i].name);
  }
  Network without = WithoutPlanes(with, is_held);
  try {
    const NetworkSolution without_solution = SolveNetwork(&without);
    if (without_solution.datum.defect() > 0) {
      effect.unknown_because = "without planes the datum is free";
      return effect;
    }
    if (!without_solution.is_converged) {
      effect.unknown_because = "without planes the adjustment does not converge";
      return effect;
    }
    effect.redundancy = without_solution.redundancy;
    effect.sigma0 = without_solution.sigma0;
    effect.statistic = solution.square_sum - without_solution.square_sum;
    effect.degrees = solution.redundancy - without_solution.redundancy;
    AddShifts(with, solution, without, without_solution, &effect);
  } catch (const RankDefect&) {
    effect.unknown_because = "without planes the observations do not determine every photo";
  } catch (const NoSolution&) {
    effect.unknown_because = "without planes the adjustment does not converge";
  }
  if (effect.degrees > 0) {
    effect.limit = ChiSquareQuantile(effect.degrees, 1 - effect.alpha);
  }
  return effect;
}

}  // namespace insitu
