// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/building/building_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace insitu {
namespace {

constexpr double kSamePoint = 1e-3;  // [m]
constexpr double kSharp = std::numbers::pi / 6;
constexpr int kCornersOfSphere = 16, kSidesOfSilhouette = 128;

// Which point each vertex is; the points come in the vertices' order.
std::vector<int> JoinedPoints(const std::vector<Eigen::Vector3d>& vertices,
                              std::vector<Eigen::Vector3d>* points) {
  std::map<std::array<long long, 3>, int> seen;
  std::vector<int> joined;
  joined.reserve(vertices.size());
  for (const Eigen::Vector3d& vertex : vertices) {
    const Eigen::Vector3d cell = (vertex - vertices.front()) / kSamePoint;
    const auto [place, is_new] =
        seen.try_emplace({std::llround(cell.x()), std::llround(cell.y()), std::llround(cell.z())},
                         static_cast<int>(points->size()));
    if (is_new) points->push_back(vertex);
    joined.push_back(place->second);
  }
  return joined;
}

// A face's side, from the lower to the higher end.
struct FaceSide {
  EdgeEnds ends;
  Eigen::Vector3d normal;
  bool is_turned = false;  // the face goes from the higher to the lower end
};

}  // namespace

namespace {

// `stretch`: of its radius.
std::vector<Eigen::Vector3d> CircleOf(const Eigen::Vector3d& eye, const EnvironmentSphere& sphere,
                                      int corners, double stretch) {
  const Eigen::Vector3d to_eye = eye - sphere.center;
  const double sine = sphere.radius / to_eye.norm();  // of the cone of lines that touch it
  if (!(sine < 1)) return {};
  const Eigen::Vector3d axis = to_eye.normalized();
  const Eigen::Vector3d u = axis.unitOrthogonal(), v = axis.cross(u);
  const double across = stretch * sphere.radius * std::sqrt(1 - sine * sine);
  std::vector<Eigen::Vector3d> circle;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    circle.emplace_back(sphere.center + sphere.radius * sine * axis +
                        across * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return circle;
}

}  // namespace

std::vector<Eigen::Vector3d> SilhouetteFrom(const Eigen::Vector3d& eye,
                                            const EnvironmentSphere& sphere, int corners) {
  return CircleOf(eye, sphere, corners, 1);
}

// About the circle, not within it: what lies within is hidden behind the sphere itself.
std::vector<OutlineEdge> SilhouetteEdges(const Eigen::Vector3d& eye,
                                         const EnvironmentSphere& sphere) {
  const double stretch = 1 / std::cos(std::numbers::pi / kSidesOfSilhouette);
  const std::vector<Eigen::Vector3d> circle = CircleOf(eye, sphere, kSidesOfSilhouette, stretch);
  std::vector<OutlineEdge> edges;
  for (size_t i = 0; i < circle.size(); ++i) {
    edges.emplace_back(circle[i], circle[(i + 1) % circle.size()]);
  }
  return edges;
}

BuildingEdges::BuildingEdges(const ArtificialEnvironment& building) : spheres_(building.spheres) {
  const std::vector<int> joined = JoinedPoints(building.vertices, &points_);
  AddFaces(building, joined);
  FindSharpCorners();
}

void BuildingEdges::AddFaces(const ArtificialEnvironment& building,
                             const std::vector<int>& point_of_vertex) {
  std::vector<FaceSide> sides;
  sides.reserve(3 * building.triangles.size());
  for (const Eigen::Vector3i& triangle : building.triangles) {
    std::array<int, 3> corner = {};
    for (int i = 0; i < 3; ++i) corner[i] = point_of_vertex[triangle[i]];
    const Eigen::Vector3d& a = points_[corner[0]];
    const Eigen::Vector3d normal =
        (points_[corner[1]] - a).cross(points_[corner[2]] - a).normalized();
    if (normal.isZero()) continue;
    for (int i = 0; i < 3; ++i) {
      const int from = corner[i], to = corner[(i + 1) % 3];
      sides.push_back({std::minmax(from, to), normal, from > to});
    }
  }
  std::sort(sides.begin(), sides.end(),
            [](const FaceSide& a, const FaceSide& b) { return a.ends < b.ends; });
  for (size_t i = 0; i < sides.size(); ++i) {
    const FaceSide& side = sides[i];
    if (edges_.empty() || edges_.back().ends != side.ends) edges_.push_back({side.ends, {}});
    std::vector<Eigen::Vector3d>& normals = edges_.back().normals;
    // Faces of one surface pass their common edge in opposite directions; else one is inside out.
    const bool is_second = !normals.empty();
    const bool is_inside_out = is_second && sides[i - 1].is_turned == side.is_turned;
    normals.push_back(is_inside_out && normals.size() == 1 ? Eigen::Vector3d(-side.normal)
                                                           : side.normal);
  }
}

void BuildingEdges::FindSharpCorners() {
  std::vector<std::vector<Eigen::Vector3d>> ways(points_.size());  // along sharp edges
  for (const Edge& edge : edges_) {
    const bool is_flat =
        edge.normals.size() == 2 && edge.normals[0].dot(edge.normals[1]) > std::cos(kSharp);
    if (is_flat) continue;
    const auto [a, b] = edge.ends;
    const Eigen::Vector3d way = (points_[b] - points_[a]).normalized();
    ways[a].push_back(way);
    ways[b].push_back(-way);
  }
  is_sharp_.assign(points_.size(), 0);
  for (size_t i = 0; i < points_.size(); ++i) {
    const bool goes_on = ways[i].size() == 2 && -ways[i][0].dot(ways[i][1]) > std::cos(kSharp);
    if (!ways[i].empty() && !goes_on) is_sharp_[i] = 1;
  }
}

std::vector<EdgeEnds> BuildingEdges::MeshOutlineFrom(const Eigen::Vector3d& eye) const {
  std::vector<EdgeEnds> outline;
  for (const Edge& edge : edges_) {
    const Eigen::Vector3d to_eye = eye - points_[edge.ends.first];
    const auto is_seen = [&](const Eigen::Vector3d& normal) { return normal.dot(to_eye) > 0; };
    const auto seen = std::count_if(edge.normals.begin(), edge.normals.end(), is_seen);
    const auto faces = static_cast<std::ptrdiff_t>(edge.normals.size());
    if (faces == 1 || (seen > 0 && seen < faces)) outline.push_back(edge.ends);
  }
  return outline;
}

std::vector<OutlineEdge> BuildingEdges::OutlineFrom(const Eigen::Vector3d& eye) const {
  std::vector<OutlineEdge> outline;
  for (const auto& [a, b] : MeshOutlineFrom(eye)) outline.emplace_back(points_[a], points_[b]);
  for (const EnvironmentSphere& sphere : spheres_) {
    const std::vector<OutlineEdge> circle = SilhouetteEdges(eye, sphere);
    outline.insert(outline.end(), circle.begin(), circle.end());
  }
  return outline;
}

std::vector<Eigen::Vector3d> BuildingEdges::CornersSeenFrom(const Eigen::Vector3d& eye) const {
  std::vector<char> is_wanted = is_sharp_;
  for (const auto& [a, b] : MeshOutlineFrom(eye)) is_wanted[a] = is_wanted[b] = 1;
  std::vector<Eigen::Vector3d> corners;
  for (size_t i = 0; i < points_.size(); ++i) {
    if (is_wanted[i]) corners.push_back(points_[i]);
  }
  for (const EnvironmentSphere& sphere : spheres_) {
    const std::vector<Eigen::Vector3d> about = SilhouetteFrom(eye, sphere, kCornersOfSphere);
    corners.insert(corners.end(), about.begin(), about.end());
  }
  return corners;
}

}  // namespace insitu
