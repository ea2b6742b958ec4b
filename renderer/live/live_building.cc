// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/live/live_building.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <utility>

#include "reconstruction/geometry/lens_view.h"
#include "renderer/building/building_outline.h"
#include "renderer/building/building_uncertainty.h"

namespace insitu {
namespace {

constexpr double kCrease = 15 * std::numbers::pi / 180;  // an edge between faces that bend more
constexpr size_t kMostEdges = 20000;                     // of a wireframe: the longest
constexpr size_t kMostCorners = 400;
constexpr double kDrawnWithin = 0.5;  // [px]

using Edge = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

// Vertices by place: converters may give each face its own.
std::vector<int> JoinedVertices(const std::vector<Eigen::Vector3d>& vertices) {
  std::map<std::array<double, 3>, int> seen;
  std::vector<int> joined;
  for (size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d& v = vertices[i];
    joined.push_back(seen.try_emplace({v.x(), v.y(), v.z()}, static_cast<int>(i)).first->second);
  }
  return joined;
}

// Edges at which a surface ends or bends.
std::vector<Edge> CreasesOf(const ArtificialEnvironment& building) {
  const std::vector<int> joined = JoinedVertices(building.vertices);
  std::map<std::pair<int, int>, std::vector<Eigen::Vector3d>> normals_of_edge;
  for (const Eigen::Vector3i& triangle : building.triangles) {
    const auto corner = [&](int i) { return building.vertices[triangle[i]]; };
    const Eigen::Vector3d normal =
        (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    for (int i = 0; i < 3; ++i) {
      const int a = joined[triangle[i]], b = joined[triangle[(i + 1) % 3]];
      if (a != b) normals_of_edge[std::minmax(a, b)].push_back(normal);
    }
  }
  std::vector<Edge> edges;
  for (const auto& [ends, normals] : normals_of_edge) {
    const bool is_flat =
        normals.size() == 2 && std::abs(normals[0].dot(normals[1])) > std::cos(kCrease);
    if (!is_flat) edges.emplace_back(building.vertices[ends.first], building.vertices[ends.second]);
  }
  return edges;
}

void KeepLongest(std::vector<Edge>* edges) {
  if (edges->size() <= kMostEdges) return;
  const auto is_longer = [](const Edge& a, const Edge& b) {
    return (a.second - a.first).squaredNorm() > (b.second - b.first).squaredNorm();
  };
  std::nth_element(edges->begin(), edges->begin() + kMostEdges, edges->end(), is_longer);
  edges->resize(kMostEdges);
}

// The edges, and of the spheres what this camera sees as their outline.
Json::Value LinesJson(const BuildingWireframe& building, const PosedCamera& posed) {
  const LensView view(posed.camera);
  std::vector<Edge> edges = building.edges;
  for (const EnvironmentSphere& sphere : building.spheres) {
    const std::vector<Edge> circle = SilhouetteEdges(Center(posed.cam_from_world), sphere);
    edges.insert(edges.end(), circle.begin(), circle.end());
  }
  Json::Value lines(Json::arrayValue);
  for (const Edge& edge : edges) {
    for (const Polyline& line : ImageOfArc(view, posed.cam_from_world * edge.first,
                                           posed.cam_from_world * edge.second, kDrawnWithin)) {
      Json::Value points(Json::arrayValue);
      for (const Eigen::Vector2d& at : line) {
        Json::Value point(Json::arrayValue);
        for (const double value : {at.x(), at.y()}) point.append(std::round(value * 100) / 100);
        points.append(point);
      }
      lines.append(points);
    }
  }
  return lines;
}

Json::Value CornersJson(const std::vector<CornerUncertainty>& corners) {
  Json::Value list(Json::arrayValue);
  for (const CornerUncertainty& told : corners) {
    const ImageUncertainty& image = told.image;
    const Eigen::Matrix2d& c = image.covariance_px;
    Json::Value corner;
    corner["x"] = image.pixel.x();
    corner["y"] = image.pixel.y();
    corner["major"] = kEllipse95 * image.major_px;
    corner["minor"] = kEllipse95 * image.minor_px;
    corner["angle"] = std::atan2(2 * c(0, 1), c(0, 0) - c(1, 1)) / 2;
    list.append(corner);
  }
  return list;
}

}  // namespace

BuildingWireframe ReadBuildingWireframe(const SitePaths& site) {
  BuildingWireframe wireframe;
  const ArtificialEnvironment building = ReadArtificialEnvironment(site);
  wireframe.edges = CreasesOf(building);
  wireframe.spheres = building.spheres;
  KeepLongest(&wireframe.edges);
  const size_t step = 1 + 2 * wireframe.edges.size() / kMostCorners;
  for (size_t i = 0; i < wireframe.edges.size(); i += step) {
    wireframe.corners.push_back(wireframe.edges[i].first);
    wireframe.corners.push_back(wireframe.edges[i].second);
  }
  return wireframe;
}

Json::Value LiveBuilding(const BuildingWireframe& building, const SceneGeometry& scene) {
  Json::Value message;
  message["images"] = message["corners"] = Json::Value(Json::objectValue);
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const std::string& photo = scene.cameras[i].photo;
    message["images"][photo] = LinesJson(building, scene.cameras[i]);
    const auto corners = BuildingUncertainty(scene, i, building.corners);
    if (corners) message["corners"][photo] = CornersJson(*corners);
  }
  return message;
}

}  // namespace insitu
