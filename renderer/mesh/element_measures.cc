// SPDX-License-Identifier: GPL-3.0-or-later
#include "renderer/mesh/element_measures.h"

#include <Eigen/Geometry>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>
#include <set>
#include <unordered_map>
#include <vector>

#include "renderer/mesh/near_vertices.h"

namespace insitu {
namespace {

using Eigen::Vector3d;
// Smaller vertex first -> passes one way less the other.
using EdgeCounts = std::unordered_map<uint64_t, int>;

// Sums over the faces of one layer, about its first vertex: far coordinates lose nothing.
struct MeasureSums {
  std::optional<Vector3d> origin;
  double area = 0, volume = 0;
  double sphere_area = 0, sphere_volume = 0;
  EdgeCounts edges;
};

void AddEdge(int from, int to, int passes, EdgeCounts* edges) {
  if (from == to) return;
  const bool upwards = from < to;
  const auto low = static_cast<uint64_t>(upwards ? from : to);
  const auto high = static_cast<uint64_t>(upwards ? to : from);
  const auto edge = edges->try_emplace(low << 32 | high, 0).first;
  edge->second += upwards ? passes : -passes;
  if (edge->second == 0) edges->erase(edge);
}

int LowOf(uint64_t edge) { return static_cast<int>(edge >> 32); }
int HighOf(uint64_t edge) { return static_cast<int>(edge & 0xFFFFFFFF); }

// Cut at the corners of others that lie on them: a side that has three neighbours, as some kernels
// leave it, has no gap. Of so many open edges that this would take long, as they are.
EdgeCounts CutAtCorners(const EdgeCounts& edges, const std::vector<Vector3d>& vertices) {
  constexpr size_t kMost = 2000;
  if (edges.empty() || edges.size() > kMost) return edges;
  std::set<int> corners;
  for (const auto& [edge, passes] : edges) corners.insert({LowOf(edge), HighOf(edge)});
  EdgeCounts pieces;
  for (const auto& [edge, passes] : edges) {
    const Vector3d& from = vertices[LowOf(edge)];
    const Vector3d way = vertices[HighOf(edge)] - from;
    std::map<double, int> stops;
    for (const int corner : corners) {
      const double along = (vertices[corner] - from).dot(way) / way.squaredNorm();
      const double off = (vertices[corner] - from - along * way).norm();
      if (along > 0 && along < 1 && off <= kJoinTolerance) stops[along] = corner;
    }
    stops[0] = LowOf(edge);
    stops[1] = HighOf(edge);
    for (auto stop = stops.begin(), next = std::next(stop); next != stops.end(); ++stop, ++next) {
      AddEdge(stop->second, next->second, passes, &pieces);
    }
  }
  return pieces;
}

// `first` tells which vertices are one.
void AddTriangle(const ModelMesh& mesh, const Eigen::Vector3i& triangle,
                 const std::vector<int>& first, MeasureSums* sums) {
  if (!sums->origin) sums->origin = mesh.vertices[triangle[0]];
  const Vector3d a = mesh.vertices[triangle[0]] - *sums->origin;
  const Vector3d b = mesh.vertices[triangle[1]] - *sums->origin;
  const Vector3d c = mesh.vertices[triangle[2]] - *sums->origin;
  sums->area += (b - a).cross(c - a).norm() / 2;
  sums->volume += a.dot(b.cross(c)) / 6;
  for (int i = 0; i < 3; ++i) {
    const int from = first[triangle[i]], to = first[triangle[(i + 1) % 3]];
    AddEdge(from, to, 1, &sums->edges);
  }
}

void AddSphere(const ModelSphere& sphere, MeasureSums* sums) {
  const double area = 4 * std::numbers::pi * sphere.radius * sphere.radius;
  sums->sphere_area += area;
  sums->sphere_volume += area * sphere.radius / 3;
}

}  // namespace

std::map<std::string, ElementMeasures> MeasuresByLayer(const ModelMesh& mesh) {
  std::map<std::string, MeasureSums> sums;
  std::vector<MeasureSums*> sums_of_surface;
  for (const SurfaceNames& names : mesh.surfaces) sums_of_surface.push_back(&sums[names.layer]);
  const std::vector<int> first = FirstOfNear(mesh.vertices, kJoinTolerance);
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    AddTriangle(mesh, mesh.triangles[t], first, sums_of_surface[mesh.surface_of_triangle[t]]);
  }
  for (const ModelSphere& sphere : mesh.spheres) AddSphere(sphere, sums_of_surface[sphere.surface]);
  std::map<std::string, ElementMeasures> elements;
  for (const auto& [layer, sum] : sums) {
    if (!sum.origin && sum.sphere_area == 0) continue;
    ElementMeasures& element = elements[layer];
    element.area = sum.area + sum.sphere_area;
    element.open_edges = static_cast<int>(CutAtCorners(sum.edges, mesh.vertices).size());
    if (element.open_edges == 0) element.volume = sum.volume + sum.sphere_volume;
  }
  return elements;
}

ElementMeasures Sum(const std::map<std::string, ElementMeasures>& elements) {
  ElementMeasures all;
  all.volume = 0;
  for (const auto& [name, element] : elements) {
    all.area += element.area;
    all.open_edges += element.open_edges;
    if (!element.volume) all.volume.reset();
    if (all.volume) *all.volume += *element.volume;
  }
  return all;
}

}  // namespace insitu
