// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/adjusted_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "reconstruction/adjustment/polygon_covariance.h"
#include "reconstruction/geometry/plane.h"
#include "reconstruction/network/unit_tangents.h"

namespace insitu {
namespace {

// The median posterior sigma of the coordinates of the polygons' vertices [m].
double MedianVertexSigma(const Survey& survey, const std::vector<AdjustedPoint>& points) {
  std::set<std::string> vertices;
  for (const PolygonOutline& polygon : survey.polygons) {
    for (const std::string& vertex : AllVertices(polygon)) vertices.insert(vertex);
  }
  std::vector<double> sigmas;
  for (const AdjustedPoint& point : points) {
    if (!vertices.contains(point.name)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      sigmas.push_back(std::sqrt(point.covariance(axis, axis)));
    }
  }
  if (sigmas.empty()) return 0;
  const auto middle = sigmas.begin() + static_cast<std::ptrdiff_t>(sigmas.size() / 2);
  std::nth_element(sigmas.begin(), middle, sigmas.end());
  return *middle;
}

}  // namespace

void CompareWithSurvey(const Survey& survey, Adjustment* adjustment) {
  std::map<std::string, const AdjustedPoint*> adjusted;
  for (const AdjustedPoint& point : adjustment->points) adjusted[point.name] = &point;
  for (const ControlPoint& surveyed : survey.control_points) {
    const auto point = adjusted.find(surveyed.name);
    if (point == adjusted.end()) continue;
    PointComparison comparison{surveyed.name,  point->second->position - surveyed.position,
                               surveyed.sigma, surveyed.position,
                               surveyed.sigma, point->second->covariance.diagonal().cwiseSqrt()};
    if (surveyed.role == ControlRole::kControl) {
      adjustment->control.push_back(comparison);
      continue;
    }
    const Eigen::Array3d variance = point->second->covariance.diagonal();
    comparison.sigma = (surveyed.sigma.array().square() + variance).sqrt();
    adjustment->check.push_back(comparison);
  }
}

Direction AdjustedDirection(const SurveyNetwork& survey_network, const NetworkSolution& solution,
                            int index) {
  const NetworkDirection& direction = survey_network.network.directions[index];
  const std::optional<int> column = solution.columns.direction[index];
  if (!column) return {direction.unit, Eigen::Matrix3d::Zero()};
  const Eigen::Matrix<double, 3, 2> unit_from_tangent = TangentsOf(direction.unit);
  return {direction.unit, unit_from_tangent *
                              Covariance(survey_network.network, solution, *column, 2, *column, 2) *
                              unit_from_tangent.transpose()};
}

std::vector<Polygon> AdjustedPolygons(const Survey& survey, const SurveyNetwork& survey_network) {
  const Network& network = survey_network.network;
  std::vector<Polygon> polygons;
  for (const PolygonOutline& outline : survey.polygons) {
    Polygon polygon;
    polygon.name = outline.name;
    polygon.material = outline.material;
    const auto place = [&](const std::string& vertex) -> Eigen::Vector3d {
      return network.points[survey_network.index_of_point.at(vertex)].position + network.origin;
    };
    for (const std::string& vertex : outline.vertices) polygon.vertices.push_back(place(vertex));
    for (const std::vector<std::string>& hole : outline.holes) {
      std::vector<Eigen::Vector3d>& ring = polygon.holes.emplace_back();
      for (const std::string& vertex : hole) ring.push_back(place(vertex));
    }
    if (outline.photo) {
      const auto photo = survey_network.index_of_photo.find(*outline.photo);
      if (photo != survey_network.index_of_photo.end()) polygon.photo = photo->second;
    }
    const Eigen::Vector3d newell = OutlineNormal(polygon.vertices);
    const auto plane = survey_network.index_of_plane.find(outline.name);
    polygon.normal = plane == survey_network.index_of_plane.end()
                         ? newell
                         : network.planes[plane->second].normal;
    if (polygon.normal.dot(newell) < 0) polygon.normal = -polygon.normal;
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

SceneGeometry AdjustedScene(const Survey& survey, const SurveyNetwork& survey_network,
                            const NetworkSolution& solution, const Adjustment& adjustment) {
  const Network& network = survey_network.network;
  SceneGeometry scene;
  scene.origin = network.origin;
  for (size_t i = 0; i < network.photos.size(); ++i) {
    const NetworkPhoto& photo = network.photos[i];
    scene.cameras.push_back({photo.name, std::get<Camera>(network.cameras[photo.camera].lens),
                             adjustment.poses[i].cam_from_world});
  }
  scene.camera_covariances = CameraCovariances(network, solution);
  scene.polygons = AdjustedPolygons(survey, survey_network);
  std::vector<Eigen::MatrixXd> covariances = PolygonCovariances(survey, survey_network, solution);
  for (size_t i = 0; i < covariances.size(); ++i) {
    scene.polygons[i].covariance = std::move(covariances[i]);
  }
  if (survey_network.sun) {
    scene.sun = AdjustedDirection(survey_network, solution, *survey_network.sun);
  }
  scene.zenith = AdjustedDirection(survey_network, solution, *survey_network.zenith);
  scene.vertex_sigma = MedianVertexSigma(survey, adjustment.points);
  return scene;
}

}  // namespace insitu
