// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_polygons.h"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <string>

#include "reconstruction/adjustment/adjusted_scene.h"
#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "reconstruction/geometry/lens_view.h"
#include "reconstruction/geometry/omega_phi_kappa.h"

namespace insitu {
namespace {

constexpr double kBend = 0.25;         // [px], of a polyline from the curve
constexpr double kHundredths = 100.0;  // what is drawn needs no more digits

double AreaOf(const Polygon& polygon) {
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  const auto& vertices = polygon.vertices;
  for (size_t i = 1; i + 1 < vertices.size(); ++i) {
    twice += (vertices[i] - vertices[0]).cross(vertices[i + 1] - vertices[0]);
  }
  return 0.5 * twice.norm();
}

Json::Value ToPage(const std::vector<Polyline>& pieces) {
  Json::Value lines = Json::arrayValue;
  for (const Polyline& piece : pieces) {
    Json::Value line = Json::arrayValue;
    for (const Eigen::Vector2d& at : piece) {
      Json::Value pixel = Json::arrayValue;
      for (const double value : {at.x(), at.y()}) {
        pixel.append(std::round(value * kHundredths) / kHundredths);
      }
      line.append(std::move(pixel));
    }
    lines.append(std::move(line));
  }
  return lines;
}

}  // namespace

Json::Value ImagedPolygons(const Survey& survey, const SolvedSurvey& solved,
                           const std::vector<PosedCamera>& cameras) {
  std::map<std::string, AdjustedPlane> planes;
  for (AdjustedPlane& plane : AdjustedPlanes(solved.survey_network, solved.solution)) {
    planes[plane.polygon] = std::move(plane);
  }
  std::vector<LensView> views;
  for (const PosedCamera& camera : cameras) views.emplace_back(camera.camera);
  Json::Value polygons = Json::objectValue;
  for (const Polygon& polygon : AdjustedPolygons(survey, solved.survey_network)) {
    Json::Value& told = polygons[polygon.name];
    const auto plane = planes.find(polygon.name);
    const bool has_plane = plane != planes.end();
    told["planarity_mm"] = has_plane ? 1000 * plane->second.planarity_rms : 0.0;
    told["area_m2"] = AreaOf(polygon);
    told["off_vertical_deg"] = has_plane && plane->second.off_vertical
                                   ? Json::Value(*plane->second.off_vertical / kDegree)
                                   : Json::Value();
    told["images"] = Json::objectValue;
    for (size_t i = 0; i < cameras.size(); ++i) {
      const auto pieces =
          ImageOfOutline(views[i], cameras[i].cam_from_world, polygon.vertices, kBend);
      if (!pieces.empty()) told["images"][cameras[i].photo] = ToPage(pieces);
    }
  }
  return polygons;
}

}  // namespace insitu
