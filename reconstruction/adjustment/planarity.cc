// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/planarity.h"

#include <algorithm>
#include <cmath>

#include "calibration/files/error_at.h"
#include "calibration/files/wording.h"
#include "reconstruction/geometry/plane.h"
#include "reconstruction/geometry/polygon_rings.h"

namespace insitu {
namespace {

constexpr double kUncertainties = 10;  // sigmas of the least certain vertex that excuse it

std::string Metres(double length) { return Number("%.3f m", length); }

std::vector<StartPoint> Vertices(const PolygonOutline& polygon,
                                 const std::map<std::string, StartPoint>& points) {
  std::vector<StartPoint> vertices;
  for (const std::string& name : AllVertices(polygon)) vertices.push_back(points.at(name));
  return vertices;
}

void RequirePlanar(const PolygonOutline& polygon, const std::vector<StartPoint>& vertices,
                   double tolerance) {
  std::vector<Eigen::Vector3d> positions;
  const std::vector<std::string> all = AllVertices(polygon);
  std::vector<std::string> names;
  double uncertainty = 0;
  for (size_t i = 0; i < vertices.size(); ++i) {
    if (!std::isfinite(vertices[i].sigma)) continue;
    positions.push_back(vertices[i].position);
    names.push_back(all[i]);
    uncertainty = std::max(uncertainty, vertices[i].sigma);
  }
  if (positions.size() < 4) return;
  const Plane plane = FitPlane(positions);
  const auto distance = [&](const auto& x) { return std::abs(plane.SignedDistance(x)); };
  const auto worst =
      std::max_element(positions.begin(), positions.end(),
                       [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  const double limit = tolerance + kUncertainties * uncertainty;
  if (distance(*worst) <= limit) return;
  throw ErrorAt(
      polygon.place,
      Sentence("polygonBent",
               "polygon '{polygon}' is far from planar: vertex '{vertex}' is {off} off the best "
               "plane, expected at most {limit} ({tolerance} and ten sigma of {sigma}, its least "
               "certain vertex's)",
               {{"polygon", polygon.name},
                {"vertex", names[static_cast<size_t>(worst - positions.begin())]},
                {"off", Metres(distance(*worst))},
                {"limit", Metres(limit)},
                {"tolerance", Metres(tolerance)},
                {"sigma", Metres(uncertainty)}}));
}

void RequireSimple(const PolygonOutline& polygon, const std::vector<StartPoint>& vertices) {
  auto next = vertices.begin();
  const auto take = [&](size_t count) {
    Ring ring;
    for (; ring.size() < count; ++next) ring.push_back(next->position);
    return ring;
  };
  const Ring outline = take(polygon.vertices.size());
  std::vector<Ring> holes;
  for (const auto& hole : polygon.holes) holes.push_back(take(hole.size()));
  const Eigen::Vector3d normal = OutlineNormal(outline);
  if (normal.norm() > 0) {
    const auto fault = FaultOfRings(outline, holes, normal);
    if (!fault) return;
    if (fault->hole) {
      throw ErrorAt(polygon.place,
                    Sentence("polygonHoles",
                             "polygon '{polygon}': {fault}, expected holes within it, each with "
                             "its vertices in order around",
                             {{"polygon", polygon.name}, {"fault", fault->what.ToJson()}}));
    }
  }
  throw ErrorAt(polygon.place,
                Sentence("polygonCrossed",
                         "the outline of polygon '{polygon}' crosses itself or has no area, "
                         "expected vertices in order around it",
                         {{"polygon", polygon.name}}));
}

}  // namespace

void RequirePlanar(const Survey& survey, const std::map<std::string, StartPoint>& points,
                   double plane_sigma) {
  const double tolerance = std::max(20 * plane_sigma, 0.1);
  for (const PolygonOutline& polygon : survey.polygons) {
    RequirePlanar(polygon, Vertices(polygon, points), tolerance);
  }
}

void RequireSimpleOutlines(const Survey& survey, const std::map<std::string, StartPoint>& points) {
  for (const PolygonOutline& polygon : survey.polygons) {
    RequireSimple(polygon, Vertices(polygon, points));
  }
}

}  // namespace insitu
