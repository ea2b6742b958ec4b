// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_polygons.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "reconstruction/adjustment/adjusted_scene.h"
#include "reconstruction/adjustment/adjusted_unknowns.h"
#include "reconstruction/geometry/lens_view.h"
#include "reconstruction/geometry/omega_phi_kappa.h"
#include "reconstruction/geometry/ray_scene.h"

namespace insitu {
namespace {

constexpr double kBend = 0.25;         // [px], of a polyline from the curve
constexpr double kHundredths = 100.0;  // what is drawn needs no more digits
constexpr int kParts = 24;             // of an edge, each seen or hidden as its middle is
constexpr double kJoin = 1e-3;         // [px], between pieces that are one
constexpr double kPast = 1e-3;         // [m], beyond a hit before the next is looked for
constexpr int kMostHits = 16;          // along one line of sight
// Survey noise leaves polygons that touch centimetres apart: what lies that close to a polygon's
// plane is on it, not behind it. [m]
constexpr double kCoplanar = 0.05;

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

// The polygons, in the way of each other.
class Obstacles {
 public:
  Obstacles(std::vector<Polygon> polygons, const Eigen::Vector3d& origin)
      : polygons_(std::move(polygons)),
        scene_(SceneOf(polygons_, origin, &index_)),
        mesh_(MeshOfPolygons(scene_)),
        rays_(mesh_.mesh) {}

  const std::vector<Polygon>& polygons() const { return polygons_; }

  // Whether another polygon stands clearly before a point of this one's outline.
  bool Hide(int polygon, const Eigen::Vector3d& point, const Eigen::Vector3d& center) const {
    const Eigen::Vector3d sight = point - center;
    const double distance = sight.norm();
    if (!(distance > 0)) return false;
    Ray ray{center - scene_.origin, sight / distance, 0, distance};
    for (int hits = 0; hits < kMostHits && ray.near < distance; ++hits) {
      const std::optional<RayHit> hit = rays_.Nearest(ray);
      if (!hit) return false;
      const int other = index_[mesh_.polygon_of_triangle[hit->triangle]];
      const Polygon& before = polygons_[other];
      const double behind = std::abs(before.normal.dot(point - before.vertices[0]));
      if (other != polygon && behind > kCoplanar) return true;
      ray.near = hit->distance + kPast;
    }
    return false;
  }

 private:
  // Of an unfinished survey an outline may cross itself: it is drawn, and hides nothing.
  static SceneGeometry SceneOf(const std::vector<Polygon>& polygons, const Eigen::Vector3d& origin,
                               std::vector<int>* index) {
    SceneGeometry scene;
    scene.origin = origin;
    for (size_t p = 0; p < polygons.size(); ++p) {
      if (!HasInterior(polygons[p])) continue;
      scene.polygons.push_back(polygons[p]);
      index->push_back(static_cast<int>(p));
    }
    return scene;
  }

  std::vector<Polygon> polygons_;
  std::vector<int> index_;  // among polygons_, of the scene's
  SceneGeometry scene_;
  PolygonMesh mesh_;
  RayScene rays_;
};

void Append(std::vector<Polyline> added, std::vector<Polyline>* pieces) {
  for (Polyline& piece : added) {
    const bool is_next = !pieces->empty() && (pieces->back().back() - piece[0]).norm() < kJoin;
    if (is_next) {
      pieces->back().insert(pieces->back().end(), piece.begin() + 1, piece.end());
    } else {
      pieces->push_back(std::move(piece));
    }
  }
}

struct ImagedOutline {
  std::vector<Polyline> seen, hidden;
};

// One edge, in runs of parts that are all seen or all hidden.
void AddEdge(const Obstacles& obstacles, int polygon, const std::vector<Eigen::Vector3d>& vertices,
             size_t edge, const PosedCamera& posed, const LensView& view, ImagedOutline* outline) {
  const Eigen::Vector3d& from = vertices[edge];
  const Eigen::Vector3d& to = vertices[(edge + 1) % vertices.size()];
  const auto at = [&](double part) -> Eigen::Vector3d {
    return from + part / kParts * (to - from);
  };
  const Eigen::Vector3d center = Center(posed.cam_from_world);
  std::array<bool, kParts> is_hidden = {};
  for (int i = 0; i < kParts; ++i) is_hidden[i] = obstacles.Hide(polygon, at(i + 0.5), center);
  for (int begin = 0, end = 0; begin < kParts; begin = end) {
    while (end < kParts && is_hidden[end] == is_hidden[begin]) ++end;
    Append(
        ImageOfArc(view, posed.cam_from_world * at(begin), posed.cam_from_world * at(end), kBend),
        is_hidden[begin] ? &outline->hidden : &outline->seen);
  }
}

ImagedOutline OutlineIn(const PosedCamera& posed, const LensView& view, const Obstacles& obstacles,
                        int polygon) {
  ImagedOutline outline;
  const Polygon& drawn = obstacles.polygons()[polygon];
  const auto add = [&](const std::vector<Eigen::Vector3d>& ring) {
    for (size_t edge = 0; edge < ring.size(); ++edge) {
      AddEdge(obstacles, polygon, ring, edge, posed, view, &outline);
    }
  };
  add(drawn.vertices);
  for (const auto& hole : drawn.holes) add(hole);
  return outline;
}

}  // namespace

std::optional<size_t> PolygonSeenAt(const std::vector<Polygon>& polygons, const PosedCamera& camera,
                                    const Eigen::Vector2d& pixel) {
  struct Seen {
    size_t polygon;
    Eigen::Vector3d point;
    double distance;
  };
  std::vector<Seen> seen;  // however many stand before it
  for (size_t i = 0; i < polygons.size(); ++i) {
    const auto point = PointOnPolygon(camera, pixel, polygons[i]);
    if (!point) continue;
    seen.push_back({i, *point, (*point - Center(camera.cam_from_world)).norm()});
  }
  if (seen.empty()) return std::nullopt;
  const auto first = std::min_element(seen.begin(), seen.end(), [](const auto& a, const auto& b) {
    return a.distance < b.distance;
  });
  size_t smallest = first->polygon;
  for (const Seen& other : seen) {
    const double apart = std::abs(polygons[first->polygon].normal.dot(other.point - first->point));
    const bool is_smaller = AreaOf(polygons[other.polygon]) < AreaOf(polygons[smallest]);
    if (apart <= kCoplanar && is_smaller) smallest = other.polygon;
  }
  return smallest;
}

Json::Value ImagedPolygons(const Survey& survey, const SolvedSurvey& solved,
                           const std::vector<PosedCamera>& cameras) {
  std::map<std::string, AdjustedPlane> planes;
  for (AdjustedPlane& plane : AdjustedPlanes(solved.survey_network, solved.solution)) {
    planes[plane.polygon] = std::move(plane);
  }
  std::vector<LensView> views;
  for (const PosedCamera& camera : cameras) views.emplace_back(camera.camera);
  const Obstacles obstacles(AdjustedPolygons(survey, solved.survey_network),
                            solved.survey_network.network.origin);
  Json::Value polygons = Json::objectValue;
  for (size_t p = 0; p < obstacles.polygons().size(); ++p) {
    const Polygon& polygon = obstacles.polygons()[p];
    Json::Value& told = polygons[polygon.name];
    const auto plane = planes.find(polygon.name);
    const bool has_plane = plane != planes.end();
    told["planarity_mm"] = has_plane ? 1000 * plane->second.planarity_rms : 0.0;
    told["area_m2"] = AreaOf(polygon);
    told["off_vertical_deg"] = has_plane && plane->second.off_vertical
                                   ? Json::Value(*plane->second.off_vertical / kDegree)
                                   : Json::Value();
    told["images"] = told["hidden"] = Json::objectValue;
    for (size_t i = 0; i < cameras.size(); ++i) {
      const ImagedOutline outline = OutlineIn(cameras[i], views[i], obstacles, static_cast<int>(p));
      if (!outline.seen.empty()) told["images"][cameras[i].photo] = ToPage(outline.seen);
      if (!outline.hidden.empty()) told["hidden"][cameras[i].photo] = ToPage(outline.hidden);
    }
  }
  return polygons;
}

}  // namespace insitu
