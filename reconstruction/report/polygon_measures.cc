// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/polygon_measures.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace insitu {
namespace {

// Of the polygon's vertices in their order: joint if known, else block by block.
Eigen::MatrixXd VertexCovariance(const Adjustment& adjustment, const PolygonOutline& outline,
                                 size_t index) {
  const Eigen::MatrixXd& joint = adjustment.scene.polygons[index].covariance;
  if (joint.size() > 0) return joint;
  std::map<std::string, const AdjustedPoint*> points;
  for (const AdjustedPoint& point : adjustment.points) points[point.name] = &point;
  const auto count = static_cast<Eigen::Index>(outline.vertices.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    covariance.block<3, 3>(3 * i, 3 * i) = points.at(outline.vertices[i])->covariance;
  }
  return covariance;
}

double Sigma(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& covariance) {
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

}  // namespace

PolygonMeasures MeasurePolygon(const Adjustment& adjustment, const PolygonOutline& outline,
                               size_t index) {
  const std::vector<Eigen::Vector3d>& vertices = adjustment.scene.polygons[index].vertices;
  const Eigen::Vector3d& normal = adjustment.scene.polygons[index].normal;
  const Eigen::MatrixXd covariance = VertexCovariance(adjustment, outline, index);
  const size_t count = vertices.size();
  PolygonMeasures measures;
  measures.is_joint = adjustment.scene.polygons[index].covariance.size() > 0;
  Eigen::VectorXd area_gradient = Eigen::VectorXd::Zero(covariance.rows());
  for (size_t i = 0; i < count; ++i) {
    const size_t next = (i + 1) % count, previous = (i + count - 1) % count;
    const auto row = static_cast<Eigen::Index>(3 * i);
    const Eigen::Vector3d edge = vertices[next] - vertices[i];
    Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
    gradient.segment<3>(row) = -edge.normalized();
    gradient.segment<3>(static_cast<Eigen::Index>(3 * next)) = edge.normalized();
    measures.edges.push_back({edge.norm(), Sigma(gradient, covariance)});
    // 2 area = normal . sum x_i x x_(i+1), about a vertex so that large coordinates lose nothing.
    const Eigen::Vector3d a = vertices[i] - vertices[0], b = vertices[next] - vertices[0];
    measures.area.value += normal.dot(a.cross(b)) / 2;
    area_gradient.segment<3>(row) = (vertices[next] - vertices[previous]).cross(normal) / 2;
  }
  measures.area.sigma = Sigma(area_gradient, covariance);
  return measures;
}

UncertainValue AngleBetween(const AdjustedPlane& a, const AdjustedPlane& b) {
  const double cosine = a.normal.dot(b.normal), sine = a.normal.cross(b.normal).norm();
  // d angle = -(b . da + a . db) / sine; near 0 and pi the angle is no smooth function.
  const double variance =
      b.normal.dot(a.normal_covariance * b.normal) + a.normal.dot(b.normal_covariance * a.normal);
  return {std::atan2(sine, cosine), std::sqrt(variance) / std::max(sine, 1e-9)};
}

UncertainValue OffLevel(const AdjustedPlane& plane, const Eigen::Vector3d& zenith) {
  const Eigen::Vector3d across = plane.normal.cross(zenith);
  const double sine = across.norm(), cosine = std::abs(plane.normal.dot(zenith));
  // Towards the zenith, or where that has no direction the largest sigma of any.
  const Eigen::Matrix3d& covariance = plane.tilt_covariance;
  const Eigen::Vector3d towards = plane.normal.cross(across).normalized();
  const double variance = sine > 1e-9 ? towards.dot(covariance * towards)
                                      : Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(
                                            covariance, Eigen::EigenvaluesOnly)
                                            .eigenvalues()[2];
  return {std::atan2(sine, cosine), std::sqrt(std::max(0.0, variance))};
}

std::vector<std::pair<size_t, size_t>> AdjoiningPolygons(const Survey& survey) {
  std::map<std::pair<std::string, std::string>, std::vector<size_t>> polygons_of_edge;
  for (size_t i = 0; i < survey.polygons.size(); ++i) {
    const std::vector<std::string>& vertices = survey.polygons[i].vertices;
    for (size_t k = 0; k < vertices.size(); ++k) {
      polygons_of_edge[std::minmax(vertices[k], vertices[(k + 1) % vertices.size()])].push_back(i);
    }
  }
  std::set<std::pair<size_t, size_t>> pairs;
  for (const auto& [edge, polygons] : polygons_of_edge) {
    for (size_t i = 0; i < polygons.size(); ++i) {
      for (size_t k = i + 1; k < polygons.size(); ++k) pairs.insert({polygons[i], polygons[k]});
    }
  }
  return {pairs.begin(), pairs.end()};
}

}  // namespace insitu
