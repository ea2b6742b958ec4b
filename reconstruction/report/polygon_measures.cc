// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/report/polygon_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "calibration/algebra/decompositions.h"
#include "reconstruction/geometry/plane.h"

namespace insitu {
namespace {

// Of the polygon's vertices in their order: joint if known, else block by block.
Eigen::MatrixXd VertexCovariance(const Adjustment& adjustment, const PolygonOutline& outline,
                                 size_t index) {
  const Eigen::MatrixXd& joint = adjustment.scene.polygons[index].covariance;
  if (joint.size() > 0) return joint;
  std::map<std::string, const AdjustedPoint*> points;
  for (const AdjustedPoint& point : adjustment.points) points[point.name] = &point;
  const std::vector<std::string> names = AllVertices(outline);
  const auto count = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(3 * count, 3 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    covariance.block<3, 3>(3 * i, 3 * i) = points.at(names[i])->covariance;
  }
  return covariance;
}

double Sigma(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& covariance) {
  return std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)));
}

// Adds one ring's edges, and what it encloses to the area or, of a hole, from it.
struct RingMeasurer {
  const Eigen::Vector3d& normal;
  const Eigen::MatrixXd& covariance;
  PolygonMeasures& measures;
  Eigen::VectorXd area_gradient;

  // `first`: the ring's first vertex among all.
  void Add(const std::vector<Eigen::Vector3d>& ring, size_t first, double sign) {
    const size_t count = ring.size();
    const auto row = [&](size_t i) { return static_cast<Eigen::Index>(3 * (first + i)); };
    for (size_t i = 0; i < count; ++i) {
      const size_t next = (i + 1) % count, previous = (i + count - 1) % count;
      const Eigen::Vector3d edge = ring[next] - ring[i];
      Eigen::VectorXd gradient = Eigen::VectorXd::Zero(covariance.rows());
      gradient.segment<3>(row(i)) = -edge.normalized();
      gradient.segment<3>(row(next)) = edge.normalized();
      measures.edges.push_back({edge.norm(), Sigma(gradient, covariance)});
      // 2 area = normal . sum x_i x x_(i+1), about a vertex so that large coordinates lose nothing.
      const Eigen::Vector3d a = ring[i] - ring[0], b = ring[next] - ring[0];
      measures.area.value += sign * normal.dot(a.cross(b)) / 2;
      area_gradient.segment<3>(row(i)) = sign * (ring[next] - ring[previous]).cross(normal) / 2;
    }
  }
};

}  // namespace

PolygonMeasures MeasurePolygon(const Adjustment& adjustment, const PolygonOutline& outline,
                               size_t index) {
  const Polygon& polygon = adjustment.scene.polygons[index];
  const Eigen::MatrixXd covariance = VertexCovariance(adjustment, outline, index);
  PolygonMeasures measures;
  measures.is_joint = polygon.covariance.size() > 0;
  RingMeasurer measurer{polygon.normal, covariance, measures,
                        Eigen::VectorXd::Zero(covariance.rows())};
  measurer.Add(polygon.vertices, 0, 1);
  size_t first = polygon.vertices.size();
  for (const auto& hole : polygon.holes) {  // which may turn either way
    measurer.Add(hole, first, polygon.normal.dot(OutlineNormal(hole)) > 0 ? -1 : 1);
    first += hole.size();
  }
  measures.area.sigma = Sigma(measurer.area_gradient, covariance);
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
  const double variance =
      sine > 1e-9 ? towards.dot(covariance * towards) : EigenOfSymmetric(covariance).values[2];
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
