// SPDX-License-Identifier: GPL-3.0-or-later
#include "reconstruction/adjustment/planarity.h"

#include <algorithm>
#include <cmath>

#include "calibration/files/error.h"
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
  throw InputError(polygon.place.path, polygon.place.line,
                   "polygon '" + polygon.name + "' is far from planar: vertex '" +
                       names[static_cast<size_t>(worst - positions.begin())] + "' is " +
                       Metres(distance(*worst)) + " off the best plane, expected at most " +
                       Metres(limit) + " (" + Metres(tolerance) + " and ten sigma of " +
                       Metres(uncertainty) + ", its least certain vertex's)");
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
      throw InputError(polygon.place.path, polygon.place.line,
                       "polygon '" + polygon.name + "': " + fault->text +
                           ", expected holes within it, each with its vertices in order around");
    }
  }
  throw InputError(polygon.place.path, polygon.place.line,
                   "the outline of polygon '" + polygon.name +
                       "' crosses itself or has no area, expected vertices in order around it");
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
