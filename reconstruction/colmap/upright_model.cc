// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/colmap/upright_model.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/algebra/decompositions.h"
#include "reconstruction/geometry/intersection.h"
#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

using Kind = GeometricConstraint::Kind;

constexpr double kLeastAngle = 0.02;  // [rad], between the rays to a point
constexpr double kLeastGap = 0.1;     // of eigenvalues, for the zenith to be their vector
constexpr double kSameScale = 0.1;    // lengths that differ more contradict each other
constexpr double kLandscape = 0.3;    // |right . up| of a camera that is held level
constexpr double kLeastRise = 0.05;   // of a height's share of the way between its points

// Points of the survey in the model.
class Located {
 public:
  Located(const Survey& survey, const std::map<std::string, Camera>& cameras,
          const TiePoints& tie_points) {
    std::map<std::string, PosedCamera> posed;
    for (const auto& [photo, pose] : tie_points.cam_from_model) {
      posed.emplace(photo, PosedCamera{photo, cameras.at(photo), pose});
    }
    std::map<std::string, std::vector<Sight>> sights;
    for (const ImageObservation& mark : survey.observations) {
      const auto camera = posed.find(mark.photo);
      if (camera != posed.end()) sights[mark.point].push_back({&camera->second, mark.pixel});
    }
    for (const auto& [point, rays] : sights) {
      if (const auto place = Intersect(rays, kLeastAngle)) place_.emplace(point, *place);
    }
  }

  // From the first point to the second.
  std::optional<Eigen::Vector3d> Step(const std::string& from, const std::string& to) const {
    const auto a = place_.find(from), b = place_.find(to);
    if (a == place_.end() || b == place_.end() || a->second == b->second) return std::nullopt;
    return b->second - a->second;
  }

  std::optional<Eigen::Vector3d> Normal(const Survey& survey, const std::string& polygon) const {
    std::vector<Eigen::Vector3d> vertices;
    for (const PolygonOutline& outline : survey.polygons) {
      if (outline.name != polygon) continue;
      for (const std::string& vertex : outline.vertices) {
        const auto place = place_.find(vertex);
        if (place != place_.end()) vertices.push_back(place->second);
      }
    }
    if (vertices.size() < 3) return std::nullopt;
    return FitPlane(vertices).normal;
  }

 private:
  std::map<std::string, Eigen::Vector3d> place_;
};

// Directions that are plumb or level: the zenith is the eigenvector of the smallest eigenvalue.
struct PlumbSum {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Vector3d upwards = Eigen::Vector3d::Zero();  // of pairs that tell bottom from top
  int count = 0;

  void AddPlumb(const Eigen::Vector3d& direction) {
    matrix -= direction.normalized() * direction.normalized().transpose();
    ++count;
  }
  void AddLevel(const Eigen::Vector3d& direction) {
    matrix += direction.normalized() * direction.normalized().transpose();
    ++count;
  }
};

void AddConstraint(const Survey& survey, const Located& located,
                   const GeometricConstraint& constraint, PlumbSum* sum) {
  const bool is_vertical = constraint.kind == Kind::kVertical;
  if (!is_vertical && constraint.kind != Kind::kHorizontal &&
      !(constraint.kind == Kind::kHeight && constraint.value == 0)) {
    return;
  }
  if (!constraint.points.empty()) {
    const auto step = located.Step(constraint.points[0], constraint.points[1]);
    if (step) is_vertical ? sum->AddPlumb(*step) : sum->AddLevel(*step);
  } else if (const auto normal = located.Normal(survey, constraint.polygons.at(0))) {
    is_vertical ? sum->AddLevel(*normal) : sum->AddPlumb(*normal);
  }
}

// The photographers' upright: the mean of the pictures' own, then across what they held level.
Eigen::Vector3d UpOfCameras(const TiePoints& tie_points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& [photo, pose] : tie_points.cam_from_model) {
    sum -= pose.rotation.conjugate() * Eigen::Vector3d::UnitY();
  }
  if (sum.norm() < 1e-3) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d mean = sum.normalized();
  Eigen::Matrix3d level = Eigen::Matrix3d::Zero();
  for (const auto& [photo, pose] : tie_points.cam_from_model) {
    const Eigen::Vector3d right = pose.rotation.conjugate() * Eigen::Vector3d::UnitX();
    if (std::abs(right.dot(mean)) < kLandscape) level += right * right.transpose();
  }
  const SymmetricEigen<3> eigen = EigenOfSymmetric(level);
  const Eigen::Vector3d up = eigen.vectors.col(0);
  const bool is_decided = eigen.values[1] - eigen.values[0] > kLeastGap;
  if (!is_decided || std::abs(up.dot(mean)) < 0.9) return mean;
  return up.dot(mean) > 0 ? up : Eigen::Vector3d(-up);
}

Eigen::Vector3d FindUp(const Survey& survey, const Located& located, const TiePoints& tie_points,
                       int* statements) {
  PlumbSum sum;
  for (const DirectionPair& pair : survey.zenith_pairs) {
    if (const auto step = located.Step(pair.from, pair.to)) {
      sum.AddPlumb(*step);
      sum.upwards += step->normalized();
    }
  }
  for (const GeometricConstraint& constraint : survey.constraints) {
    AddConstraint(survey, located, constraint, &sum);
  }
  const Eigen::Vector3d held = UpOfCameras(tie_points);
  const SymmetricEigen<3> eigen = EigenOfSymmetric(sum.matrix);
  if (eigen.values[1] - eigen.values[0] < kLeastGap) return held;
  *statements = sum.count;
  const Eigen::Vector3d up = eigen.vectors.col(0);
  const double sense = sum.upwards.norm() > kLeastGap ? up.dot(sum.upwards) : up.dot(held);
  return sense >= 0 ? up : Eigen::Vector3d(-up);
}

// Metres per unit by each distance, or where there is none by each height.
std::vector<double> Scales(const Survey& survey, const Located& located,
                           const Eigen::Vector3d& up) {
  std::vector<double> by_distances, by_heights;
  for (const GeometricConstraint& constraint : survey.constraints) {
    if (constraint.kind != Kind::kDistance && constraint.kind != Kind::kHeight) continue;
    const auto step = located.Step(constraint.points.at(0), constraint.points.at(1));
    if (!step) continue;
    if (constraint.kind == Kind::kDistance) {
      by_distances.push_back(constraint.value / step->norm());
    } else if (constraint.value * up.dot(*step) > 0 &&
               std::abs(up.dot(*step)) > kLeastRise * step->norm()) {
      by_heights.push_back(constraint.value / up.dot(*step));
    }
  }
  return by_distances.empty() ? by_heights : by_distances;
}

}  // namespace

UprightModel FindUpright(const Survey& survey, const std::map<std::string, Camera>& cameras,
                         const TiePoints& tie_points) {
  UprightModel model;
  const Located located(survey, cameras, tie_points);
  const Eigen::Vector3d up = FindUp(survey, located, tie_points, &model.plumb);
  model.world_from_model.rotation = RotationBetween(up, Eigen::Vector3d::UnitZ());
  std::vector<double> scales = Scales(survey, located, up);
  if (scales.empty()) return model;
  std::sort(scales.begin(), scales.end());
  model.lengths = static_cast<int>(scales.size());
  model.world_from_model.scale = scales[scales.size() / 2];
  model.is_contradictory = scales.back() > (1 + kSameScale) * scales.front();
  return model;
}

}  // namespace insitu
